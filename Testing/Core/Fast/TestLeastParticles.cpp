#include "Fast/LeastParticles.h"

#include "Fast/FastDistribution.h"
#include "Topology/SurfaceTopology.h"

#include "AnalyticFields.h"
#include "ElementCases.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

ElementMesh meshOf(const Field& field, Domain domain = Domain::Hexahedron, int degree = 2)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { degree, degree, degree };
  recipe.field = field;
  return makeMesh(recipe);
}

Buffer<Particle> distribute(
  const ElementMesh& mesh, const SizingFunction& sizing, const ParallelFor& parallelFor = {})
{
  DistributionParameters parameters;
  parameters.sizing = sizing;
  return distributeFast({ &mesh, 0.0, 1e-10 }, parameters, {}, parallelFor).particles;
}

/// Closed components smaller than the spacing, anywhere in the mesh: in elements, across faces and in a corner.
class SmallComponents : public ::testing::TestWithParam<Domain>
{
protected:
  /// Expects six particles and more on a surface at each of some places, and at each of some spacings, wherever its
  /// topology is proven: at all places but one.
  template <class FieldAround>
  void expectSix(double size, int degree, const FieldAround& fieldAround) const
  {
    Random random(1);
    int proven = 0;
    constexpr int places = 10;
    for (int n = 0; n < places; ++n)
    {
      const glm::dvec3 center = n == 0 ? glm::dvec3(0.0) : 0.8 * randomVector(random);
      const ElementMesh mesh = meshOf(fieldAround(center), this->GetParam(), degree);
      if (!findTopology(mesh, 0.0, nullptr, {}).isProven())
      {
        continue;
      }
      ++proven;
      for (const double perSize : { 1.0, 1.5, 2.0, 5.0, 40.0 })
      {
        for (const double density : { 0.0, 3.0 })
        {
          EXPECT_GE(distribute(mesh, { perSize * size, density }).size(), LeastParticles)
            << perSize << ' ' << density << ' ' << n;
        }
      }
    }
    EXPECT_GE(proven, places - 1);
  }

  /// x^2/a^2 + y^2/b^2 + z^2/c^2 = 1 around a place.
  static auto ellipsoid(const glm::dvec3& axes)
  {
    return [=](const glm::dvec3& center) -> Field
    {
      return [=](const glm::dvec3& x)
      {
        const glm::dvec3 d = (x - center) / axes;
        return 1.0 - glm::dot(d, d);
      };
    };
  }
};

INSTANTIATE_TEST_SUITE_P(
  Fast, SmallComponents, ::testing::Values(Domain::Hexahedron, Domain::Wedge, Domain::Tetrahedron));

TEST_P(SmallComponents, OfBallsHaveSixParticles)
{
  this->expectSix(0.02, 2, this->ellipsoid(glm::dvec3(0.02)));
}

TEST_P(SmallComponents, OfNeedlesHaveSixParticles)
{
  this->expectSix(0.04, 2, this->ellipsoid({ 0.01, 0.01, 0.04 }));
}

TEST_P(SmallComponents, OfThinDiscsHaveSixParticles)
{
  this->expectSix(0.03, 2, this->ellipsoid({ 0.03, 0.03, 0.006 }));
}

TEST_P(SmallComponents, OfToriHaveSixParticles)
{
  const Field around = torus(0.02, 0.006).field;
  this->expectSix(0.026, 4,
    [=](const glm::dvec3& center) -> Field
    { return [=](const glm::dvec3& x) { return around(x - center); }; });
}

/// A ball beside a sheet.
struct BallAndSheet
{
  static constexpr double Spacing = 0.1;
  double radius = 0.05;
  double gap = 0.05;

  KnownSurface sheet() const { return plane({ 1.0, 0.0, 0.0 }, -(this->gap + this->radius)); }

  ElementMesh mesh() const
  {
    return meshOf(
      bothOf(sphere({ 0.0, 0.0, 0.0 }, this->radius), this->sheet()).field, Domain::Hexahedron, 3);
  }

  bool isOnSheet(const Particle& particle) const
  {
    return particle.position.xyz.x < -this->radius - 0.5 * this->gap;
  }
};

TEST(BallBesideASheet, HasSixParticlesAndTheSheetIsNotRefined)
{
  for (const double perRadius : { 2.0, 10.0 })
  {
    for (const double gap : { 0.02, 0.1, 0.5, 2.0 })
    {
      const BallAndSheet both{ BallAndSheet::Spacing / perRadius, gap * BallAndSheet::Spacing };
      const auto alone = static_cast<double>(
        distribute(meshOf(both.sheet().field), { BallAndSheet::Spacing, 0.0 }).size());
      std::size_t onBall = 0, onSheet = 0;
      for (const Particle& particle : distribute(both.mesh(), { BallAndSheet::Spacing, 0.0 }))
      {
        const bool isOnSheet = both.isOnSheet(particle);
        (isOnSheet ? onSheet : onBall) += 1;
        EXPECT_EQ(particle.spacing == BallAndSheet::Spacing, isOnSheet);
      }
      EXPECT_GE(onBall, LeastParticles) << perRadius << ' ' << gap;
      EXPECT_LE(onBall, 24u) << perRadius << ' ' << gap;
      EXPECT_NEAR(static_cast<double>(onSheet), alone, 0.02 * alone) << perRadius << ' ' << gap;
    }
  }
}

TEST(BallBesideASheet, IsTheSameForAnyNumberOfThreads)
{
  const ElementMesh mesh = BallAndSheet{}.mesh();
  const Buffer<Particle> expected = distribute(mesh, { BallAndSheet::Spacing, 0.0 });
  const Buffer<Particle> found = distribute(mesh, { BallAndSheet::Spacing, 0.0 }, threadedFor(3));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_EQ(found[i].position.xyz, expected[i].position.xyz);
  }
}

/// A ball of which the mesh holds a part, and surfaces with six particles and more, are left as they are.
TEST(SparseComponents, AreClosed)
{
  const auto spacings = [](const KnownSurface& surface, double spacing)
  {
    const Buffer<Particle> particles =
      distribute(meshOf(surface.field, Domain::Hexahedron, 4), { spacing, 0.0 });
    EXPECT_GT(particles.size(), 0u);
    return std::count_if(particles.begin(), particles.end(),
      [&](const Particle& particle) { return particle.spacing != spacing; });
  };
  EXPECT_EQ(spacings(sphere({ 1.0, 0.1, 0.2 }, 0.02), 0.04), 0);
  EXPECT_EQ(spacings(sphere({ 0.1, 0.1, 0.2 }, 0.1), 0.1), 0);
  EXPECT_EQ(spacings(cylinder(0.02), 0.2), 0);
  EXPECT_EQ(spacings(tangleCube(), 0.2), 0);
}

} // namespace
} // namespace hop::testing
