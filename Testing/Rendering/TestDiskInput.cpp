// Inputs that lack something.
#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSurfaceSplatMapper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
constexpr double DiskRadius = 0.04;

// Whether anything is drawn within half a disk of a place in a parallel view along -z.
bool IsDrawnAt(const SplatScene& scene, glm::dvec3 place)
{
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < SplatScene::Size; ++x)
    {
      const auto position = scene.PositionAt(x, y);
      if (position && glm::distance(*position, place) < 0.05)
      {
        return true;
      }
    }
  }
  return false;
}
}

TEST(DiskInput, EmptyInputsDrawNothing)
{
  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkPolyData> noPoints;
  vtkNew<vtkPoints> points;
  noPoints->SetPoints(points);
  for (vtkPolyData* input : { nothing.Get(), noPoints.Get() })
  {
    SplatScene scene(input);
    WarningCounter warnings(scene.Mapper);
    scene.Render();
    EXPECT_EQ(scene.CountDrawnPixels(), 0);
    EXPECT_EQ(warnings.Count, 0) << warnings.Text;
    EXPECT_FALSE(vtkMath::AreBoundsInitialized(scene.Mapper->GetBounds()));

    // And the next time step has particles, the one after that none again.
    scene.Mapper->SetInputDataObject(FibonacciSphere(Count, 1., DiskRadius));
    scene.Render();
    EXPECT_GT(scene.CountDrawnPixels(), 15000);
    scene.Mapper->SetInputDataObject(input);
    scene.Render();
    EXPECT_EQ(scene.CountDrawnPixels(), 0);
  }
}

TEST(DiskInput, WithoutNormalsDisksFaceTheViewerAndOneWarningSaysSo)
{
  for (bool parallel : { false, true })
  {
    vtkSmartPointer<vtkPolyData> disk = Disks({ { 0., 0., 0. } }, { { 1., 0., 0. } }, 0.5);
    disk->GetPointData()->RemoveArray("Normals");
    SplatScene scene(disk);
    WarningCounter warnings(scene.Mapper);
    const double pixel = 2. * 1.3 / SplatScene::Size;
    for (const glm::dvec3& direction : { glm::dvec3(0., 0., 1.), glm::dvec3(1., 2., -1.) })
    {
      scene.LookFrom(direction, parallel);
      scene.Render();
      EXPECT_NEAR(scene.CountDrawnPixels(), M_PI * 0.25 / (pixel * pixel), 80.);
    }
    EXPECT_EQ(warnings.Count, 1);
    EXPECT_NE(warnings.Text.find("Normals"), std::string::npos) << warnings.Text;
  }
}

TEST(DiskInput, WithoutRadiusOneThatClosesTheSurfaceIsTakenAndOneWarningSaysSo)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., DiskRadius);
  sphere->GetPointData()->RemoveArray("Radius");
  SplatScene scene(sphere);
  WarningCounter warnings(scene.Mapper);
  scene.Render();
  scene.Render();
  EXPECT_EQ(warnings.Count, 1);
  EXPECT_NE(warnings.Text.find("'Radius'"), std::string::npos) << warnings.Text;
  scene.ForEachPixelOnSphere(1., 0.3,
    [&](int x, int y, glm::dvec3 onSphere)
    {
      const auto position = scene.PositionAt(x, y);
      ASSERT_TRUE(position);
      ASSERT_LT(glm::distance(*position, onSphere), 0.01);
    });
  const double margin = scene.Mapper->GetBounds()[5] - 1.;
  EXPECT_GT(margin, 0.03);
  EXPECT_LT(margin, 0.08);

  scene.Mapper->SetRadius(0.01);
  scene.Render();
  EXPECT_NEAR(scene.Mapper->GetBounds()[5], 1.01, 1e-3);
  EXPECT_EQ(warnings.Count, 1);
}

TEST(DiskInput, TheRadiusArrayCanHaveAnotherName)
{
  vtkSmartPointer<vtkPolyData> disk = Disks({ { 0., 0., 0. } }, { { 0., 0., 1. } }, 0.1);
  vtkNew<vtkDoubleArray> sizes;
  sizes->SetName("Size");
  sizes->InsertNextValue(0.5);
  disk->GetPointData()->AddArray(sizes);
  SplatScene scene(disk);
  scene.LookFrom({ 0., 0., 1. }, true);
  scene.Render();
  const int small = scene.CountDrawnPixels();
  scene.Mapper->SetRadiusArrayName("Size");
  scene.Render();
  EXPECT_NEAR(static_cast<double>(scene.CountDrawnPixels()) / small, 25., 1.);
}

TEST(DiskInput, ParticlesThatCannotBeDrawnAreSkippedAndTheOthersDrawn)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<glm::dvec3> positions;
  for (int i = 0; i < 9; ++i)
  {
    positions.emplace_back(-1. + 0.25 * i, 0., 0.);
  }
  const std::vector<glm::dvec3> normals(9, { 0., 0., 1. });
  vtkSmartPointer<vtkPolyData> row = Disks(positions, normals, 0.1);
  vtkDataArray* radii = row->GetPointData()->GetArray("Radius");
  vtkDataArray* directions = row->GetPointData()->GetNormals();
  directions->SetTuple3(1, 0., 0., 0.);
  directions->SetTuple3(2, 0., nan, 1.);
  radii->SetTuple1(3, 0.);
  radii->SetTuple1(4, -0.1);
  radii->SetTuple1(5, nan);
  radii->SetTuple1(6, infinity);
  row->GetPoints()->SetPoint(7, nan, 0., 0.);

  SplatScene scene(row);
  WarningCounter warnings(scene.Mapper);
  scene.LookFrom({ 0., 0., 1. }, true);
  scene.Render();
  EXPECT_EQ(warnings.Count, 0) << warnings.Text;
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_EQ(IsDrawnAt(scene, positions[i]), i == 0 || i == 8) << "particle " << i;
  }
  const double pixel = 2. * 1.3 / SplatScene::Size;
  EXPECT_NEAR(scene.CountDrawnPixels(), 2. * M_PI * 0.01 / (pixel * pixel), 30.);
  EXPECT_NEAR(scene.Mapper->GetBounds()[0], -1.1, 1e-12);
  EXPECT_NEAR(scene.Mapper->GetBounds()[1], 1.1, 1e-12);
}

TEST(DiskInput, PointsOfNoVertexCellAreNotDrawn)
{
  vtkSmartPointer<vtkPolyData> pair =
    Disks({ { -0.5, 0., 0. }, { 0.5, 0., 0. } }, { { 0., 0., 1. }, { 0., 0., 1. } }, 0.2);
  AddVertexCells(pair, { 1, 1 });
  SplatScene scene(pair);
  scene.LookFrom({ 0., 0., 1. }, true);
  scene.Render();
  EXPECT_FALSE(IsDrawnAt(scene, { -0.5, 0., 0. }));
  EXPECT_TRUE(IsDrawnAt(scene, { 0.5, 0., 0. }));
}
