// Particles that were moved after they had been computed: their splats follow.
#include "SplatScene.h"

#include "Particles/ParticleMotion.h"
#include "Particles/SplatParticles.h"
#include "vtkAppendPolyData.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace
{
void AddArray(vtkPolyData* particles, const char* name, int components,
  const std::function<std::vector<double>(glm::dvec3 place)>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    double p[3];
    particles->GetPoint(i, p);
    array->InsertNextTuple(values({ p[0], p[1], p[2] }).data());
  }
  particles->GetPointData()->AddArray(array);
}

// Places and normals as they are now become those as computed.
void AddPlacements(vtkPolyData* particles)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Original_Placement");
  array->SetNumberOfComponents(6);
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    double placement[6];
    particles->GetPoint(i, placement);
    particles->GetPointData()->GetNormals()->GetTuple(i, placement + 3);
    array->InsertNextTuple(placement);
  }
  particles->GetPointData()->AddArray(array);
}

// A sphere whose splats end at the plane x = 0.6 if they are before it; all of them know its shape.
vtkSmartPointer<vtkPolyData> CutSphere()
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(1500, 1., 0.1);
  std::vector<glm::dvec3> places, normals;
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    double p[3];
    sphere->GetPoint(i, p);
    if (p[0] < 0.6)
    {
      places.emplace_back(p[0], p[1], p[2]);
      normals.push_back(places.back());
    }
  }
  vtkSmartPointer<vtkPolyData> cut = Disks(places, normals, 0.1);
  AddArray(cut, "Clip_Normal", 3, [](glm::dvec3) { return std::vector<double>{ 1., 0., 0. }; });
  AddArray(cut, "Clip_Distance", 1, [](glm::dvec3 p) { return std::vector<double>{ 0.6 - p.x }; });
  AddArray(cut, "Clip_Angle", 1, [](glm::dvec3) { return std::vector<double>{ 180. }; });
  AddShapeOfSphere(cut, 1.);
  AddPlacements(cut);
  return cut;
}

vtkSmartPointer<vtkPolyData> Moved(vtkPolyData* particles, vtkTransform* transform)
{
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(particles);
  filter->SetTransform(transform);
  filter->Update();
  return filter->GetOutput();
}

// Turns x to z to y to x: exact, so that pictures can be compared pixel by pixel.
vtkSmartPointer<vtkTransform> ThirdOfATurn()
{
  auto turn = vtkSmartPointer<vtkTransform>::New();
  turn->SetMatrix(
    std::array<double, 16>{ 0., 1., 0., 0., 0., 0., 1., 0., 1., 0., 0., 0., 0., 0., 0., 1. }
      .data());
  return turn;
}

glm::dvec3 First3(const std::vector<float>& values, std::size_t first)
{
  return { values[first], values[first + 1], values[first + 2] };
}

// Fails the test unless every splat ends at the image of the plane x = 0.6.
void ExpectCutByImage(
  const hop::SplatParticles& splats, vtkTransform* transform, std::size_t begin = 0)
{
  double place[3] = { 0.6, 0., 0. };
  transform->TransformPoint(place, place);
  double normal[3] = { 1., 0., 0. };
  transform->TransformNormal(normal, normal);
  const glm::dvec3 m = glm::normalize(glm::dvec3(normal[0], normal[1], normal[2]));
  const glm::dvec3 onPlane = glm::dvec3(place[0], place[1], place[2]) -
    glm::dvec3(splats.Origin[0], splats.Origin[1], splats.Origin[2]);
  for (std::size_t i = begin; i < splats.PointIds.size(); ++i)
  {
    EXPECT_GT(glm::dot(First3(splats.Clip, 12 * i), m), 1. - 1e-5);
    EXPECT_NEAR(
      splats.Clip[12 * i + 3], glm::dot(m, onPlane - First3(splats.CentreRadius, 4 * i)), 1e-5);
  }
}
}

TEST(SplatMotion, ARotatedSurfaceLooksAsBefore)
{
  const vtkSmartPointer<vtkPolyData> sphere = CutSphere();
  SplatScene before(sphere);
  SplatScene after(Moved(sphere, ThirdOfATurn()));
  for (SplatScene* scene : { &before, &after })
  {
    scene->Mapper->SetMode(vtkSurfaceSplatMapper::Splats);
  }
  before.LookFrom({ 0., 0., 1. }, true);
  after.LookFrom({ 0., 1., 0. }, true);
  before.Render();
  after.Render();
  // The cameras' axes differ by a turn: the number of pixels, of depths and so on tells as much.
  EXPECT_NEAR(
    after.CountDrawnPixels(), before.CountDrawnPixels(), 0.002 * before.CountDrawnPixels());
  const auto cut = [](SplatScene& scene, int axis)
  {
    double largest = -1.;
    scene.ForEachDrawnPixel(
      [&](int, int, glm::dvec3 place) { largest = std::max(largest, place[axis]); });
    return largest;
  };
  EXPECT_NEAR(cut(before, 0), 0.6, 0.02);
  EXPECT_NEAR(cut(after, 2), cut(before, 0), 1e-3);
}

TEST(SplatMotion, PlanesRadiiAndNormalsFollowAffineMaps)
{
  const vtkSmartPointer<vtkPolyData> sphere = CutSphere();
  vtkNew<vtkTransform> shear;
  shear->RotateWXYZ(40., 1., 2., 3.);
  shear->Scale(2., -1., 0.5);
  shear->RotateWXYZ(70., -1., 1., 0.);
  shear->Translate(5., 3., -2.);
  const vtkSmartPointer<vtkTransform> turn = ThirdOfATurn();
  for (vtkTransform* transform : { turn.Get(), shear.Get() })
  {
    const hop::SplatParticles splats = ReadSplats(Moved(sphere, transform));
    EXPECT_FALSE(splats.Warped);
    ExpectCutByImage(splats, transform);
  }
  const hop::SplatParticles stretched = ReadSplats(Moved(sphere, shear));
  for (std::size_t i = 0; i < stretched.PointIds.size(); ++i)
  {
    // The image of a circle is an ellipse; its longer axis is between the two larger factors.
    EXPECT_GE(stretched.CentreRadius[4 * i + 3], 0.1f * (1.f - 1e-5f));
    EXPECT_LE(stretched.CentreRadius[4 * i + 3], 0.2f * (1.f + 1e-5f));
  }
}

// The image of x^2 + y^2 + z^2 = 1 is a quadric whose curvature is known.
TEST(SplatMotion, ShapeOperatorsFollowAffineMaps)
{
  const glm::dmat3 matrix(1.2, 0.3, -0.2, 0.1, -0.7, 0.4, 0.5, 0.2, 2.); // in columns
  hop::LinearMap::Matrix rows;
  for (int i = 0; i < 3; ++i)
  {
    rows[i] = { matrix[0][i], matrix[1][i], matrix[2][i] };
  }
  const hop::LinearMap map(rows);
  const glm::dmat3 inverse = glm::inverse(matrix);
  const glm::dmat3 quadric = glm::transpose(inverse) * inverse;
  const glm::dvec3 place = glm::normalize(glm::dvec3(1., -2., 0.7));
  const glm::dmat3 flat = glm::dmat3(1.) - glm::outerProduct(place, place);
  float shape[8] = { float(flat[0][0]), float(flat[1][1]), float(flat[2][2]), 0.f,
    float(flat[0][1]), float(flat[1][2]), float(flat[0][2]), 0.f };
  map.CarryShape(&place.x, shape);

  const glm::dvec3 gradient = quadric * (matrix * place);
  const glm::dvec3 normal = glm::normalize(gradient);
  const glm::dmat3 tangential = glm::dmat3(1.) - glm::outerProduct(normal, normal);
  const glm::dmat3 expected = tangential * quadric * tangential / glm::length(gradient);
  const double found[6] = { shape[0], shape[1], shape[2], shape[4], shape[5], shape[6] };
  const double wanted[6] = { expected[0][0], expected[1][1], expected[2][2], expected[0][1],
    expected[1][2], expected[0][2] };
  for (int c = 0; c < 6; ++c)
  {
    EXPECT_NEAR(found[c], wanted[c], 1e-6);
  }
  double carried[3];
  map.CarryNormal(&place.x, carried);
  EXPECT_NEAR(glm::dot(glm::dvec3(carried[0], carried[1], carried[2]), normal), 1., 1e-12);
}

// A circle of radius 1 in a plane becomes an ellipse with the half axes a and b: at (a, 0) its curvature is a / b^2.
TEST(SplatMotion, EdgesStayThoseOfTheSurface)
{
  const double a = 3.;
  const double b = 2.;
  const hop::LinearMap map({ { { a, 0., 0. }, { 0., b, 0. }, { 0., 0., 1. } } });
  const double normal[3] = { 0., 0., 1. };
  float plane[4] = { 1.f, 0.f, 0.f, 0.5f };
  float curvature = -1.f;
  map.CarryClip(normal, plane, curvature);
  EXPECT_FLOAT_EQ(plane[0], 1.f);
  EXPECT_FLOAT_EQ(plane[3], 0.5f * 3.f);
  EXPECT_FLOAT_EQ(curvature, static_cast<float>(-a / (b * b)));
  float none[4] = { 0.f, 0.f, 0.f, 0.f };
  curvature = 0.f;
  map.CarryClip(normal, none, curvature);
  EXPECT_EQ(none[0], 0.f) << "no plane";
  EXPECT_EQ(none[3], 0.f);
  EXPECT_EQ(curvature, 0.f);
}

TEST(SplatMotion, NormalsThatNobodyTurnedAreTurned)
{
  const vtkSmartPointer<vtkPolyData> sphere = CutSphere();
  vtkSmartPointer<vtkPolyData> moved = Moved(sphere, ThirdOfATurn());
  const hop::SplatParticles turned = ReadSplats(moved);
  moved->GetPointData()->SetNormals(sphere->GetPointData()->GetNormals());
  const hop::SplatParticles stale = ReadSplats(moved);
  for (std::size_t i = 0; i < turned.Normal.size(); ++i)
  {
    EXPECT_NEAR(stale.Normal[i], turned.Normal[i], 1e-5);
  }
}

TEST(SplatMotion, SeveralSetsMoveEachInItsOwnWay)
{
  const vtkSmartPointer<vtkPolyData> sphere = CutSphere();
  vtkNew<vtkTransform> mirror;
  mirror->Translate(3., 0., 0.);
  mirror->Scale(-1., 1., 1.);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputData(sphere);
  both->AddInputData(Moved(sphere, mirror));
  both->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  both->Update();
  const hop::SplatParticles splats = ReadSplats(both->GetOutput());
  EXPECT_FALSE(splats.Warped);
  ExpectCutByImage(splats, mirror, sphere->GetNumberOfPoints());
}

TEST(SplatMotion, AFlatSurfaceMayBeTurnedAndMirrored)
{
  std::vector<glm::dvec3> places, normals;
  for (int i = 0; i < 100; ++i)
  {
    places.emplace_back(0.05 * (i % 10), 0.06 * (i / 10), 1.);
    normals.emplace_back(0., 0., 1.);
  }
  const vtkSmartPointer<vtkPolyData> flat = Disks(places, normals, 0.05);
  AddArray(flat, "Clip_Normal", 3, [](glm::dvec3) { return std::vector<double>{ 1., 0., 0. }; });
  AddArray(flat, "Clip_Distance", 1, [](glm::dvec3 p) { return std::vector<double>{ 0.6 - p.x }; });
  AddPlacements(flat);
  vtkNew<vtkTransform> transform;
  transform->RotateWXYZ(33., 3., 2., 1.);
  transform->Scale(-1., 1., 1.);
  const hop::SplatParticles splats = ReadSplats(Moved(flat, transform));
  EXPECT_FALSE(splats.Warped);
  ExpectCutByImage(splats, transform);
}

TEST(SplatMotion, WarpedParticlesAreSaidOnceAndDrawnWithoutPlanes)
{
  const vtkSmartPointer<vtkPolyData> sphere = CutSphere();
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    double p[3];
    sphere->GetPoint(i, p);
    sphere->GetPoints()->SetPoint(i, p[0] + 0.3 * p[1] * p[1], p[1], p[2]);
  }
  const hop::SplatParticles splats = ReadSplats(sphere);
  EXPECT_TRUE(splats.Warped);
  EXPECT_TRUE(splats.Clip.empty());
  EXPECT_TRUE(splats.Shape.empty());

  SplatScene scene(sphere);
  const WarningCounter warnings(scene.Mapper);
  scene.LookFrom({ 0., 0., 1. }, true);
  scene.Render();
  scene.Mapper->SetSharpness(3.);
  scene.Render();
  EXPECT_EQ(warnings.Count, 1);
  EXPECT_NE(warnings.Text.find("Move the grid instead"), std::string::npos) << warnings.Text;
}

TEST(SplatMotion, NothingChangesWhereNothingMoved)
{
  const vtkSmartPointer<vtkPolyData> sphere = CutSphere();
  const hop::SplatParticles with = ReadSplats(sphere);
  sphere->GetPointData()->RemoveArray("Original_Placement");
  const hop::SplatParticles without = ReadSplats(sphere);
  EXPECT_EQ(with.CentreRadius, without.CentreRadius);
  EXPECT_EQ(with.Normal, without.Normal);
  EXPECT_EQ(with.Clip, without.Clip);
  EXPECT_EQ(with.Shape, without.Shape);
}
