// Splats that are left out as others hide them: many, and none that is seen.
#include "SplatScene.h"

#include "Common/SplatProfile.h"

#include "Drawing/Culling.h"
#include "vtkActor.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceSplatMapper.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace
{
using hop::Culling::Camera;
using hop::Culling::FindVisible;
using hop::Culling::Splats;

constexpr int Pixels = 256;
constexpr double Distance = 4.;
constexpr double HalfHeight = 1.3;

Camera CameraOf(bool parallel)
{
  const auto size = static_cast<float>(HalfHeight);
  const auto angle = static_cast<float>(2. * std::atan(HalfHeight / Distance));
  return { glm::translate(glm::mat4(1.f), { 0.f, 0.f, static_cast<float>(-Distance) }),
    parallel ? glm::ortho(-size, size, -size, size, 1.f, 7.f)
             : glm::perspective(angle, 1.f, 1.f, 7.f),
    parallel, Pixels, Pixels };
}

// Spread evenly (Fibonacci) over the unit sphere, as wide as they are far apart.
struct Sphere
{
  explicit Sphere(int count)
  {
    const auto spacing = static_cast<float>(std::sqrt(8. * M_PI / std::sqrt(3.) / count));
    for (int i = 0; i < count; ++i)
    {
      const double z = 1. - 2. * (i + 0.5) / count;
      const double angle = i * M_PI * (3. - std::sqrt(5.));
      const double radius = std::sqrt(1. - z * z);
      const auto x = static_cast<float>(radius * std::cos(angle));
      const auto y = static_cast<float>(radius * std::sin(angle));
      this->CentreRadius.insert(this->CentreRadius.end(), { x, y, static_cast<float>(z), spacing });
      this->Normal.insert(this->Normal.end(), { x, y, static_cast<float>(z), 0.f });
    }
  }

  Splats AsSplats() const
  {
    return { this->CentreRadius.data(), this->Normal.data(), nullptr, 0, 1, 1.f, 0.75f, 1.f,
      static_cast<float>(hop::splatReach()), 1 };
  }

  std::vector<float> CentreRadius;
  std::vector<float> Normal;
};
}

TEST(SplatCulling, LeavesOutTheFarSideOfASphere)
{
  for (const bool parallel : { true, false })
  {
    const double seen = parallel ? 0.5 : 0.5 * (1. - 1. / Distance);
    for (const int count : { 100000, 1000000 })
    {
      const Sphere sphere(count);
      const std::vector<unsigned int> visible =
        FindVisible(CameraOf(parallel), sphere.AsSplats(), 0, count);
      EXPECT_GT(visible.size(), seen * count);
      EXPECT_LT(visible.size(), (seen + 0.1) * count);
      EXPECT_TRUE(std::is_sorted(visible.begin(), visible.end()));
    }
  }
}

TEST(SplatCulling, MindsPlanesThatCut)
{
  const int count = 100000;
  const Sphere sphere(count);
  std::vector<float> planes(12 * count, 0.f);
  for (int i = 0; i < count; ++i)
  {
    planes[12 * i + 3] = 0.001f; // distance of no plane
  }
  Splats splats = sphere.AsSplats();
  splats.Clip = planes.data();
  splats.ClipStride = 12;
  EXPECT_EQ(FindVisible(CameraOf(true), splats, 0, count),
    FindVisible(CameraOf(true), sphere.AsSplats(), 0, count));
  for (int i = 0; i < count; ++i)
  {
    planes[12 * i + 5] = 1.f;
  }
  EXPECT_EQ(FindVisible(CameraOf(true), splats, 0, count).size(), static_cast<std::size_t>(count));
}

TEST(SplatCulling, TakesEveryStridethOfARange)
{
  const Sphere sphere(100000);
  Splats splats = sphere.AsSplats();
  splats.Stride = 4;
  splats.RadiusScale = 2.f;
  const std::vector<unsigned int> visible = FindVisible(CameraOf(true), splats, 5000, 20000);
  ASSERT_FALSE(visible.empty());
  // A ring of 15,000, of whose two halves the farther one lies behind the nearer one.
  EXPECT_EQ(visible.front(), 5000u);
  EXPECT_LT(visible.size(), 11500u);
}

TEST(SplatCulling, IsForMatricesThatStretchNothing)
{
  const glm::mat4 turned = glm::rotate(glm::mat4(1.f), 0.7f, { 1.f, 2.f, 3.f });
  EXPECT_TRUE(hop::Culling::IsSimilarity(glm::scale(turned, glm::vec3(1e-6f))));
  EXPECT_TRUE(hop::Culling::IsSimilarity(glm::scale(turned, { 5.f, -5.f, 5.f })));
  EXPECT_FALSE(hop::Culling::IsSimilarity(glm::scale(turned, { 1.f, 1.f, 1.01f })));
  glm::mat4 sheared = turned;
  sheared[1] += 0.01f * sheared[0];
  EXPECT_FALSE(hop::Culling::IsSimilarity(sheared));
}

namespace
{
// Splats of up to two pixels anywhere in a cube, in any direction, half of them cut by a plane.
vtkSmartPointer<vtkPolyData> Cloud(int count, double radius)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1., 1.);
  const auto place = [&]()
  { return glm::dvec3(anywhere(random), anywhere(random), anywhere(random)); };
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  vtkNew<vtkDoubleArray> clipNormals;
  clipNormals->SetName("Clip_Normal");
  clipNormals->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> clipDistances;
  clipDistances->SetName("Clip_Distance");
  for (int i = 0; i < count; ++i)
  {
    positions.push_back(place());
    normals.push_back(glm::normalize(place()));
    const glm::dvec3 across = glm::normalize(glm::cross(normals.back(), place()));
    const glm::dvec3 clip = i % 2 == 0 ? across : glm::dvec3(0.);
    clipNormals->InsertNextTuple(&clip.x);
    clipDistances->InsertNextValue(0.3 * radius);
  }
  vtkSmartPointer<vtkPolyData> cloud = Disks(positions, normals, radius);
  cloud->GetPointData()->AddArray(clipNormals);
  cloud->GetPointData()->AddArray(clipDistances);
  return cloud;
}

struct Picture
{
  std::vector<glm::dvec3> Colors;
  std::vector<std::optional<glm::dvec3>> Positions;
};

Picture PictureOf(SplatScene& scene)
{
  scene.Render();
  Picture picture;
  for (int y = 0; y < SplatScene::Size; ++y)
  {
    for (int x = 0; x < SplatScene::Size; ++x)
    {
      picture.Colors.push_back(scene.ColorAt(x, y));
      picture.Positions.push_back(scene.PositionAt(x, y));
    }
  }
  return picture;
}

// With a clipping plane, even one that cuts nothing, every splat is drawn.
void ExpectTheSameWithAllSplats(
  vtkPolyData* particles, const SceneView& view, double distance, double halfHeight)
{
  SplatScene scene(particles);
  scene.Mapper->SetModeToSplats();
  scene.LookFrom(view.Direction, view.Parallel, distance, halfHeight);
  scene.Actor->RotateWXYZ(33., 1., 2., 3.);
  const Picture culled = PictureOf(scene);
  vtkNew<vtkPlane> far;
  far->SetOrigin(0., 0., -100.);
  scene.Mapper->AddClippingPlane(far);
  const Picture whole = PictureOf(scene);
  EXPECT_TRUE(culled.Colors == whole.Colors) << view << ", " << halfHeight;
  EXPECT_TRUE(culled.Positions == whole.Positions) << view << ", " << halfHeight;
  EXPECT_GT(scene.CountDrawnPixels(), 5000);
}

struct Lens
{
  double Distance;
  double HalfHeight;
};

void ExpectTheSameFromAllSides(
  const std::vector<vtkSmartPointer<vtkPolyData>>& clouds, const std::vector<Lens>& lenses)
{
  for (const vtkSmartPointer<vtkPolyData>& particles : clouds)
  {
    for (const SceneView& view : { SphereViews[1], SphereViews[2] }) // parallel, and in perspective
    {
      for (const Lens& lens : lenses)
      {
        ExpectTheSameWithAllSplats(particles, view, lens.Distance, lens.HalfHeight);
      }
    }
  }
}
}

TEST(SplatCulling, ChangesNoPixelOfPoints)
{
  ExpectTheSameFromAllSides(
    { FibonacciSphere(150000, 1., 0.009), Cloud(200000, 0.0115), Cloud(40000, 0.0115) },
    { { 12., 0.9 }, { 12., 2. }, { 2.5, 2. } });
}

TEST(SplatCulling, ChangesNoPixelOfTriangles)
{
  // The eye of the last one is among the splats.
  ExpectTheSameFromAllSides(
    { FibonacciSphere(6800, 1., 0.0462), Cloud(50000, 0.03), Cloud(5000, 0.06) },
    { { 12., 0.9 }, { 2.5, 2. }, { 0.8, 0.6 } });
}

TEST(SplatCulling, LeavesNothingBesideTheView)
{
  SplatScene scene(FibonacciSphere(150000, 1., 0.009));
  scene.Mapper->SetModeToSplats();
  scene.LookFrom({ 0., 0., 1. }, true);
  scene.Render();
  EXPECT_GT(scene.CountDrawnPixels(), 20000);
  scene.Actor->SetPosition(3., 0., 0.);
  scene.Render();
  EXPECT_EQ(scene.CountDrawnPixels(), 0);
  scene.Actor->SetPosition(0., 0., 0.);
  scene.Render();
  EXPECT_GT(scene.CountDrawnPixels(), 20000);
}
