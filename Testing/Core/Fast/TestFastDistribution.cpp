#include "Fast/FastDistribution.h"

#include "AnalyticFields.h"
#include "DistributionMeasures.h"
#include "ElementCases.h"
#include "Isolation/SizingField.h"
#include "Isolation/SurfaceBox.h"
#include "OpenCases.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <numeric>
#include <set>

namespace hop::testing
{
namespace
{

constexpr double tolerance = 1e-9;

Distribution distribute(const ElementMesh& mesh, const DistributionParameters& parameters,
  const Monitor& monitor = {}, const ParallelFor& parallelFor = {})
{
  return distributeFast({ &mesh, 0.0, tolerance }, parameters, monitor, parallelFor);
}

DistributionParameters withSpacing(double spacing, double angularDensity = 0.0)
{
  DistributionParameters parameters;
  parameters.sizing = { spacing, angularDensity };
  return parameters;
}

ElementMesh meshOf(Domain domain, int degree, const Field& field, int cells = 2)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { degree, degree, degree };
  recipe.cells = cells;
  recipe.field = field;
  return makeMesh(recipe);
}

/// What every particle promises: a place on the surface, and what belongs to it.
void expectHonestParticles(const ElementMesh& mesh, const Distribution& result)
{
  SurfaceWalker walker({ &mesh, 0.0, tolerance });
  for (const Particle& p : result.particles)
  {
    const Evaluated at = walker.evaluateCurved(p.location);
    const double slope = length(at.point.gradient);
    ASSERT_LE(std::abs(at.point.value) / slope, tolerance);
    ASSERT_GE(insideMargin(mesh.elements[p.location.element].domain, p.location.u), -1e-12);
    ASSERT_LE(length(at.point.map.position - p.position), 1e-13);
    ASSERT_NEAR(p.residual, std::abs(at.point.value) / slope, 1e-12);
    ASSERT_LE(length(p.normal - surfaceNormal(at.point.gradient)), 1e-12);
    ASSERT_NEAR(p.curvature.mean, curvature(at.point.gradient, at.hessian).mean, 1e-9);
  }
}

double smallest(const std::vector<double>& values)
{
  return values.empty() ? 0.0 : *std::min_element(values.begin(), values.end());
}

class FastOpenCover : public ::testing::TestWithParam<std::tuple<OpenCase, Domain>>
{
};

INSTANTIATE_TEST_SUITE_P(FastDistribution, FastOpenCover, openCasesInAllDomains(), nameOfOpenCase);

TEST_P(FastOpenCover, BoundariesAreClosedLinesOfParticles)
{
  const auto& [open, domain] = this->GetParam();
  constexpr double spacing = 0.05;
  const ElementMesh mesh = meshOf(domain, 2, open.surface.field, 3);
  const Distribution result = distribute(mesh, withSpacing(spacing));
  expectHonestParticles(mesh, result);

  Buffer<Particle> boundary;
  for (const Particle& p : result.particles)
  {
    EXPECT_EQ(boundaryFaceCount(mesh, p.location) > 0, onCube(p.position.xyz));
    if (onCube(p.position.xyz))
    {
      boundary.push_back(p);
      EXPECT_NEAR(length(p.clips[0].normal), 1.0, 1e-12);
      EXPECT_NEAR(dot(p.clips[0].normal, p.normal), 0.0, 1e-9);
      EXPECT_EQ(p.clips[0].distance, 0.0);
      const glm::dvec3 wall = glm::trunc(p.position.xyz * (1.0 + 1e-10));
      EXPECT_GT(glm::dot(p.clips[0].normal.xyz, wall), 0.3) << "points into the cube";
    }
  }
  EXPECT_NEAR(boundary.size() * spacing, open.boundary, 0.02 * open.boundary);
  const std::vector<double> alongBoundary = nearestSpacings(boundary);
  EXPECT_GE(smallest(alongBoundary), 0.85);
  EXPECT_LE(*std::max_element(alongBoundary.begin(), alongBoundary.end()), 1.1);
  EXPECT_GE(smallest(nearestSpacings(result.particles)), 0.75);
  // Half of the area around a particle on a boundary curve lies outside.
  const double expected = hexagonalCount(open.area, spacing) + 0.5 * open.boundary / spacing;
  EXPECT_NEAR(static_cast<double>(result.particles.size()), expected, 0.03 * expected);
}

/// Pairs of neighbours are handed on by the indices of the particles: all stand on the boundary, and every particle
/// there has two.
TEST_P(FastOpenCover, HandsOnWhichParticlesAreNeighboursOnTheBoundary)
{
  const auto& [testCase, domain] = this->GetParam();
  constexpr double spacing = 0.09;
  const Distribution result =
    distribute(meshOf(domain, 2, testCase.surface.field), withSpacing(spacing));
  std::vector<int> neighbors(result.particles.size());
  for (const auto& [a, b] : result.edges.segments)
  {
    ++neighbors[a];
    ++neighbors[b];
    EXPECT_LT(length(result.particles[a].position - result.particles[b].position), 2.0 * spacing);
  }
  for (std::size_t i = 0; i < neighbors.size(); ++i)
  {
    EXPECT_EQ(neighbors[i], onCube(result.particles[i].position.xyz) ? 2 : 0);
  }
}

TEST_P(FastOpenCover, ClipsWhereTheSurfaceEnds)
{
  const auto& [open, domain] = this->GetParam();
  constexpr double spacing = 0.05;
  const Distribution result =
    distribute(meshOf(domain, 2, open.surface.field, 3), withSpacing(spacing));
  int clipped = 0;
  for (const Particle& p : result.particles)
  {
    const glm::dvec3 x = glm::abs(p.position.xyz);
    const double toWall = 1.0 - std::max({ x.x, x.y, x.z });
    if (length(p.clips[0].normal) == 0.0)
    {
      EXPECT_GT(toWall, 0.4 * spacing);
      continue;
    }
    ++clipped;
    EXPECT_GE(p.clips[0].distance, 0.0);
    EXPECT_LE(p.clips[0].distance, 1.5 * spacing);
    // The distance is measured along the surface, which may meet the wall at an angle.
    EXPECT_GE(p.clips[0].distance, toWall - 0.2 * spacing);
  }
  EXPECT_GT(clipped * spacing, open.boundary);
}

TEST(FastDistribution, SpacingsAreGradedBetweenFlatAndBent)
{
  const ElementMesh mesh = meshOf(Domain::Hexahedron, 2, prolateEllipsoid(0.8, 0.35).field);
  const DistributionParameters parameters = withSpacing(0.1, 15.0);
  const Distribution result = distribute(mesh, parameters);
  double smallestSpacing = 1.0;
  for (const Particle& a : result.particles)
  {
    EXPECT_LE(a.spacing, parameters.sizing.at(a.curvature.magnitude) * 1.001);
    smallestSpacing = std::min(smallestSpacing, a.spacing);
    for (const Particle& b : result.particles)
    {
      const double distance = length(a.position - b.position);
      if (distance < 2.0 * a.spacing)
      {
        ASSERT_LE(std::abs(a.spacing - b.spacing), 0.35 * distance + 0.02 * a.spacing);
      }
    }
  }
  EXPECT_LT(smallestSpacing, 0.05);
}

TEST(FastDistribution, GivesExactlyTheNumberOfParticlesAskedFor)
{
  for (const bool open : { false, true })
  {
    const KnownSurface surface = open ? plane({ 0, 0, 1 }, 0.05) : sphere({ 0, 0, 0 }, 0.6);
    const ElementMesh mesh = meshOf(Domain::Hexahedron, 2, surface.field);
    for (const double spacing : { 0.02, 0.2 })
    {
      for (const std::int64_t count : { 3, 60, 500, 1300 })
      {
        SCOPED_TRACE(::testing::Message() << count << " from spacing " << spacing << open);
        DistributionParameters parameters = withSpacing(spacing);
        parameters.particleCount = count;
        const Distribution result = distribute(mesh, parameters);
        ASSERT_EQ(static_cast<std::int64_t>(result.particles.size()), count);
        if (count > 3)
        {
          EXPECT_GE(smallest(nearestSpacings(result.particles)), 0.69);
        }
      }
    }
  }
}

/// The counts of the elements add up to the number that comes out if particles on boundary curves count half.
TEST(FastDistribution, SaysBeforehandHowManyParticlesElementsTake)
{
  constexpr double spacing = 0.05;
  for (const OpenCase& open : { OpenCase{ "Plane", plane({ 0, 0, 1 }, 0.05), 4.0, 8.0 },
         OpenCase{ "Sphere", sphere({ 0, 0, 0 }, 0.6), 4.0 * Pi * 0.36, 0.0 } })
  {
    SCOPED_TRACE(open.name);
    const ElementMesh mesh = meshOf(Domain::Hexahedron, 2, open.surface.field);
    const std::vector<double> counts =
      particlesPerElement({ &mesh, 0.0, tolerance }, { spacing, 0.0 }, {}, {});
    ASSERT_EQ(counts.size(), mesh.elements.size());
    const double sum = std::accumulate(counts.begin(), counts.end(), 0.0);
    // Each particle on a boundary curve counts half, and half of the area around it lies outside.
    const double expected = hexagonalCount(open.area, spacing) + 0.5 * open.boundary / spacing;
    EXPECT_NEAR(sum, expected, 0.03 * expected);
    std::vector<double> found(counts.size(), 0.0);
    for (const Particle& p : distribute(mesh, withSpacing(spacing)).particles)
    {
      found[p.location.element] += 1.0;
    }
    for (std::size_t e = 0; e < counts.size(); ++e)
    {
      EXPECT_NEAR(found[e], counts[e], 0.1 * counts[e] + 0.5 * open.boundary / spacing);
    }
  }
}

void expectSame(const Distribution& a, const Distribution& b)
{
  ASSERT_EQ(a.particles.size(), b.particles.size());
  EXPECT_EQ(a.report.evaluations, b.report.evaluations);
  for (std::size_t i = 0; i < a.particles.size(); ++i)
  {
    ASSERT_EQ(a.particles[i].location.element, b.particles[i].location.element);
    ASSERT_EQ(a.particles[i].position.xyz, b.particles[i].position.xyz);
    ASSERT_EQ(a.particles[i].normal.xyz, b.particles[i].normal.xyz);
    ASSERT_EQ(a.particles[i].clips[0].normal.xyz, b.particles[i].clips[0].normal.xyz);
  }
}

TEST(FastDistribution, DependsOnTheSeedAndNotOnThreads)
{
  MeshRecipe recipe;
  recipe.domain = Domain::Wedge;
  recipe.degrees = { 4, 4, 4 };
  recipe.map = wavyMap(0.1);
  recipe.field = torus(0.8, 0.4).field; // leaves the cube
  const ElementMesh mesh = makeMesh(recipe);
  DistributionParameters parameters = withSpacing(0.05, 4.0);
  const Distribution first = distribute(mesh, parameters);
  for (const int threads : { 1, 2, 3, 8 })
  {
    expectSame(distribute(mesh, parameters, {}, threadedFor(threads)), first);
  }
  parameters.seed = 2;
  const Distribution other = distribute(mesh, parameters);
  const bool same = other.particles.size() == first.particles.size() &&
    std::equal(other.particles.begin(), other.particles.end(), first.particles.begin(),
      [](const Particle& a, const Particle& b) { return a.position.xyz == b.position.xyz; });
  EXPECT_FALSE(same);
}

TEST(FastDistribution, FindsComponentsFarSmallerThanTheSpacing)
{
  // Beside a large sphere, one that is a twentieth of a spacing across: far from it, and within a spacing of it.
  const glm::dvec3 center(-0.25, -0.2, -0.2);
  for (const glm::dvec3& other : { glm::dvec3(0.8, 0.75, 0.7), glm::dvec3(0.45, -0.2, -0.2) })
  {
    const KnownSurface surface = bothOf(sphere(center, 0.6), sphere(other, 0.005));
    for (const Domain domain : allDomains)
    {
      const ElementMesh mesh = meshOf(domain, 4, surface.field);
      for (std::uint64_t seed = 1; seed <= 5; ++seed)
      {
        SCOPED_TRACE(::testing::Message() << domain << ", seed " << seed);
        DistributionParameters parameters = withSpacing(0.2);
        parameters.seed = seed;
        const Distribution result = distribute(mesh, parameters);
        const auto onSmall = std::count_if(result.particles.begin(), result.particles.end(),
          [&](const Particle& p) { return glm::distance(p.position.xyz, other) < 0.01; });
        EXPECT_GE(onSmall, 1);
        EXPECT_GT(static_cast<std::ptrdiff_t>(result.particles.size()), 50 + onSmall);
      }
    }
  }
}

TEST(FastDistribution, TwoSheetsCloseToEachOtherDoNotMix)
{
  // A plate a quarter of a spacing thick: each side as if it were alone.
  const ElementMesh mesh =
    meshOf(Domain::Hexahedron, 2, [](const glm::dvec3& x) { return 0.0125 * 0.0125 - x.z * x.z; });
  const Distribution result = distribute(mesh, withSpacing(0.1));
  Buffer<Particle> sheets[2];
  for (const Particle& p : result.particles)
  {
    sheets[p.position.xyz.z > 0.0].push_back(p);
  }
  const double expected = hexagonalCount(4.0, 0.1) + 0.5 * 8.0 / 0.1;
  for (const auto& sheet : sheets)
  {
    EXPECT_NEAR(static_cast<double>(sheet.size()), expected, 0.06 * expected);
    EXPECT_GE(smallest(nearestSpacings(sheet)), 0.75);
  }
}

TEST(FastDistribution, TwoSheetsInAThousandthOfAnElementAreAsManyAsEachAlone)
{
  for (const Domain domain : allDomains)
  {
    for (const glm::dvec3& direction : { glm::dvec3(0, 0, 1), { 1, 0, 0 }, { 1, 2, 3 } })
    {
      const glm::dvec3 normal = glm::normalize(direction);
      const auto distance = [&](const glm::dvec3& x) { return glm::dot(normal, x) - 0.137; };
      const auto expected = static_cast<double>(
        distribute(meshOf(domain, 2, distance, 1), withSpacing(0.1)).particles.size());
      for (const double gap : { 0.02, 0.001 })
      {
        const ElementMesh mesh = meshOf(
          domain, 2,
          [&](const glm::dvec3& x) { return distance(x) * distance(x) - 0.25 * gap * gap; }, 1);
        const Distribution result = distribute(mesh, withSpacing(0.1));
        expectHonestParticles(mesh, result);
        EXPECT_EQ(result.report.boxesUndecided, 0) << domain;
        Buffer<Particle> sheets[2];
        for (const Particle& p : result.particles)
        {
          sheets[distance(p.position.xyz) > 0.0].push_back(p);
        }
        for (const auto& sheet : sheets)
        {
          EXPECT_NEAR(static_cast<double>(sheet.size()), expected, 0.03 * expected)
            << domain << ", gap " << gap;
          EXPECT_GE(smallest(nearestSpacings(sheet)), 0.75) << domain << ", gap " << gap;
        }
      }
    }
  }
}

/// The unit cube's halves x < 0 and x > 0, in elements of their own whose corners coincide, with fields
/// of their own.
ElementMesh twoFields(const Field& left, const Field& right)
{
  MeshRecipe recipe;
  recipe.cells = 4;
  recipe.field = left;
  ElementMesh mesh = makeMesh(recipe);
  recipe.field = right;
  const ElementMesh other = makeMesh(recipe);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    const BernsteinForm form = mesh.form(static_cast<int>(e));
    const int count = coefficientCount(form.domain, form.degrees);
    double middle = 0.0;
    for (int i = 0; i < count; ++i)
    {
      middle += form.coefficients[i].x / count;
    }
    if (middle > 0.0)
    {
      std::copy_n(other.coefficients.begin() + other.elements[e].firstCoefficient, count,
        mesh.coefficients.begin() + mesh.elements[e].firstCoefficient);
    }
  }
  return mesh;
}

TEST(FastDistribution, EndsWhereTheFieldJumps)
{
  // Two half planes, z = 0.1 and z = 0.3: each with a boundary curve of its own at x = 0.
  constexpr double spacing = 0.05;
  const ElementMesh mesh = twoFields(
    [](const glm::dvec3& x) { return x.z - 0.1; }, [](const glm::dvec3& x) { return x.z - 0.3; });
  const Distribution result = distribute(mesh, withSpacing(spacing));
  int boundaries[2] = {};
  for (const Particle& p : result.particles)
  {
    const glm::dvec3 x = p.position.xyz;
    if (std::abs(x.x) < 1e-11)
    {
      const bool left = std::abs(x.z - 0.1) < 1e-6;
      ++boundaries[left];
      EXPECT_NEAR(p.jump, left ? -0.2 : 0.2, 1e-6);
      EXPECT_TRUE(onCube(x) || std::abs(p.clips[0].normal.xyz.x) > 1.0 - 1e-6);
    }
    else if (!onCube(x))
    {
      EXPECT_EQ(p.jump, 0.0);
    }
  }
  EXPECT_NEAR(boundaries[0], 2.0 / spacing, 3);
  EXPECT_NEAR(boundaries[1], 2.0 / spacing, 3);
  EXPECT_GE(smallest(nearestSpacings(result.particles)), 0.75);
}

TEST(FastDistribution, DoesNotDoubleWhereTheSidesAgree)
{
  // The jump is a tenth of a spacing: one sheet.
  constexpr double spacing = 0.05;
  const ElementMesh jumping = twoFields([](const glm::dvec3& x) { return x.z - 0.1; },
    [](const glm::dvec3& x) { return x.z - 0.1 - 0.1 * spacing; });
  const ElementMesh smooth = twoFields(
    [](const glm::dvec3& x) { return x.z - 0.1; }, [](const glm::dvec3& x) { return x.z - 0.1; });
  const Distribution a = distribute(jumping, withSpacing(spacing));
  const Distribution b = distribute(smooth, withSpacing(spacing));
  const auto count = static_cast<double>(b.particles.size());
  EXPECT_NEAR(static_cast<double>(a.particles.size()), count, 0.02 * count);
  EXPECT_GE(smallest(nearestSpacings(a.particles)), 0.75);
}

TEST(FastDistribution, LosesNoParticleWhereEitherSideTakesTheSurfaceForTheOthers)
{
  // x = -slope z on the left and x = -slope (z + slit) on the right, which is none for -slit < z < 0: there
  // Newton's method goes from either side to the other, for ever.
  constexpr double spacing = 0.05;
  constexpr double slope = 0.2;
  constexpr double slit = 0.3 * spacing;
  const ElementMesh mesh = twoFields([](const glm::dvec3& x) { return x.x + slope * x.z; },
    [](const glm::dvec3& x) { return x.x + slope * (x.z + slit); });
  const Distribution result = distribute(mesh, withSpacing(spacing));
  EXPECT_EQ(result.report.particlesRejected, 0);
  std::vector<glm::dvec3> probes;
  for (double y = -1.0; y < 1.0; y += 0.2 * spacing)
  {
    for (double z = 0.0; z < 3.0 * spacing; z += 0.2 * spacing)
    {
      probes.emplace_back(-slope * z, y, z);
      probes.emplace_back(slope * z, y, -slit - z);
    }
  }
  EXPECT_LE(coverageRadius(result.particles, probes), 0.9);
  EXPECT_GE(smallest(nearestSpacings(result.particles)), 0.65);
}

TEST(FastDistribution, RefusesMoreParticlesThanTheLimit)
{
  const ElementMesh mesh = meshOf(Domain::Hexahedron, 2, sphere({ 0, 0, 0 }, 0.6).field);
  for (const double spacing : { 0.01, 1e-9, 1e-12 })
  {
    DistributionParameters parameters = withSpacing(spacing);
    parameters.particleLimit = 1000;
    const Distribution result = distribute(mesh, parameters);
    EXPECT_TRUE(result.particles.empty());
    EXPECT_NE(result.report.error.find("limit of 1000"), std::string::npos) << result.report.error;
    EXPECT_EQ(result.report.error.find('-'), std::string::npos) << result.report.error;
  }
  DistributionParameters parameters = withSpacing(0.01);
  parameters.particleLimit = 1000;
  parameters.particleCount = 1500;
  EXPECT_FALSE(distribute(mesh, parameters).report.error.empty());
}

TEST(FastDistribution, RefusesStripsThatAreTooLongForTheSpacing)
{
  // By its area of 2e-9 the strip would take 2,300 particles, and one spacing after the other two million.
  MeshRecipe recipe;
  recipe.field = [](const glm::dvec3& x) { return x.x; };
  ElementMesh mesh;
  appendBox(mesh, recipe, { -1.0, -1.0, -5e-10 }, { 1.0, 1.0, 5e-10 });
  findFaceNeighbors(mesh, 1e-12);
  DistributionParameters parameters = withSpacing(1e-6);
  parameters.particleLimit = 100'000;
  const Distribution result = distribute(mesh, parameters);
  EXPECT_TRUE(result.particles.empty());
  EXPECT_NE(result.report.error.find("limit of 100000"), std::string::npos) << result.report.error;
}

TEST(FastDistribution, CountsParticlesBeforehandWhereMostStandCloseBecauseTheSurfaceBends)
{
  // Two droplets far apart: at a thousandth of their distance they bend more than at the spacing asked for.
  ElementMesh mesh;
  for (const double middle : { 0.0, 300.0 })
  {
    MeshRecipe recipe;
    recipe.field = sphere(glm::dvec3(middle), 0.5).field;
    appendBox(mesh, recipe, glm::dvec3(middle - 1.0), glm::dvec3(middle + 1.0));
  }
  findFaceNeighbors(mesh, 1e-9);
  DistributionParameters parameters = withSpacing(0.04, 15.0);
  const auto count = static_cast<std::int64_t>(distribute(mesh, parameters).particles.size());
  ASSERT_GT(count, 1000);
  parameters.particleLimit = count + count / 5;
  EXPECT_TRUE(distribute(mesh, parameters).report.error.empty());
  parameters.particleLimit = count - count / 5;
  EXPECT_FALSE(distribute(mesh, parameters).report.error.empty());
}

TEST(FastDistribution, StopsFollowingASurfaceThatTakesTooManyBoxes)
{
  // Noise: at the spacing of the estimate it is not counted beforehand, as a plane would take few particles.
  MeshRecipe recipe;
  recipe.degrees = { 4, 4, 4 };
  recipe.cells = 3;
  recipe.field = [](const glm::dvec3& x)
  { return std::sin(37.0 * x.x) + std::sin(41.0 * x.y) + std::sin(43.0 * x.z); };
  const ElementMesh mesh = makeMesh(recipe);
  DistributionParameters parameters = withSpacing(0.1, 10.0);
  const std::int64_t boxes = distribute(mesh, parameters).report.boxes;
  ASSERT_GT(boxes, 500);
  parameters.particleLimit = boxes / 8;
  const Distribution result = distribute(mesh, parameters);
  EXPECT_TRUE(result.particles.empty());
  EXPECT_NE(result.report.error.find("boxes, twice the limit of " + std::to_string(boxes / 8)),
    std::string::npos)
    << result.report.error;
  EXPECT_LT(result.report.evaluations, boxes);
}

TEST(FastDistribution, ReportsUndersampledParticles)
{
  // A tube that the mesh cuts off: closed components of fewer than six particles are distributed once more.
  const ElementMesh mesh = meshOf(
    Domain::Hexahedron, 2, [](const glm::dvec3& x) { return x.x * x.x + x.y * x.y - 0.3 * 0.3; });
  const Distribution coarse = distribute(mesh, withSpacing(0.6));
  EXPECT_EQ(
    coarse.report.particlesUndersampled, static_cast<std::int64_t>(coarse.particles.size()));
  EXPECT_GT(coarse.particles.size(), 0u);
  EXPECT_EQ(distribute(mesh, withSpacing(0.1)).report.particlesUndersampled, 0);
}

TEST(FastDistribution, StopsSoonAfterTheMonitorAsksForIt)
{
  using Clock = std::chrono::steady_clock;
  const ElementMesh mesh = meshOf(Domain::Hexahedron, 6, torus(0.5, 0.22).field);
  const DistributionParameters parameters = withSpacing(0.01);
  double last = 0.0;
  int calls = 0;
  distribute(mesh, parameters,
    { [&](double fraction)
      {
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        ++calls;
        return true;
      } });
  ASSERT_GT(calls, 4);
  EXPECT_GT(last, 0.5);
  for (const int allowed : { 0, calls / 2 })
  {
    int asked = 0;
    Clock::time_point stop;
    const Distribution result = distribute(mesh, parameters,
      { [&](double)
        {
          stop = Clock::now();
          return ++asked <= allowed;
        } });
    if (asked > allowed)
    {
      EXPECT_TRUE(result.report.aborted);
      EXPECT_TRUE(result.particles.empty());
      EXPECT_LT(Clock::now() - stop, std::chrono::milliseconds(200));
    }
  }
}

TEST(FastDistribution, TellsOfManyParticlesWhileTheSurfaceIsSought)
{
  const ElementMesh mesh = meshOf(Domain::Hexahedron, 6, torus(0.5, 0.22).field);
  double fraction = 0.0;
  std::vector<double> told;
  const Distribution result = distribute(mesh, withSpacing(0.001),
    { [&](double share)
      {
        fraction = share;
        return told.size() < 2;
      },
      [&](double particles) { told.push_back(particles); } });
  EXPECT_TRUE(result.report.aborted);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_GT(told[0], 250'000.0);
  EXPECT_GT(told[1], 1.2 * told[0]);
  EXPECT_LT(fraction, 0.35);
}

TEST(FastDistribution, ProgressRisesWhileOneElementIsSplit)
{
  // The monitor is asked some twenty times a second: the element has to take longer than that.
  const ElementMesh mesh = meshOf(Domain::Hexahedron, 8, torus(0.5, 0.22).field, 1);
  std::set<double> fractions;
  distribute(mesh, withSpacing(0.004),
    { [&](double fraction)
      {
        fractions.insert(fraction);
        return fraction < 0.35;
      } });
  const auto between = [&](double from, double to)
  { return std::distance(fractions.lower_bound(from), fractions.lower_bound(to)); };
  EXPECT_GE(between(0.05, 0.15), 1);
  EXPECT_GE(between(0.15, 0.29), 1);
}

TEST(FastDistribution, NothingComesOfNothing)
{
  EXPECT_TRUE(distribute({}, withSpacing(0.1)).particles.empty());
  const ElementMesh offRange =
    meshOf(Domain::Hexahedron, 2, [](const glm::dvec3& x) { return 3.0 + x.x; });
  DistributionParameters parameters = withSpacing(0.1);
  EXPECT_TRUE(distribute(offRange, parameters).particles.empty());
  parameters.particleCount = 100;
  const Distribution result = distribute(offRange, parameters);
  EXPECT_TRUE(result.particles.empty());
  EXPECT_TRUE(result.report.error.empty());
}

TEST(FastDistribution, SurvivesElementsThatAreFlatFoldedOrConstant)
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

TEST(FastDistribution, FieldsThatOnlyTouchTheIsovalueAreReported)
{
  for (const double density : { 0.0, 10.0 })
  {
    const ElementMesh mesh =
      meshOf(Domain::Tetrahedron, 3, [](const glm::dvec3& x) { return (1.0 - x.x) * (1.0 - x.x); });
    const Distribution result = distribute(mesh, withSpacing(0.1, density));
    EXPECT_GT(result.report.boxesUndecided, 0);
    EXPECT_TRUE(result.report.error.empty());
  }
}

TEST(FastDistribution, DoesNotDependOnTheUnitOfLength)
{
  const auto at = [](double scale)
  {
    MeshRecipe recipe;
    recipe.map = [scale](const glm::dvec3& x) { return scale * x; };
    recipe.field = [scale, f = sphere({ 0, 0, 0 }, 0.6).field](const glm::dvec3& x)
    { return 1e5 * f(x / scale); };
    const ElementMesh mesh = makeMesh(recipe);
    return distributeFast({ &mesh, 0.0, tolerance * scale }, withSpacing(0.1 * scale), {}, {})
      .particles.size();
  };
  const auto one = static_cast<double>(at(1.0));
  for (const double scale : { 1e-15, 1e-6, 1e6, 1e15 })
  {
    EXPECT_NEAR(static_cast<double>(at(scale)), one, 0.01 * one) << scale;
  }
}

TEST(FastDistribution, SpacingsAreLimitedAroundAPlace)
{
  constexpr double spacing = 0.1;
  constexpr double least = 0.025;
  const glm::dvec3 pole(0.0, 0.0, 0.6);
  const ElementMesh mesh = meshOf(Domain::Hexahedron, 3, sphere({ 0, 0, 0 }, 0.6).field);
  DistributionParameters parameters = withSpacing(spacing);
  const auto nearPole = [&]()
  {
    const Distribution result = distribute(mesh, parameters);
    return std::count_if(result.particles.begin(), result.particles.end(),
      [&](const Particle& p) { return glm::distance(p.position.xyz, pole) < spacing; });
  };
  EXPECT_LT(nearPole(), 9);
  parameters.spacingLimits = { { pole, static_cast<float>(least) } };
  for (const Particle& p : distribute(mesh, parameters).particles)
  {
    const double allowed =
      least + SizingField::GradationSlope * glm::distance(p.position.xyz, pole);
    EXPECT_NEAR(p.spacing, std::min(spacing, allowed), 0.05 * spacing);
  }
  // The integral of 2/(sqrt(3) h^2) over a disc of this radius is 19.6.
  EXPECT_GT(nearPole(), 14);
  EXPECT_LT(nearPole(), 26);
}

/// Where spacings grow a hundredfold within a box, one sample tells nothing of the others.
TEST(FastDistribution, FollowsSpacingsThatAreMuchSmallerThanBoxes)
{
  constexpr double spacing = 0.1;
  constexpr double least = 0.001;
  const glm::dvec3 place(0.13, 0.07, 0.1);
  const ElementMesh mesh =
    meshOf(Domain::Hexahedron, 1, [](const glm::dvec3& x) { return x.z - 0.1; });
  DistributionParameters parameters = withSpacing(spacing);
  parameters.spacingLimits = { { place, static_cast<float>(least) } };
  const Distribution result = distribute(mesh, parameters);
  for (const double radius : { 4.0 * least, 8.0 * least, 16.0 * least })
  {
    const auto count =
      static_cast<double>(std::count_if(result.particles.begin(), result.particles.end(),
        [&](const Particle& p) { return glm::distance(p.position.xyz, place) < radius; }));
    // The integral of 2/(sqrt(3) h^2) over a disc, h = least + slope r.
    const double slope = SizingField::GradationSlope;
    const double ratio = least / (least + slope * radius);
    const double wanted =
      4.0 * Pi / (std::sqrt(3.0) * slope * slope) * (ratio - 1.0 - std::log(ratio));
    EXPECT_NEAR(count / wanted, 1.0, 0.15) << radius;
  }
}

/// The steps of a trace are as long as the spacing where it begins; in between it may be a hundred times smaller. The
/// surface has a crease at x = 0.
TEST(FastDistribution, CurvesOfMeshesFollowSpacingsThatAreMuchSmallerThanTheirSteps)
{
  constexpr double least = 0.001;
  const ElementMesh mesh = meshOf(
    Domain::Hexahedron, 1, [](const glm::dvec3& x) { return x.z - 0.1 - 0.4 * std::abs(x.x); });
  DistributionParameters parameters = withSpacing(0.1);
  parameters.onCreases = true;
  const glm::dvec3 place(0.0, 0.37, 0.1);
  parameters.spacingLimits = { { place, static_cast<float>(least) } };
  const Distribution result = distribute(mesh, parameters);
  const auto distanceOf = [&](int p)
  { return glm::distance(result.particles[p].position.xyz, place); };
  int near = 0;
  for (const auto& [a, b] : result.edges.directed)
  {
    const double allowed =
      least + SizingField::GradationSlope * std::max(distanceOf(a), distanceOf(b));
    EXPECT_LT(length(result.particles[b].position - result.particles[a].position), 1.6 * allowed);
    near += distanceOf(a) < 10.0 * least ? 1 : 0;
  }
  // Twice the integral of 1/h over this length is 9.2, and each side of the crease has its own.
  EXPECT_GE(near, 14);
}

/// A sphere and the particles on it, of which some around the north pole are to stand nearer to each other.
struct ChangedSphere
{
  ElementMesh mesh = meshOf(Domain::Hexahedron, 3, sphere({ 0, 0, 0 }, 0.6).field);
  glm::dvec3 pole{ 0.0, 0.0, 0.6 };
  DistributionParameters parameters = withSpacing(0.04);
  Distribution before = distribute(this->mesh, this->parameters);

  ChangedSphere()
  {
    for (const Particle& particle : this->before.particles)
    {
      this->parameters.start.push_back(particle.location);
    }
    Patch place;
    place.position = this->pole;
    place.normal = { 0.0f, 0.0f, 1.0f };
    place.spacing = 0.02f;
    this->parameters.spacingLimits = { { place.position, place.spacing } };
    this->parameters.changedAround = { place };
  }

  /// How many particles of the distribution before are not among others, and how far from the pole they stood at most.
  std::pair<int, double> moved(const Distribution& after) const
  {
    std::pair<int, double> result{ 0, 0.0 };
    for (const Particle& old : this->before.particles)
    {
      const bool stays = std::any_of(after.particles.begin(), after.particles.end(),
        [&](const Particle& p) { return length(p.position - old.position) < 10.0 * tolerance; });
      result.first += stays ? 0 : 1;
      result.second =
        std::max(result.second, stays ? 0.0 : glm::distance(old.position.xyz, this->pole));
    }
    return result;
  }
};

TEST(FastDistribution, ChangesSomeParticlesAndLeavesTheOthers)
{
  ChangedSphere sphere;
  const Distribution after = distribute(sphere.mesh, sphere.parameters);
  expectHonestParticles(sphere.mesh, after);
  const auto [count, farthest] = sphere.moved(after);
  EXPECT_GT(count, 10);
  EXPECT_LT(farthest, 10.0 * 0.04);
  const auto nearPole = [&](const Distribution& some)
  {
    return std::count_if(some.particles.begin(), some.particles.end(),
      [&](const Particle& p) { return glm::distance(p.position.xyz, sphere.pole) < 0.03; });
  };
  EXPECT_GT(nearPole(after), 1.5 * static_cast<double>(nearPole(sphere.before)));
  // All are spread anew if no places are said.
  sphere.parameters.changedAround.clear();
  EXPECT_GT(sphere.moved(distribute(sphere.mesh, sphere.parameters)).second, 1.0);
}

TEST(FastDistribution, ChangedParticlesDoNotDependOnThreads)
{
  const ChangedSphere sphere;
  const Distribution one = distribute(sphere.mesh, sphere.parameters);
  const Distribution many = distribute(sphere.mesh, sphere.parameters, {}, threadedFor(5));
  ASSERT_EQ(one.particles.size(), many.particles.size());
  for (std::size_t i = 0; i < one.particles.size(); ++i)
  {
    ASSERT_EQ(one.particles[i].position.xyz, many.particles[i].position.xyz);
  }
}

TEST(FastDistribution, KeptBoxesGiveTheSameParticlesWithoutIsolation)
{
  const ElementMesh mesh = meshOf(Domain::Tetrahedron, 3, sphere({ 0, 0, 0 }, 0.6).field);
  DistributionParameters parameters = withSpacing(0.05, 10.0);
  std::vector<SurfaceBox> boxes;
  parameters.boxes = &boxes;
  const Distribution first = distribute(mesh, parameters);
  EXPECT_EQ(static_cast<std::int64_t>(boxes.size()), first.report.boxes);
  const Distribution second = distribute(mesh, parameters);
  EXPECT_LT(second.report.evaluations, first.report.evaluations);
  ASSERT_EQ(first.particles.size(), second.particles.size());
  for (std::size_t i = 0; i < first.particles.size(); ++i)
  {
    ASSERT_EQ(first.particles[i].position.xyz, second.particles[i].position.xyz);
  }
}

} // namespace
} // namespace hop::testing
