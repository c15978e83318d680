// Where splats draw the surface: depth and normals against the analytic sphere, clipping, extremes.
#include "SplatScene.h"

#include "vtkActor.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
constexpr double Spacing = 0.0539; // of 5,000 particles on the unit sphere; the filter's radius

class SplatsOnSphere : public testing::TestWithParam<SceneView>
{
};

void UseSplats(SplatScene& scene, SceneView view)
{
  scene.Mapper->SetModeToSplats();
  scene.LookFrom(view.Direction, view.Parallel);
}

// The pixels of a sphere are on it to 0.02 spacings along the view ray, and none is missing.
void ExpectSphere(const SplatScene& scene, int atLeast = 15000)
{
  ForEachPlaceOnSphere(
    scene,
    [](glm::dvec3 seen, glm::dvec3 onSphere)
    { ASSERT_LT(glm::distance(seen, onSphere), 0.02 * Spacing); },
    atLeast);
}
}

TEST_P(SplatsOnSphere, DepthIsTheSphereWithoutHoles)
{
  SplatScene scene(FibonacciSphere(Count, 1., Spacing));
  UseSplats(scene, GetParam());
  scene.Render();
  ExpectSphere(scene);
}

TEST_P(SplatsOnSphere, DepthIsRightAtCoordinatesOfAMillion)
{
  const glm::dvec3 centre(1e6, -2e6, 3e6);
  SplatScene scene(FibonacciSphere(Count, 1., Spacing, centre), centre);
  UseSplats(scene, GetParam());
  scene.Render();
  ExpectSphere(scene);
}

TEST_P(SplatsOnSphere, TheOutlineIsTheSpheres)
{
  SplatScene scene(FibonacciSphere(Count, 1., Spacing));
  UseSplats(scene, GetParam());
  scene.Render();
  int expected = 0;
  int different = 0;
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < SplatScene::Size; ++x)
    {
      const bool hit = scene.HitSphere(x, y, 1.).has_value();
      expected += hit;
      different += hit != scene.PositionAt(x, y).has_value();
    }
  }
  EXPECT_LT(different, 0.005 * expected) << "of " << expected;
}

// Particles that stand far apart touch with their rims, where weights may be as small as 1e-8.
TEST(SplatGeometry, TheSurfaceEndsWhereItDoesWhateverTheSharpness)
{
  SplatScene scene(FibonacciSphere(Count, 1., 0.75 * Spacing));
  UseSplats(scene, SphereViews[0]);
  scene.Render();
  const int drawn = scene.CountDrawnPixels();
  for (const double sharpness : { 0.1, 5., 10., 20. })
  {
    SCOPED_TRACE(sharpness);
    scene.Mapper->SetSharpness(sharpness);
    scene.Render();
    EXPECT_NEAR(scene.CountDrawnPixels(), drawn, 0.002 * drawn);
    ForEachPlaceOnSphere(scene,
      [](glm::dvec3 seen, glm::dvec3 onSphere)
      { ASSERT_LT(glm::distance(seen, onSphere), 0.05 * Spacing); });
  }
}

TEST_P(SplatsOnSphere, NormalsAreTheSpheres)
{
  SplatScene scene(FibonacciSphere(Count, 1., Spacing));
  UseSplats(scene, GetParam());
  scene.ShowNormals();
  scene.Render();

  scene.ForEachPixelOnSphere(1., Inside,
    [&](int x, int y, glm::dvec3 expected)
    {
      const glm::dvec3 normal = scene.NormalAt(x, y);
      const double angle = std::acos(std::clamp(glm::dot(normal, expected), -1., 1.));
      ASSERT_LT(glm::degrees(angle), 1.2) << "at pixel " << x << ", " << y;
    });
}

TEST_P(SplatsOnSphere, ClippingPlanesCutThroughSplats)
{
  for (const glm::dvec3& centre : { glm::dvec3(0.), glm::dvec3(1e6, -2e6, 3e6) })
  {
    SplatScene scene(FibonacciSphere(Count, 1., Spacing, centre), centre);
    scene.Mapper->SetModeToSplats();
    ExpectClippingPlaneCuts(scene, GetParam(), centre, 0.005, 0.02 * Spacing);
    // The plane is gone, the camera stands still.
    scene.Render();
    ExpectSphere(scene);
  }
}

INSTANTIATE_TEST_SUITE_P(Views, SplatsOnSphere, testing::ValuesIn(SphereViews));

TEST(SplatGeometry, SplatsBendWithTheSurface)
{
  // Two hundred particles make a sphere whose normals differ by 15 degrees from one to the next. The
  // outline and the depth are the sphere's only if splats are no flat disks.
  constexpr double spacing = 0.269;
  const SceneView views[] = { { { 0.3, -0.5, 1. }, false }, { { 0.3, -0.5, 1. }, true } };
  for (const SceneView& view : views)
  {
    double worst[2] = { 0., 0. }; // flat, bent; share of a spacing
    int different[2] = { 0, 0 };  // pixels at the outline
    for (int bent : { 0, 1 })
    {
      vtkSmartPointer<vtkPolyData> sphere = FibonacciSphere(200, 1., spacing);
      if (bent)
      {
        AddShapeOfSphere(sphere, 1.);
      }
      SplatScene scene(sphere);
      UseSplats(scene, view);
      scene.Render();
      scene.ForEachPixelOnSphere(1., Inside,
        [&](int x, int y, glm::dvec3 onSphere)
        {
          const auto position = scene.PositionAt(x, y);
          ASSERT_TRUE(position);
          worst[bent] = std::max(worst[bent], glm::distance(*position, onSphere) / spacing);
        });
      for (int i = 0; i < SplatScene::Size * SplatScene::Size; ++i)
      {
        const int x = i % SplatScene::Size;
        const int y = i / SplatScene::Size;
        different[bent] +=
          scene.HitSphere(x, y, 1.).has_value() != scene.PositionAt(x, y).has_value();
      }
    }
    EXPECT_LT(worst[1], 0.02) << view;
    EXPECT_LT(worst[1], 0.5 * worst[0]) << view;
    EXPECT_LT(different[1], 0.005 * M_PI * 98. * 98.) << view;
    EXPECT_LT(different[1], 0.5 * different[0]) << view;
  }
}

TEST(SplatGeometry, SplatsEndWhereTheirNormalsDifferBy45Degrees)
{
  // One particle alone on a sphere a quarter as large as its splat: a paraboloid whose normal differs
  // by 45 degrees at one radius of the sphere from the axis, half a radius below the particle.
  constexpr double radius = 0.25;
  constexpr double pixel = 2.6 / SplatScene::Size;
  vtkSmartPointer<vtkPolyData> particle = Disks({ { 0., 0., radius } }, { { 0., 0., 1. } }, 1.);
  AddShapeOfSphere(particle, radius);
  SplatScene scene(particle);
  for (glm::dvec3 from : { glm::dvec3(0., 0., 1.), glm::dvec3(1., 0., 0.2) })
  {
    UseSplats(scene, { from, true });
    scene.Render();
    double farthest = 0.;
    const int drawn = scene.ForEachDrawnPixel(
      [&](int, int, glm::dvec3 position)
      {
        farthest = std::max(farthest, std::hypot(position.x, position.y));
        EXPECT_GT(position.z, 0.5 * radius - 2. * pixel);
      });
    EXPECT_NEAR(farthest, radius, 2. * pixel);
    EXPECT_GT(drawn, 0.2 * M_PI * radius * radius / (pixel * pixel));
  }
}

TEST(SplatGeometry, FollowsTheActorsTransformEvenIfItStretches)
{
  for (double mirror : { 1., -1. })
  {
    SplatScene scene(FibonacciSphere(Count, 1., Spacing));
    scene.Mapper->SetModeToSplats();
    ExpectStretchedSphere(
      scene, { 0.3 * mirror, 1., 0.8 }, 1. - 0.1 * Spacing, 1. + 0.1 * Spacing, 5000);
  }
}

TEST(SplatGeometry, OneSplatMayFillTheWindow)
{
  // From 0.05 above the surface the window shows half a splat; others lie across the near plane and
  // behind the eye.
  for (bool parallel : { false, true })
  {
    SplatScene scene(FibonacciSphere(Count, 1., Spacing));
    scene.Mapper->SetModeToSplats();
    scene.LookFrom({ 0.2, 0.3, 1. }, parallel, 1.05, parallel ? 0.025 : 1.05 * 0.5);
    scene.Render();
    int covered = 0;
    for (int y = 0; y < SplatScene::Size; ++y)
    {
      for (int x = 0; x < SplatScene::Size; ++x)
      {
        const auto onSphere = scene.HitSphere(x, y, 1.);
        const auto position = scene.PositionAt(x, y);
        if (onSphere && position && glm::length(*onSphere) > 0.)
        {
          ASSERT_LT(glm::distance(*position, *onSphere), 0.03 * Spacing);
          ++covered;
        }
      }
    }
    EXPECT_GT(covered, 0.95 * SplatScene::Size * SplatScene::Size);
  }
}

TEST(SplatGeometry, WindowsOfAnySizeAreDrawnToTheirEdges)
{
  SplatScene scene(FibonacciSphere(Count, 1., Spacing));
  scene.Mapper->SetModeToSplats();
  scene.ShowPlainColors();
  scene.LookFrom({ 0., 0., 1. }, false, 0.3, 0.3); // from within
  for (int size = 100; size < 109; ++size)
  {
    scene.Window->SetSize(size + 3, size);
    scene.Window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    scene.Window->GetPixelData(0, 0, size + 2, size - 1, 0, pixels);
    EXPECT_EQ(pixels->GetNumberOfTuples(), size * (size + 3));
    EXPECT_GT(pixels->GetRange(0)[0], 250.) << size;
  }
}

TEST(SplatGeometry, AHundredSplatsMayShareAPixel)
{
  SplatScene scene(FibonacciSphere(200000, 1., 0.0085));
  scene.Mapper->SetModeToSplats();
  scene.LookFrom({ 0.2, 0.3, 1. }, true, 4., 8.); // 32 pixels across: 250 particles a pixel
  scene.Render();
  ExpectSphere(scene, 500);
  EXPECT_NEAR(scene.CountDrawnPixels(), M_PI * 16. * 16., 30.);
}

TEST(SplatGeometry, BothSidesAreVisibleUnlessCulled)
{
  SplatScene scene(Disks({ { 0., 0., 0. } }, { { 0., 0., 1. } }, 0.5));
  scene.Mapper->SetModeToSplats();
  ExpectBothSidesUnlessCulled(scene, 5000, SplatScene::Size * SplatScene::Size / 4);
}

TEST(SplatGeometry, EveryFourthParticleStillShowsTheSurface)
{
  SplatScene scene(FibonacciSphere(Count, 1., Spacing));
  UseSplats(scene, { { 1., 1., 2. }, false });
  scene.Mapper->SetStride(4);
  scene.Render();
  ForEachPlaceOnSphere(scene,
    [](glm::dvec3 seen, glm::dvec3 onSphere)
    { ASSERT_LT(glm::distance(seen, onSphere), 0.2 * Spacing); });
  scene.Mapper->SetStride(1);
  scene.Render();
  ExpectSphere(scene);
}

namespace
{
// Of a white unit sphere on black, unlit.
void ExpectSmoothOutline(const SplatScene& scene)
{
  int partly = 0;
  double sum = 0.;
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < SplatScene::Size; ++x)
    {
      // The share of the pixel inside of the true outline.
      constexpr int samples = 8;
      int inside = 0;
      for (int i = 0; i < samples * samples; ++i)
      {
        const glm::dvec2 offset(
          (i % samples + 0.5) / samples - 0.5, (i / samples + 0.5) / samples - 0.5);
        inside += scene.HitSphere(x + offset.x, y + offset.y, 1.).has_value();
      }
      const double expected = static_cast<double>(inside) / (samples * samples);
      const double error = std::abs(scene.ColorAt(x, y).r / 255. - expected);
      ASSERT_LT(error, 0.5) << "at pixel " << x << ", " << y;
      const bool atOutline = expected > 0.02 && expected < 0.98;
      partly += atOutline;
      sum += atOutline ? error : 0.;
    }
  }
  ASSERT_GT(partly, 300);
  EXPECT_LT(sum / partly, 0.14); // 0.25 with pixels that are covered or not
}

// Of a white unit sphere on black, lit from the eye.
void ExpectDarkOutline(const SplatScene& scene)
{
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < SplatScene::Size; ++x)
    {
      const auto hit = scene.HitSphere(x, y, 1.);
      const double facing = hit ? glm::dot(*hit, scene.ToEye(*hit)) : 0.;
      ASSERT_LT(scene.ColorAt(x, y).r / 255., facing + 0.3) << "at pixel " << x << ", " << y;
    }
  }
}

// The unit sphere, white, and a black wall that faces the viewer behind it.
vtkSmartPointer<vtkPolyData> SphereBeforeWall(glm::dvec3 toViewer)
{
  const glm::dvec3 back = glm::normalize(toViewer);
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0., 1., 0.), back));
  const glm::dvec3 up = glm::cross(back, right);
  vtkSmartPointer<vtkPolyData> both = FibonacciSphere(Count, 1., Spacing);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(Count);
  colors->Fill(255.);
  const double black[3] = { 0., 0., 0. };
  constexpr double radius = 0.1;
  for (int i = 0; i < 80 * 80; ++i)
  {
    const glm::dvec3 place = radius * ((i % 80 - 39.5) * right + (i / 80 - 39.5) * up) - 2. * back;
    both->GetPoints()->InsertNextPoint(place.x, place.y, place.z);
    both->GetPointData()->GetNormals()->InsertNextTuple(&back.x);
    both->GetPointData()->GetArray("Radius")->InsertNextTuple(&radius);
    colors->InsertNextTuple(black);
  }
  both->GetPointData()->SetScalars(colors);
  return both;
}
}

TEST(SplatGeometry, OutlinesAreSmooth)
{
  for (bool parallel : { false, true })
  {
    SplatScene scene(FibonacciSphere(Count, 1., Spacing));
    UseSplats(scene, { { 0.3, 0.5, 1. }, parallel });
    scene.ShowPlainColors();
    scene.Render();
    ExpectSmoothOutline(scene);
  }
}

TEST(SplatGeometry, OutlinesBeforeTheSurfaceItselfAreSmooth)
{
  const glm::dvec3 direction(0.3, 0.5, 1.);
  for (bool parallel : { false, true })
  {
    SplatScene scene(SphereBeforeWall(direction));
    UseSplats(scene, { direction, parallel });
    scene.Mapper->SetColorModeToDirectScalars();
    scene.Render();
    ExpectDarkOutline(scene);
    scene.ShowPlainColors();
    scene.Render();
    ExpectSmoothOutline(scene);
    ExpectSphere(scene); // what is mixed leaves the depth as it was
  }
}
