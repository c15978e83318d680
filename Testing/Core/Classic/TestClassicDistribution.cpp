#include "Classic/ClassicDistribution.h"

#include "AnalyticFields.h"
#include "DistributionMeasures.h"
#include "ElementCases.h"
#include "OpenCases.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>

namespace hop::testing
{
namespace
{

constexpr double tolerance = 1e-9;

Distribution distribute(const ElementMesh& mesh, const DistributionParameters& parameters,
  const Monitor& monitor = {}, const ParallelFor& parallelFor = {})
{
  return distributeClassic({ &mesh, 0.0, tolerance }, parameters, monitor, parallelFor);
}

DistributionParameters withSpacing(double spacing, double angularDensity = 0.0)
{
  DistributionParameters parameters;
  parameters.sizing = { spacing, angularDensity };
  return parameters;
}

/// A straight mesh of hexahedra that holds the surface exactly.
ElementMesh straightMesh(const KnownSurface& surface, int cells = 2)
{
  MeshRecipe recipe;
  recipe.degrees = { surface.degree, surface.degree, surface.degree };
  recipe.cells = cells;
  recipe.field = surface.field;
  return makeMesh(recipe);
}

/// What every particle promises: a place on the surface, and the position, normal, residual and
/// spacing that belong to it.
void expectHonestParticles(
  const ElementMesh& mesh, const Distribution& result, const SizingFunction& sizing)
{
  SurfaceWalker walker({ &mesh, 0.0, tolerance });
  for (const Particle& p : result.particles)
  {
    const Evaluated at = walker.evaluateCurved(p.location);
    const double slope = length(at.point.gradient);
    ASSERT_LE(std::abs(at.point.value) / slope, tolerance);
    ASSERT_GE(insideMargin(mesh.elements[p.location.element].domain, p.location.u), -1e-12);
    ASSERT_LE(length(at.point.map.position - p.position), 1e-14);
    ASSERT_NEAR(p.residual, std::abs(at.point.value) / slope, 1e-15);
    ASSERT_NEAR(length(p.normal), 1.0, 1e-14);
    ASSERT_LE(length(p.normal - surfaceNormal(at.point.gradient)), 1e-14);
    ASSERT_DOUBLE_EQ(p.spacing, sizing.at(p.curvature.magnitude));
    ASSERT_NEAR(p.curvature.mean, curvature(at.point.gradient, at.hessian).mean, 1e-12);
  }
}

void expectSame(const Distribution& a, const Distribution& b)
{
  ASSERT_EQ(a.particles.size(), b.particles.size());
  EXPECT_EQ(a.report.evaluations, b.report.evaluations);
  EXPECT_EQ(a.report.iterations, b.report.iterations);
  for (std::size_t i = 0; i < a.particles.size(); ++i)
  {
    ASSERT_EQ(a.particles[i].location.element, b.particles[i].location.element);
    ASSERT_EQ(a.particles[i].position.xyz, b.particles[i].position.xyz);
    ASSERT_EQ(a.particles[i].normal.xyz, b.particles[i].normal.xyz);
  }
}

/// Zero without values, so that no particles do not pass for evenly spaced ones.
double smallest(const std::vector<double>& values)
{
  return values.empty() ? 0.0 : *std::min_element(values.begin(), values.end());
}

double mean(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A closed surface in a bent mesh, to be covered evenly.
struct EvenCase
{
  const char* name;
  KnownSurface surface;
  Domain domain = Domain::Hexahedron;
  int degree = 4;
  double spacing = 0.1;
};

std::ostream& operator<<(std::ostream& out, const EvenCase& which)
{
  return out << which.name;
}

class EvenCover : public ::testing::TestWithParam<EvenCase>
{
};

INSTANTIATE_TEST_SUITE_P(ClassicDistribution, EvenCover,
  ::testing::Values(
    EvenCase{ "SphereInHexahedra", sphere({ 0, 0, 0 }, 0.6), Domain::Hexahedron, 4, 0.09 },
    EvenCase{ "SphereInTetrahedra", sphere({ 0, 0, 0 }, 0.6), Domain::Tetrahedron, 5, 0.09 },
    EvenCase{ "SphereInWedges", sphere({ 0, 0, 0 }, 0.6), Domain::Wedge, 6, 0.09 },
    EvenCase{ "TorusInHexahedra", torus(0.5, 0.22), Domain::Hexahedron, 6, 0.08 },
    EvenCase{ "TorusInTetrahedra", torus(0.5, 0.22), Domain::Tetrahedron, 6, 0.08 },
    EvenCase{ "TorusInWedges", torus(0.5, 0.22), Domain::Wedge, 5, 0.08 }),
  [](const auto& which) { return which.param.name; });

TEST_P(EvenCover, IsAsDenseAndAsEvenAsHexagonalPacking)
{
  const EvenCase& which = this->GetParam();
  MeshRecipe recipe;
  recipe.domain = which.domain;
  recipe.degrees = { which.degree, which.degree, which.degree };
  recipe.map = wavyMap(0.1);
  recipe.field = which.surface.field;
  const ElementMesh mesh = makeMesh(recipe);
  const DistributionParameters parameters = withSpacing(which.spacing);
  const Distribution result = distribute(mesh, parameters);

  EXPECT_TRUE(result.report.error.empty());
  EXPECT_TRUE(result.report.converged);
  EXPECT_FALSE(result.report.aborted);
  EXPECT_GT(result.report.evaluations, static_cast<std::int64_t>(result.particles.size()));
  expectHonestParticles(mesh, result, parameters.sizing);
  const double expected = hexagonalCount(which.surface.area, which.spacing);
  EXPECT_NEAR(static_cast<double>(result.particles.size()), expected, 0.05 * expected);
  const std::vector<double> nearest = nearestSpacings(result.particles);
  EXPECT_GE(smallest(nearest), 0.7);
  EXPECT_NEAR(mean(nearest), 1.0, 0.1);
  for (const Particle& p : result.particles)
  {
    // The mesh interpolates the analytic surface.
    const glm::dvec3 x = p.position.xyz;
    EXPECT_LE(glm::distance(p.normal.xyz, which.surface.normal(x)), 0.06);
  }
}

TEST(ClassicDistribution, LeavesNoHoles)
{
  const ElementMesh mesh = straightMesh(sphere({ 0, 0, 0 }, 0.6));
  const Distribution result = distribute(mesh, withSpacing(0.1));
  Random random(1);
  for (int n = 0; n < 2000; ++n)
  {
    const glm::dvec3 probe = 0.6 * glm::normalize(randomVector(random));
    double nearest = 1.0;
    for (const Particle& p : result.particles)
    {
      nearest = std::min(nearest, glm::distance(p.position.xyz, probe));
    }
    EXPECT_LE(nearest, 1.13 * 0.1);
  }
}

TEST(ClassicDistribution, GivesExactlyTheNumberOfParticlesAskedFor)
{
  const KnownSurface surface = sphere({ 0, 0, 0 }, 0.6);
  const ElementMesh mesh = straightMesh(surface);
  // The spacing at the start does not matter.
  for (const double spacing : { 0.02, 0.2 })
  {
    for (const std::int64_t count : { 60, 500, 1300 })
    {
      SCOPED_TRACE(::testing::Message() << count << " from spacing " << spacing);
      DistributionParameters parameters = withSpacing(spacing);
      parameters.particleCount = count;
      const Distribution result = distribute(mesh, parameters);
      ASSERT_EQ(static_cast<std::int64_t>(result.particles.size()), count);
      EXPECT_TRUE(result.report.converged);
      // The spacing that comes out is the one at which hexagonal packing has this number.
      const double expected = std::sqrt(hexagonalCount(surface.area, 1.0) / count);
      EXPECT_NEAR(result.particles.front().spacing, expected, 0.05 * expected);
      const std::vector<double> nearest = nearestSpacings(result.particles);
      EXPECT_GE(smallest(nearest), 0.6);
      EXPECT_NEAR(mean(nearest), 1.0, 0.1);
    }
  }
}

TEST(ClassicDistribution, IsDenserWhereTheSurfaceBends)
{
  const KnownSurface surface = prolateEllipsoid(0.8, 0.35);
  const ElementMesh mesh = straightMesh(surface);
  const DistributionParameters parameters = withSpacing(0.12, 8.0);
  const Distribution result = distribute(mesh, parameters);
  expectHonestParticles(mesh, result, parameters.sizing);

  // At the tips, where D = sqrt(2) a/b^2, and around the waist, where D = |(b/a^2, 1/b)|.
  std::vector<double> tips, waist;
  double tipSpacing = 0.0, waistSpacing = 0.0;
  const std::vector<double> nearest = nearestSpacings(result.particles);
  for (std::size_t i = 0; i < nearest.size(); ++i)
  {
    const Particle& p = result.particles[i];
    EXPECT_NEAR(p.curvature.magnitude, surface.curvature(p.position.xyz).magnitude, 1e-6);
    if (std::abs(p.position.xyz.x) > 0.72)
    {
      tips.push_back(nearest[i]);
      tipSpacing += p.spacing;
    }
    else if (std::abs(p.position.xyz.x) < 0.3)
    {
      waist.push_back(nearest[i]);
      waistSpacing += p.spacing;
    }
  }
  ASSERT_GT(tips.size(), 20u);
  ASSERT_GT(waist.size(), 50u);
  EXPECT_LT(tipSpacing / tips.size(), 0.75 * waistSpacing / waist.size());
  EXPECT_GE(smallest(nearest), 0.5);
  // In both places particles stand as far apart as the sizing function asks for.
  EXPECT_NEAR(mean(tips), 1.0, 0.15);
  EXPECT_NEAR(mean(waist), 1.0, 0.1);
}

TEST(ClassicDistribution, NumberFollowsTheSizingFunction)
{
  // On a sphere curvature is the same everywhere: sqrt(2)/r.
  const KnownSurface surface = sphere({ 0, 0, 0 }, 0.6);
  const ElementMesh mesh = straightMesh(surface);
  const DistributionParameters parameters = withSpacing(0.15, 7.0);
  const double h = parameters.sizing.at(std::sqrt(2.0) / 0.6);
  ASSERT_LT(h, 0.12);
  const Distribution result = distribute(mesh, parameters);
  const double expected = hexagonalCount(surface.area, h);
  EXPECT_NEAR(static_cast<double>(result.particles.size()), expected, 0.05 * expected);
}

class OpenCover : public ::testing::TestWithParam<std::tuple<OpenCase, Domain>>
{
};

INSTANTIATE_TEST_SUITE_P(ClassicDistribution, OpenCover, openCasesInAllDomains(), nameOfOpenCase);

TEST_P(OpenCover, ReachesTheBoundaryAndStaysEven)
{
  const auto& [open, domain] = this->GetParam();
  constexpr double spacing = 0.09;
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.field = open.surface.field;
  const ElementMesh mesh = makeMesh(recipe);
  const Distribution result = distribute(mesh, withSpacing(spacing));
  expectHonestParticles(mesh, result, { spacing, 0.0 });
  int onBoundary = 0;
  for (const Particle& p : result.particles)
  {
    const bool atWall = onCube(p.position.xyz);
    EXPECT_EQ(boundaryFaceCount(mesh, p.location) > 0, atWall);
    onBoundary += atWall;
  }
  // Seen with GCC and Clang, with and without vectors: up to 0.16.
  EXPECT_NEAR(onBoundary * spacing, open.boundary, 0.18 * open.boundary);
  // Two particles on boundary curves may face each other across a corner of the domain.
  EXPECT_GE(smallest(nearestSpacings(result.particles)), 0.6);
  // Half of the area around a particle on a boundary curve lies outside.
  const double expected = hexagonalCount(open.area, spacing) + 0.5 * open.boundary / spacing;
  EXPECT_NEAR(static_cast<double>(result.particles.size()), expected, 0.05 * expected);
}

/// Where two planes meet at a face between elements. The paper refines there (its section 4.3); Classic does not.
TEST(ClassicDistribution, IsEvenAcrossACreaseAndNoDenserThere)
{
  for (const double angle : { 15.0, 30.0, 60.0 })
  {
    SCOPED_TRACE(angle);
    const double slope = std::tan(glm::radians(0.5 * angle));
    MeshRecipe recipe;
    recipe.field = [=](const glm::dvec3& x)
    { return x.z - 0.11 + slope * (std::abs(x.x) + 0.3 * x.y); };
    const ElementMesh mesh = makeMesh(recipe);
    const Distribution even = distribute(mesh, withSpacing(0.1));
    const Distribution denser = distribute(mesh, withSpacing(0.1, 10.0));
    EXPECT_EQ(denser.particles.size(), even.particles.size());
    EXPECT_GE(smallest(nearestSpacings(even.particles)), 0.6);
    const auto nearCrease = std::count_if(even.particles.begin(), even.particles.end(),
      [](const Particle& p) { return std::abs(p.position.xyz.x) < 0.2; });
    const double share =
      static_cast<double>(nearCrease) / static_cast<double>(even.particles.size());
    EXPECT_NEAR(share, 0.2, 0.03);
  }
}

TEST(ClassicDistribution, DependsOnTheSeedAndNotOnThreads)
{
  MeshRecipe recipe;
  recipe.domain = Domain::Wedge;
  recipe.degrees = { 4, 4, 4 };
  recipe.map = wavyMap(0.1);
  recipe.field = torus(0.5, 0.22).field;
  const ElementMesh mesh = makeMesh(recipe);
  DistributionParameters parameters = withSpacing(0.1, 4.0);
  const Distribution first = distribute(mesh, parameters);
  expectSame(distribute(mesh, parameters), first);
  expectSame(distribute(mesh, parameters, {}, threadedFor(2)), first);
  expectSame(distribute(mesh, parameters, {}, threadedFor(5)), first);

  parameters.seed = 2;
  const Distribution other = distribute(mesh, parameters);
  const bool same = other.particles.size() == first.particles.size() &&
    std::equal(other.particles.begin(), other.particles.end(), first.particles.begin(),
      [](const Particle& a, const Particle& b) { return a.position.xyz == b.position.xyz; });
  EXPECT_FALSE(same);
}

TEST(ClassicDistribution, FindsAllComponents)
{
  // A large sphere and one that is half a spacing across.
  const glm::dvec3 centers[] = { { -0.25, -0.2, -0.2 }, { 0.8, 0.75, 0.7 } };
  const double radii[] = { 0.6, 0.05 };
  const KnownSurface surface = bothOf(sphere(centers[0], radii[0]), sphere(centers[1], radii[1]));
  for (const Domain domain : allDomains)
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.degrees = { 4, 4, 4 };
    recipe.field = surface.field;
    const ElementMesh mesh = makeMesh(recipe);
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
    {
      SCOPED_TRACE(::testing::Message() << domain << ", seed " << seed);
      DistributionParameters parameters = withSpacing(0.2);
      parameters.seed = seed;
      const Distribution result = distribute(mesh, parameters);
      int found[2] = {};
      for (const Particle& p : result.particles)
      {
        for (int c = 0; c < 2; ++c)
        {
          found[c] += std::abs(glm::distance(p.position.xyz, centers[c]) - radii[c]) < 1e-6;
        }
      }
      EXPECT_EQ(found[0] + found[1], static_cast<int>(result.particles.size()));
      EXPECT_GT(found[0], 50);
      EXPECT_GE(found[1], 2);
    }
  }
}

TEST(ClassicDistribution, TwoSheetsCloseToEachOtherDoNotMix)
{
  // A plate a quarter of a spacing thick: each side as if it were alone.
  MeshRecipe recipe;
  recipe.field = [](const glm::dvec3& x) { return 0.0125 * 0.0125 - x.z * x.z; };
  const ElementMesh mesh = makeMesh(recipe);
  const Distribution result = distribute(mesh, withSpacing(0.1));
  const auto above = std::count_if(result.particles.begin(), result.particles.end(),
    [](const Particle& p) { return p.position.xyz.z > 0.0; });
  const double expected = hexagonalCount(4.0, 0.1);
  EXPECT_NEAR(static_cast<double>(above), expected, 0.15 * expected);
  EXPECT_NEAR(static_cast<double>(result.particles.size() - above), expected, 0.15 * expected);
  EXPECT_GE(smallest(nearestSpacings(result.particles)), 0.5);
}

TEST(ClassicDistribution, RefusesMoreParticlesThanTheLimit)
{
  const ElementMesh mesh = straightMesh(sphere({ 0, 0, 0 }, 0.6));
  DistributionParameters parameters = withSpacing(0.01);
  parameters.particleLimit = 1000;
  const Distribution result = distribute(mesh, parameters);
  EXPECT_TRUE(result.particles.empty());
  EXPECT_NE(result.report.error.find("limit of 1000"), std::string::npos) << result.report.error;

  parameters.particleCount = 1500;
  EXPECT_FALSE(distribute(mesh, parameters).report.error.empty());
}

TEST(ClassicDistribution, ReportsUndersampledParticles)
{
  const ElementMesh mesh = straightMesh(sphere({ 0, 0, 0 }, 0.3));
  const Distribution coarse = distribute(mesh, withSpacing(0.6));
  EXPECT_EQ(
    coarse.report.particlesUndersampled, static_cast<std::int64_t>(coarse.particles.size()));
  EXPECT_GT(coarse.particles.size(), 0u);
  EXPECT_EQ(distribute(mesh, withSpacing(0.1)).report.particlesUndersampled, 0);
}

TEST(ClassicDistribution, StopsWhenTheMonitorAsksForIt)
{
  const ElementMesh mesh = straightMesh(torus(0.5, 0.22));
  const DistributionParameters parameters = withSpacing(0.06);
  int all = 0;
  double last = 0.0;
  distribute(mesh, parameters,
    { [&](double fraction)
      {
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        ++all;
        return true;
      } });
  ASSERT_GT(all, 20);
  for (const int allowed : { 0, 1, all / 2 })
  {
    int calls = 0;
    const Distribution result =
      distribute(mesh, parameters, { [&](double) { return ++calls <= allowed; } });
    EXPECT_TRUE(result.report.aborted);
    EXPECT_EQ(calls, allowed + 1);
    EXPECT_TRUE(result.particles.empty());
  }
}

TEST(ClassicDistribution, NothingComesOfNothing)
{
  const Distribution ofNoMesh = distribute({}, withSpacing(0.1));
  EXPECT_TRUE(ofNoMesh.particles.empty());
  EXPECT_TRUE(ofNoMesh.report.error.empty());

  MeshRecipe recipe;
  recipe.field = [](const glm::dvec3& x) { return 3.0 + x.x; };
  const Distribution offRange = distribute(makeMesh(recipe), withSpacing(0.1));
  EXPECT_TRUE(offRange.particles.empty());
  EXPECT_TRUE(offRange.report.error.empty());

  DistributionParameters fixedNumber = withSpacing(0.1);
  fixedNumber.particleCount = 100;
  EXPECT_TRUE(distribute(makeMesh(recipe), fixedNumber).particles.empty());
}

TEST(ClassicDistribution, SurvivesElementsThatAreFlatFoldedOrConstant)
{
  // x is folded at 0.3, so that elements are inverted there; the field is constant for z > 0.
  MeshRecipe recipe;
  recipe.degrees = { 3, 3, 3 };
  recipe.map = [](const glm::dvec3& x) { return glm::dvec3(x.x * x.x - 0.6 * x.x, x.y, x.z); };
  recipe.field = [](const glm::dvec3& x) { return x.z > 0.0 ? 0.0 : x.z * (x.y - 0.1 * x.x); };
  const ElementMesh mesh = makeMesh(recipe);
  const Distribution result = distribute(mesh, withSpacing(0.15));
  for (const Particle& p : result.particles)
  {
    EXPECT_TRUE(std::isfinite(p.position.xyz.x + p.position.xyz.y + p.position.xyz.z));
    EXPECT_TRUE(std::isfinite(p.curvature.magnitude));
    EXPECT_LE(p.residual, tolerance);
  }
}

TEST(ClassicDistribution, CostsInProportionToItsParticlesInFlattenedElements)
{
  // The surface bends a thousand times as fast as the elements are long: no spacing can follow it.
  MeshRecipe recipe;
  recipe.cells = 3;
  recipe.map = [](const glm::dvec3& x)
  {
    return glm::dvec3(x.x + 0.2 * std::sin(2.0 * x.y), x.y + 0.2 * std::sin(2.0 * x.z), 1e-3 * x.z);
  };
  recipe.field = [](const glm::dvec3& x)
  {
    const glm::dvec3 a(3.5 * x.x, 3.5 * x.y, 3.5e3 * x.z);
    return std::sin(a.x) * std::cos(a.y) + std::sin(a.y) * std::cos(a.z) +
      std::sin(a.z) * std::cos(a.x);
  };
  DistributionParameters parameters = withSpacing(0.3, 2.0);
  const ElementMesh mesh = makeMesh(recipe);
  const Distribution result = distributeClassic({ &mesh, 0.0, 1e-5 }, parameters, {}, {});
  ASSERT_GT(result.particles.size(), 20u);
  EXPECT_LT(static_cast<double>(result.report.evaluations),
    15'000.0 * static_cast<double>(result.particles.size()));
}

TEST(ClassicDistribution, MakesFewParticlesWhereAFieldTouchesTheIsovalueInAPoint)
{
  MeshRecipe recipe;
  recipe.cells = 3;
  recipe.field = [](const glm::dvec3& x) { return glm::dot(x, x); };
  const ElementMesh mesh = makeMesh(recipe);
  // The tolerance is large beside the spacing: particles would fill a ball. Some remain, whose normals differ.
  const Distribution result = distributeClassic({ &mesh, 0.0, 1e-3 }, withSpacing(1e-4), {}, {});
  EXPECT_LE(result.particles.size(), 20u);
}

/// Why the user is not asked for them. That all four take effect: SplitAndDelete.ThresholdsOfTheCoinCanBeChosen, and
/// here the sweeps.
TEST(ClassicDistribution, StaysEvenWithAFifthMoreOrLessOfThePapersConstants)
{
  const ElementMesh mesh = straightMesh(sphere({ 0, 0, 0 }, 0.6));
  const Distribution usual = distribute(mesh, withSpacing(0.1));
  const auto count = static_cast<double>(usual.particles.size());
  for (double ClassicParameters::*constant :
    { &ClassicParameters::splitBelow, &ClassicParameters::deleteAbove,
      &ClassicParameters::settledShare, &ClassicParameters::steadyChange })
  {
    for (const double factor : { 0.8, 1.2 })
    {
      DistributionParameters parameters = withSpacing(0.1);
      parameters.classic.*constant *= factor;
      const Distribution result = distribute(mesh, parameters);
      EXPECT_TRUE(result.report.converged);
      EXPECT_NEAR(static_cast<double>(result.particles.size()), count, 0.02 * count);
      const std::vector<double> nearest = nearestSpacings(result.particles);
      EXPECT_GE(smallest(nearest), 0.8);
      EXPECT_NEAR(mean(nearest), 1.0, 0.1);
      if (constant == &ClassicParameters::steadyChange)
      {
        EXPECT_EQ(result.report.iterations > usual.report.iterations, factor < 1.0);
      }
    }
  }
}

TEST(ClassicDistribution, DoesNotDependOnTheUnitOfLength)
{
  const auto countAt = [](double scale)
  {
    MeshRecipe recipe;
    recipe.map = [scale](const glm::dvec3& x) { return scale * x; };
    recipe.field = [scale, f = sphere({ 0, 0, 0 }, 0.6).field](const glm::dvec3& x)
    { return 1e5 * f(x / scale); };
    const ElementMesh mesh = makeMesh(recipe);
    return distributeClassic({ &mesh, 0.0, tolerance * scale }, withSpacing(0.1 * scale), {}, {})
      .particles.size();
  };
  const double one = static_cast<double>(countAt(1.0));
  EXPECT_NEAR(static_cast<double>(countAt(1e-6)), one, 0.02 * one);
  EXPECT_NEAR(static_cast<double>(countAt(1e6)), one, 0.02 * one);
}

} // namespace
} // namespace hop::testing
