// How exactly splats show surfaces that are no sphere, held against rays through the true polynomials.
// Testing/Benchmarks/splat_accuracy prints the same figures at full size for all views and cases.
#include "SurfaceCases.h"
#include "SurfacePicture.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSurfaceSplatMapper.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{
struct Bounds
{
  std::string Name;
  double IntersectionOverUnion;
  double DepthShare;
  double NormalShare;
  double PeakSignalToNoise;
  int Size = 160; // pixels both ways
  // In perspective, and in parallel, too, where a surface is cast quickly: it is the same for all.
  std::vector<bool> Projections = { false };
};

class SplatAccuracyOf : public testing::TestWithParam<Bounds>
{
};

PictureFigures FiguresOf(const SurfaceCase& surface, const hop::testing::PictureCamera& camera)
{
  vtkNew<vtkSurfaceSplatMapper> mapper;
  mapper->SetInputData(surface.Particles);
  mapper->ScalarVisibilityOff();
  return Compare(
    DrawSurface(mapper, camera), CastSurface(surface, camera), camera, surface.Spacing);
}
}

TEST_P(SplatAccuracyOf, IsWithinItsBounds)
{
  const Bounds& bounds = GetParam();
  const SurfaceCase surface = MakeSurfaceCase(bounds.Name);
  for (bool parallel : bounds.Projections)
  {
    const PictureFigures figures =
      FiguresOf(surface, CamerasAround(surface, parallel, bounds.Size)[2]);
    EXPECT_GT(figures.IntersectionOverUnion, bounds.IntersectionOverUnion);
    EXPECT_GT(figures.DepthShare, bounds.DepthShare);
    EXPECT_GT(figures.NormalShare, bounds.NormalShare);
    EXPECT_GT(figures.PeakSignalToNoise, bounds.PeakSignalToNoise);
    EXPECT_EQ(figures.Holes, 0);
  }
}

// Most of the surface is seen all but edge-on: depths are off by more than what they are made of.
TEST(SplatAccuracy, SurfaceSeenEdgeOnIsAsNearAsElsewhere)
{
  const SurfaceCase surface = MakeSurfaceCase("cylinder");
  for (bool parallel : { false, true })
  {
    const PictureFigures figures = FiguresOf(surface, CamerasAround(surface, parallel, 256)[0]);
    EXPECT_GT(figures.IntersectionOverUnion, 0.99);
    EXPECT_GT(figures.OffsetShare, 0.99);
    EXPECT_GT(figures.NormalShare, 0.99);
    EXPECT_EQ(figures.Holes, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, SplatAccuracyOf,
  testing::Values(Bounds{ "sphere", 0.995, 0.99, 0.99, 40., 160, { false, true } },
    Bounds{ "torus", 0.995, 0.99, 0.99, 40. }, Bounds{ "boundary", 0.995, 0.99, 0.99, 40. },
    Bounds{ "crease", 0.995, 0.99, 0.99, 40. }, Bounds{ "hexahedron", 0.995, 0.99, 0.99, 40. },
    Bounds{ "cylinder", 0.995, 0.99, 0.99, 40., 256, { false, true } }),
  [](const testing::TestParamInfo<Bounds>& which) { return which.param.Name; });
