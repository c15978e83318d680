// Where disks are drawn: depth and normals against the analytic sphere, sizes, clipping.
#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkLight.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSurfaceSplatMapper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
constexpr double DiskRadius = 0.04; // 0.74 of the spacing of 5,000 particles on the unit sphere
// A disk touches the sphere in its middle and is this far outside at its rim.
const double RimHeight = std::sqrt(1. + DiskRadius * DiskRadius) - 1.;

class DisksOnSphere : public testing::TestWithParam<SceneView>
{
};

// The sphere's pixels must be on the sphere, at most as far outside as a disk's rim, and none missing.
void ExpectUnitSphere(const SplatScene& scene)
{
  ForEachPlaceOnSphere(scene,
    [](glm::dvec3 seen, glm::dvec3 onSphere)
    {
      const double height = glm::length(seen) - 1.;
      ASSERT_GT(height, -2e-5);
      ASSERT_LT(height, RimHeight + 2e-5);
      ASSERT_LT(glm::distance(seen, onSphere), (RimHeight + 4e-5) / Inside);
    });
}
}

TEST_P(DisksOnSphere, DepthIsTheSphereWithoutHoles)
{
  SplatScene scene(FibonacciSphere(Count, 1., DiskRadius));
  scene.LookFrom(GetParam().Direction, GetParam().Parallel);
  scene.Render();
  ExpectUnitSphere(scene);
}

TEST_P(DisksOnSphere, DepthIsRightAtCoordinatesOfAMillion)
{
  const glm::dvec3 centre(1e6, -2e6, 3e6);
  SplatScene scene(FibonacciSphere(Count, 1., DiskRadius, centre), centre);
  scene.LookFrom(GetParam().Direction, GetParam().Parallel);
  scene.Render();
  ExpectUnitSphere(scene);
}

TEST_P(DisksOnSphere, NormalsAreTheSpheres)
{
  SplatScene scene(FibonacciSphere(Count, 1., DiskRadius));
  scene.LookFrom(GetParam().Direction, GetParam().Parallel);
  scene.ShowNormals();
  scene.Render();

  double sum = 0.;
  const int pixels = scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3 expected)
    {
      const glm::dvec3 normal = scene.NormalAt(x, y);
      const double angle = std::acos(std::clamp(glm::dot(normal, expected), -1., 1.));
      ASSERT_LT(angle, DiskRadius + 0.01) << "at pixel " << x << ", " << y;
      sum += angle;
    });
  // Of the tangent planes over a pixel the one that touches farthest away is the outermost, so that
  // outer zones of disks are seen more than their middles.
  EXPECT_LT(sum / pixels, 0.8 * DiskRadius);
}

TEST_P(DisksOnSphere, ClippingPlaneCutsThroughDisks)
{
  for (const glm::dvec3& centre : { glm::dvec3(0.), glm::dvec3(1e6, -2e6, 3e6) })
  {
    SplatScene scene(FibonacciSphere(Count, 1., DiskRadius, centre), centre);
    ExpectClippingPlaneCuts(scene, GetParam(), centre, 0.01, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Views, DisksOnSphere, testing::ValuesIn(SphereViews));

TEST(DiskGeometry, FollowsTheActorsTransform)
{
  SplatScene scene(FibonacciSphere(Count, 1., DiskRadius));
  ExpectStretchedSphere(scene, { 0.5, 1., 0.8 }, 1. - 1e-4, 1. + RimHeight + 1e-4, 8000);
}

TEST(DiskGeometry, ALightFromTheSideShadesByItsAngle)
{
  SplatScene scene(FibonacciSphere(Count, 1., DiskRadius));
  scene.LookFrom({ 0., 0., 1. }, true);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(3., 0., 4.);
  light->SetFocalPoint(0., 0., 0.);
  scene.Renderer->AddLight(light);
  scene.Render();
  scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3 normal)
    {
      const double expected = 255. * std::max(0., glm::dot(normal, glm::dvec3(0.6, 0., 0.8)));
      ASSERT_NEAR(scene.ColorAt(x, y).g, expected, 255. * (DiskRadius + 0.01));
    });
}

TEST(DiskGeometry, TheInwardSideIsLitAsWell)
{
  SplatScene scene(FibonacciSphere(Count, 1., DiskRadius));
  scene.LookFrom({ 0., 0., 1. }, false, 0.3, 0.3); // from within
  scene.Render();                                  // with the light at the camera
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < SplatScene::Size; ++x)
    {
      const auto position = scene.PositionAt(x, y);
      ASSERT_TRUE(position);
      const double expected = -255. * glm::normalize(*position).z; // the normal, seen from inside
      ASSERT_NEAR(scene.ColorAt(x, y).g, expected, 255. * (DiskRadius + 0.01));
    }
  }
}

namespace
{
double PixelsOfADisk(double radius)
{
  const double pixel = 2. * 1.3 / SplatScene::Size;
  return M_PI * radius * radius / (pixel * pixel);
}
}

TEST(DiskGeometry, ADiskHasItsRadiusAndTilt)
{
  SplatScene scene(Disks({ { 0., 0., 0. } }, { { 0., 0., 2. } }, 0.5));
  scene.LookFrom({ 0., 0., 1. }, true);
  scene.Render();
  EXPECT_NEAR(scene.CountDrawnPixels(), PixelsOfADisk(0.5), 0.01 * PixelsOfADisk(0.5));

  scene.Mapper->SetRadiusScale(0.5);
  scene.Render();
  EXPECT_NEAR(scene.CountDrawnPixels(), PixelsOfADisk(0.25), 0.02 * PixelsOfADisk(0.25));

  scene.Mapper->SetRadiusScale(1.);
  scene.LookFrom({ std::sqrt(3.), 0., 1. }, true); // 60 degrees off
  scene.Render();
  EXPECT_NEAR(scene.CountDrawnPixels(), 0.5 * PixelsOfADisk(0.5), 0.02 * PixelsOfADisk(0.5));
}

TEST(DiskGeometry, BothSidesAreVisibleUnlessCulled)
{
  SplatScene scene(Disks({ { 0., 0., 0. } }, { { 0., 0., 1. } }, 0.5));
  ExpectBothSidesUnlessCulled(scene, static_cast<int>(0.99 * PixelsOfADisk(0.5)),
    static_cast<int>(1.01 * PixelsOfADisk(0.5)));
}

TEST(DiskGeometry, BoundsIncludeTheDisksAndNeedNoCells)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., DiskRadius);
  vtkNew<vtkSurfaceSplatMapper> mapper;
  mapper->SetInputDataObject(sphere);
  mapper->SetRadiusScale(2.);
  double points[6];
  sphere->GetPoints()->GetBounds(points);
  const double* bounds = mapper->GetBounds();
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], points[i] + (i % 2 ? 2. : -2.) * DiskRadius, 1e-12);
  }
}

TEST(DiskGeometry, GraphicsResourcesAreReleasedAndBuiltAgain)
{
  vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(Count, 1., DiskRadius);
  SplatScene scene(sphere);
  scene.Render();
  ExpectUnitSphere(scene);
  scene.Mapper->ReleaseGraphicsResources(scene.Window);
  scene.Render();
  ExpectUnitSphere(scene);

  // The same mapper in a second window, while the first one still lives.
  vtkNew<vtkRenderWindow> window;
  window->SetSize(64, 64);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(scene.Actor);
  window->AddRenderer(renderer);
  window->Render();
  scene.Render();
  ExpectUnitSphere(scene);
}
