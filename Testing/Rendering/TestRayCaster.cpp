// The ray caster that pictures are held against, itself held against a plane.
#include "RayCaster.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>

using hop::testing::castRays;
using hop::testing::MeshRecipe;
using hop::testing::PictureCamera;
using hop::testing::SeenPoint;

namespace
{
// Seen at a slant, so that the face x = 0 runs obliquely through the picture, which lies within the cube.
PictureCamera Camera()
{
  PictureCamera camera;
  camera.back = glm::normalize(glm::dvec3(-1., 0.4, 0.5));
  camera.parallel = true;
  camera.halfHeight = 0.15;
  camera.size = 128;
  return camera;
}

// The plane z = y / 2, on the side of x > 0 higher by a step.
std::vector<SeenPoint> CastStep(double height)
{
  MeshRecipe left;
  left.field = [](const glm::dvec3& x) { return x.z - 0.5 * x.y; };
  MeshRecipe right;
  right.field = [height](const glm::dvec3& x) { return x.z - 0.5 * x.y - height; };
  return castRays(hop::testing::hangingMesh(left, right), 0., Camera(), {});
}

int CountMissed(const std::vector<SeenPoint>& picture)
{
  return static_cast<int>(std::count_if(
    picture.begin(), picture.end(), [](const SeenPoint& seen) { return !seen.covered(); }));
}
}

TEST(RayCaster, SeesAPlane)
{
  const PictureCamera camera = Camera();
  const std::vector<SeenPoint> picture = CastStep(0.);
  for (int i = 0; i < camera.size * camera.size; ++i)
  {
    const PictureCamera::Ray ray = camera.ray(i % camera.size + 0.5, i / camera.size + 0.5);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0., -0.5, 1.));
    const double depth = -glm::dot(ray.origin, normal) / glm::dot(ray.direction, normal);
    ASSERT_NEAR(picture[i].depth, depth, 1e-9);
    ASSERT_NEAR(std::abs(glm::dot(picture[i].normal, normal)), 1., 1e-9);
  }
}

TEST(RayCaster, ClosesSlitsBetweenElementsThatAreNarrowerThanPixels)
{
  const double pixel = Camera().pixel();
  EXPECT_EQ(CountMissed(CastStep(0.05 * pixel)), 0);
  EXPECT_GT(CountMissed(CastStep(2. * pixel)), 50); // a hole is a hole
}
