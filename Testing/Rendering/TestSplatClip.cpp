// The planes that particles carry beside boundary curves and creases: what is cut off, and what fills gaps.
#include "SplatScene.h"

#include "Particles/SplatParticles.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSurfaceSplatMapper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
// A point array; `values` tuple by tuple.
void AddArray(
  vtkPolyData* particles, const char* name, int components, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (std::size_t first = 0; first < values.size(); first += components)
  {
    array->InsertNextTuple(&values[first]);
  }
  particles->GetPointData()->AddArray(array);
}

// Where a pixel lies in the plane z = 0, in the parallel view along z.
glm::dvec3 PlaceOf(int x, int y)
{
  const double scale = 1.3 / (SplatScene::Size / 2);
  return scale * (glm::dvec3(x + 0.5, y + 0.5, 0.) - glm::dvec3(128., 128., 0.));
}

// Of the pixels that a whole splat would draw, those are left for which `isKept` holds.
void ExpectCut(const std::vector<double>& normals, const std::vector<double>& distances,
  const std::function<bool(glm::dvec3)>& isKept, const std::vector<double>& curvatures = {})
{
  for (int mode : { vtkSurfaceSplatMapper::Splats, vtkSurfaceSplatMapper::Disks })
  {
    vtkSmartPointer<vtkPolyData> particle = Disks({ { 0., 0., 0. } }, { { 0., 0., 1. } }, 0.8);
    SplatScene scene(particle);
    scene.Mapper->SetMode(mode);
    scene.LookFrom({ 0., 0., 1. }, true);
    scene.Render();
    std::vector<glm::ivec2> whole;
    scene.ForEachDrawnPixel([&](int x, int y, glm::dvec3) { whole.emplace_back(x, y); });
    ASSERT_GT(whole.size(), 10000u);
    AddArray(particle, "Clip_Normal", static_cast<int>(normals.size()), normals);
    AddArray(particle, "Clip_Distance", static_cast<int>(distances.size()), distances);
    if (!curvatures.empty())
    {
      AddArray(particle, "Clip_Curvature", static_cast<int>(curvatures.size()), curvatures);
    }
    scene.Render();
    for (const glm::ivec2& pixel : whole)
    {
      const glm::dvec3 place = PlaceOf(pixel.x, pixel.y);
      ASSERT_EQ(scene.PositionAt(pixel.x, pixel.y).has_value(), isKept(place))
        << "mode " << mode << ", at " << place.x << " " << place.y;
    }
  }
}
}

TEST(SplatClip, APlaneCutsItsParticlesSplatInALine)
{
  ExpectCut({ 1., 0., 0. }, { 0.2 }, [](glm::dvec3 p) { return p.x < 0.2; });
  ExpectCut({ 0.6, 0.8, 0. }, { 0. }, [](glm::dvec3 p) { return 0.6 * p.x + 0.8 * p.y < 0.; });
}

TEST(SplatClip, ASplatCanBeCutByTwoPlanes)
{
  ExpectCut({ 1., 0., 0., 0., -1., 0. }, { 0.2, 0.1 },
    [](glm::dvec3 p) { return p.x < 0.2 && p.y > -0.1; });
}

// As a triangle has them: a particle in a narrow corner of the surface, or at the end of a strip.
TEST(SplatClip, ASplatCanBeCutByThreePlanes)
{
  ExpectCut({ 1., 0., 0., 0., -1., 0., -0.6, 0.8, 0. }, { 0.2, 0.1, 0.3 },
    [](glm::dvec3 p) { return p.x < 0.2 && p.y > -0.1 && -0.6 * p.x + 0.8 * p.y < 0.3; });
  ExpectCut({ 1., 0., 0., 0., -1., 0., -1., 0., 0. }, { 0.2, 0.1, 0.3 },
    [](glm::dvec3 p) { return p.x < 0.2 && p.y > -0.1 && -p.x < 0.3 + 0.4 * p.y * p.y; },
    { 0., 0., 0.8 });
}

TEST(SplatClip, EdgesMayBeCurved)
{
  ExpectCut({ 0.6, 0.8, 0. }, { 0.1 },
    [](glm::dvec3 p)
    {
      const double along = 0.8 * p.x - 0.6 * p.y;
      return 0.6 * p.x + 0.8 * p.y < 0.1 + 0.5 * 1.2 * along * along;
    },
    { 1.2 });
  ExpectCut({ 1., 0., 0., 0., -1., 0. }, { 0.2, 0.1 },
    [](glm::dvec3 p) { return p.x < 0.2 + 0.3 * p.y * p.y && -p.y < 0.1 - 0.45 * p.x * p.x; },
    { 0.6, -0.9 });
}

TEST(SplatClip, CurvaturesThatAreNoNumbersAreOfLines)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ExpectCut({ 1., 0., 0. }, { 0.2 }, [](glm::dvec3 p) { return p.x < 0.2; }, { nan });
}

TEST(SplatClip, PlanesWithoutDirectionOrNumberCutNothing)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ExpectCut({ 0., 0., 0. }, { 0. }, [](glm::dvec3) { return true; });
  ExpectCut({ nan, 0., 1. }, { 0. }, [](glm::dvec3) { return true; });
  ExpectCut({ 1., 0., 0. }, { nan }, [](glm::dvec3) { return true; });
}

namespace
{
constexpr double Radius = 0.8;

// Two disks that would meet at x = 0, each with a plane at the distance `before` before it.
vtkSmartPointer<vtkPolyData> Roof(double degrees, double before, bool hasAngles = true)
{
  const double half = glm::radians(0.5 * degrees);
  vtkSmartPointer<vtkPolyData> disks = Disks({ { -0.25, 0., 0. }, { 0.25, 0., 0. } },
    { { -std::sin(half), 0., std::cos(half) }, { std::sin(half), 0., std::cos(half) } }, Radius);
  AddArray(disks, "Clip_Normal", 3, { 1., 0., 0., -1., 0., 0. });
  AddArray(disks, "Clip_Distance", 1, { 0.25 - before, 0.25 - before });
  if (hasAngles)
  {
    AddArray(disks, "Clip_Angle", 1, { degrees, degrees });
  }
  return disks;
}

// Half the width of the gap that is left in the middle of a roof, 0 if there is none. Fails the test unless,
// of splats, each side has its own normal up to its plane.
double GapOf(vtkPolyData* roof, int mode, double degrees, double before)
{
  SplatScene scene(roof);
  scene.Mapper->SetMode(mode);
  scene.LookFrom({ 0., 0., 1. }, true);
  scene.ShowNormals();
  scene.Render();
  double gap = 0.;
  for (int x = 90; x < SplatScene::Size - 90; ++x)
  {
    const double place = PlaceOf(x, 0).x;
    const double angle = glm::radians(0.5 * std::copysign(degrees, place));
    if (!scene.PositionAt(x, SplatScene::Size / 2))
    {
      gap = std::max(gap, std::abs(place));
    }
    else if (mode == vtkSurfaceSplatMapper::Splats && std::abs(place) > before)
    {
      EXPECT_NEAR(scene.NormalAt(x, SplatScene::Size / 2).x, std::sin(angle), 0.01)
        << "at " << place;
    }
  }
  return gap;
}

constexpr double Pixel = 2.6 / SplatScene::Size;
}

TEST(SplatClip, WhereTheSurfaceIsAlmostSmoothSplatsFillWholeGaps)
{
  for (const double before : { 0., 0.2 })
  {
    EXPECT_EQ(GapOf(Roof(9., before), vtkSurfaceSplatMapper::Splats, 9., before), 0.);
  }
}

// Seen from the side, splats that go on over the ridge of a roof stand above it.
TEST(SplatClip, WhereTheSurfaceIsAlmostSmoothSplatsHardlyStandOut)
{
  constexpr double halfHeight = 0.1;
  constexpr double pixel = 2. * halfHeight / SplatScene::Size;
  SplatScene scene(Roof(9., 0.));
  scene.Mapper->SetMode(vtkSurfaceSplatMapper::Splats);
  scene.LookFrom({ 1., 0., 0. }, true, 4., halfHeight);
  scene.Render();
  int top = 0; // the left of the picture is above
  while (top < SplatScene::Size && !scene.PositionAt(top, SplatScene::Size / 2))
  {
    ++top;
  }
  const double beyondRidge = Radius * hop::SplatParticles::OverlapAt(9.);
  EXPECT_NEAR(pixel * (SplatScene::Size / 2 - top),
    (0.25 + beyondRidge) * std::tan(glm::radians(4.5)), 2. * pixel);
  EXPECT_LT(beyondRidge, 0.4 * Radius);
}

TEST(SplatClip, AtCreasesSplatsFillSmallGapsAndStaySharp)
{
  for (const double degrees : { 12., 60., 80. })
  {
    const double overlap = Radius * hop::SplatParticles::OverlapAt(degrees);
    EXPECT_GT(overlap, 0.) << degrees;
    EXPECT_LT(overlap, 0.16 * Radius) << degrees;
    const auto gap = [&](double before)
    { return GapOf(Roof(degrees, before), vtkSurfaceSplatMapper::Splats, degrees, before); };
    EXPECT_EQ(gap(0.), 0.) << degrees;
    EXPECT_EQ(gap(0.9 * overlap), 0.) << degrees;
    EXPECT_NEAR(gap(0.2), 0.2 - overlap, Pixel) << degrees;
  }
}

// However aslant a plane passes the splat, what lies behind it is measured along the splat. Where the surface jumps at
// a face, more would hide the gap between its two sides.
TEST(SplatClip, GapsAreFilledAsFarBehindSlantedPlanes)
{
  for (const double degrees : { 5., 12. })
  {
    for (const double cosine : { 1., 0.4 })
    {
      vtkSmartPointer<vtkPolyData> disk = Disks({ { 0., 0., 0. } }, { { 0., 0., 1. } }, Radius);
      AddArray(disk, "Clip_Normal", 3, { cosine, 0., std::sqrt(1. - cosine * cosine) });
      AddArray(disk, "Clip_Distance", 1, { 0.2 * cosine });
      AddArray(disk, "Clip_Angle", 1, { degrees });
      SplatScene scene(disk);
      scene.Mapper->SetModeToSplats();
      scene.LookFrom({ 0., 0., 1. }, true);
      scene.Render();
      double farthest = 0.;
      scene.ForEachDrawnPixel(
        [&](int, int, glm::dvec3 place) { farthest = std::max(farthest, place.x); });
      EXPECT_NEAR(farthest, 0.2 + Radius * hop::SplatParticles::OverlapAt(degrees), Pixel)
        << degrees << ", " << cosine;
    }
  }
}

TEST(SplatClip, NothingIsFilledAtSharpCreasesAndBoundariesNorWithoutAngles)
{
  for (const double degrees : { 91., 150., 180. })
  {
    EXPECT_EQ(hop::SplatParticles::OverlapAt(degrees), 0.) << degrees;
  }
  EXPECT_NEAR(GapOf(Roof(120., 0.2), vtkSurfaceSplatMapper::Splats, 120., 0.2), 0.2, Pixel);
  EXPECT_NEAR(GapOf(Roof(4., 0.2, false), vtkSurfaceSplatMapper::Splats, 4., 0.2), 0.2, Pixel);
}

TEST(SplatClip, AnglesThatAreNoNumbersAreOfBoundaries)
{
  EXPECT_EQ(hop::SplatParticles::OverlapAt(std::numeric_limits<double>::quiet_NaN()), 0.);
  EXPECT_GE(
    hop::SplatParticles::OverlapAt(0.), 1.); // nobody is behind: the whole splat fills the gap
}

TEST(SplatClip, DisksGoOnWhereTheSurfaceIsAlmostSmooth)
{
  EXPECT_EQ(GapOf(Roof(4., 0.2), vtkSurfaceSplatMapper::Disks, 4., 0.2), 0.);
  EXPECT_NEAR(GapOf(Roof(60., 0.2), vtkSurfaceSplatMapper::Disks, 60., 0.2), 0.2, Pixel);
}
