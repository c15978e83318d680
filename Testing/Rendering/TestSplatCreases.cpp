// Points of meshes on creases: one point with the mean normal, and splats of both sides.
#include "SplatScene.h"

#include "Common/SplatColumns.h"
#include "Particles/SplatParticles.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

namespace
{
const double half = std::sqrt(0.5);

// Two sides of a roof z = -|x|, and vectors within them that lead up over the ridge.
const glm::dvec3 leftNormal(-half, 0., half);
const glm::dvec3 leftUp(half, 0., half);
const glm::dvec3 rightNormal(half, 0., half);
const glm::dvec3 rightUp(-half, 0., half);
const glm::dvec3 meanNormal(0., 0., 1.);

void AddArray(vtkPolyData* particles, const char* name, const std::vector<double>& first)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(first.size()));
  array->SetNumberOfTuples(particles->GetNumberOfPoints());
  array->Fill(0.);
  array->SetTuple(0, first.data());
  particles->GetPointData()->AddArray(array);
}

void AddOtherSide(vtkPolyData* particles)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(hop::CreaseColumnsArray);
  array->SetNumberOfComponents(hop::splatColumnCount(hop::CreaseColumns));
  array->SetNumberOfTuples(particles->GetNumberOfPoints());
  array->Fill(0.);
  for (int axis = 0; axis < 3; ++axis)
  {
    array->SetComponent(0, axis, leftNormal[axis]);
    array->SetComponent(0, 3 + axis, rightNormal[axis]);
    array->SetComponent(0, 6 + axis, rightUp[axis]); // Clip_Normal
  }
  array->SetComponent(0, 18, 90.); // Clip_Angle
  particles->GetPointData()->AddArray(array);
}

// A point on the ridge, and some on both sides, so many that an affine map shows in them.
vtkSmartPointer<vtkPolyData> Ridge()
{
  vtkSmartPointer<vtkPolyData> particles =
    Disks({ { 0., 0., 0. }, { -0.2, 0., -0.2 }, { -0.1, 0.2, -0.1 }, { -0.3, 0.1, -0.3 },
            { 0.2, 0., -0.2 }, { 0.1, 0.2, -0.1 } },
      { meanNormal, leftNormal, leftNormal, leftNormal, rightNormal, rightNormal }, 0.1);
  AddArray(particles, "Clip_Normal", { leftUp.x, leftUp.y, leftUp.z });
  AddArray(particles, "Clip_Distance", { 0. });
  AddArray(particles, "Clip_Angle", { 90. });
  AddOtherSide(particles);
  return particles;
}

void ExpectVector(const std::vector<float>& numbers, std::size_t first, const glm::dvec3& wanted)
{
  ASSERT_GE(numbers.size(), first + 3);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(numbers[first + axis], wanted[axis], 1e-6) << axis;
  }
}
}

TEST(SplatCreases, PointsHaveASplatOnEitherSide)
{
  const hop::SplatParticles splats = ReadSplats(Ridge());
  EXPECT_EQ(splats.PointIds, (std::vector<vtkIdType>{ 0, 1, 2, 3, 4, 5, 0 }));
  EXPECT_EQ(splats.Skipped, 0);
  ExpectVector(splats.Normal, 0, leftNormal);
  ExpectVector(splats.Normal, 4, leftNormal);
  ExpectVector(splats.Normal, 4 * 6, rightNormal);
  ASSERT_EQ(splats.ClipStride, 12);
  ExpectVector(splats.Clip, 0, leftUp);
  ExpectVector(splats.Clip, 12 * 6, rightUp);
  EXPECT_FLOAT_EQ(splats.CentreRadius[4 * 6 + 3], 0.1f);
}

TEST(SplatCreases, BothSidesFollowWhatMovesPoints)
{
  const vtkSmartPointer<vtkPolyData> particles = Ridge();
  AddArray(particles, "Original_Placement", { 0., 0., 0., 0., 0., 1. });
  for (vtkIdType i = 1; i < particles->GetNumberOfPoints(); ++i)
  {
    double placement[6];
    particles->GetPoint(i, placement);
    particles->GetPointData()->GetNormals()->GetTuple(i, placement + 3);
    particles->GetPointData()->GetArray("Original_Placement")->SetTuple(i, placement);
  }
  // x to z to y to x
  vtkNew<vtkTransform> turn;
  turn->SetMatrix(
    std::array<double, 16>{ 0., 1., 0., 0., 0., 0., 1., 0., 1., 0., 0., 0., 0., 0., 0., 1. }
      .data());
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(particles);
  filter->SetTransform(turn);
  filter->Update();
  const auto turned = [](const glm::dvec3& v) { return glm::dvec3(v.y, v.z, v.x); };
  const hop::SplatParticles splats = ReadSplats(filter->GetOutput());
  ASSERT_EQ(splats.PointIds.size(), 7u);
  ASSERT_EQ(splats.ClipStride, 12);
  ExpectVector(splats.Normal, 0, turned(leftNormal));
  ExpectVector(splats.Normal, 4 * 6, turned(rightNormal));
  ExpectVector(splats.Clip, 0, turned(leftUp));
  ExpectVector(splats.Clip, 12 * 6, turned(rightUp));
}

TEST(SplatCreases, ArraysThatAreTooSmallAreIgnored)
{
  for (const auto& [components, tuples] : { std::pair(30, 1), std::pair(6, 6) })
  {
    const vtkSmartPointer<vtkPolyData> particles = Ridge();
    vtkDataArray* columns = particles->GetPointData()->GetArray(hop::CreaseColumnsArray);
    columns->SetNumberOfComponents(components);
    columns->SetNumberOfTuples(tuples);
    columns->Fill(0.5);
    const hop::SplatParticles splats = ReadSplats(particles);
    EXPECT_EQ(splats.PointIds.size(), 6u);
    ExpectVector(splats.Normal, 0, meanNormal);
  }
}
