// How even the Fast distribution is, and what it costs: the figures that are promised for it.

#include "Fast/FastDistribution.h"

#include "AnalyticFields.h"
#include "DistributionMeasures.h"
#include "ElementCases.h"
#include "SurfaceSeeds.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace hop::testing
{
namespace
{

constexpr double tolerance = 1e-9;

/// A closed surface of revolution, and how it is to be covered.
struct QualityCase
{
  const char* name;
  KnownSurface surface;
  /// Degree of the elements: enough to hold the surface well in bent ones.
  int degree = 4;
  SizingFunction sizing;
  glm::dvec3 axis{ 0, 0, 1 };
  /// A curve that makes the surface when turned around the axis; t in [0,1].
  std::function<glm::dvec3(double)> profile;
};

std::ostream& operator<<(std::ostream& out, const QualityCase& which)
{
  return out << which.name;
}

QualityCase sphereCase()
{
  constexpr double r = 0.6;
  return { "Sphere", sphere({ 0, 0, 0 }, r), 4, { 0.05, 0.0 }, { 0, 0, 1 },
    [](double t) { return r * glm::dvec3(std::sin(Pi * t), 0.0, std::cos(Pi * t)); } };
}

QualityCase torusCase(const char* name, double spacing, double angularDensity)
{
  constexpr double R = 0.5, r = 0.22;
  return { name, torus(R, r), 6, { spacing, angularDensity }, { 0, 0, 1 },
    [](double t)
    {
      const double v = 2.0 * Pi * t;
      return glm::dvec3(R + r * std::cos(v), 0.0, r * std::sin(v));
    } };
}

QualityCase ellipsoidCase()
{
  constexpr double a = 0.8, b = 0.35;
  return { "EllipsoidDense7", prolateEllipsoid(a, b), 5, { 0.1, 7.0 }, { 1, 0, 0 },
    [](double t) { return glm::dvec3(a * std::cos(Pi * t), b * std::sin(Pi * t), 0.0); } };
}

/// Particles of hexagonal packing: the integral of 2/(sqrt(3) h^2) over the surface.
double hexagonalCountOf(const QualityCase& which)
{
  constexpr int pieces = 4000;
  double count = 0.0;
  for (int n = 0; n < pieces; ++n)
  {
    const glm::dvec3 from = which.profile(n / double(pieces));
    const glm::dvec3 to = which.profile((n + 1) / double(pieces));
    const glm::dvec3 middle = which.profile((n + 0.5) / pieces);
    const double radius = glm::length(glm::cross(middle, which.axis));
    const double h = which.sizing.at(which.surface.curvature(middle).magnitude);
    count += hexagonalCount(2.0 * Pi * radius * glm::distance(from, to), h);
  }
  return count;
}

ElementMesh bentMesh(const QualityCase& which, Domain domain)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { which.degree, which.degree, which.degree };
  recipe.map = wavyMap(0.1);
  recipe.field = which.surface.field;
  return makeMesh(recipe);
}

/// Points on the surface in some boxes.
std::vector<glm::dvec3> probesIn(const ElementMesh& mesh, const std::vector<SurfaceBox>& boxes)
{
  std::vector<glm::dvec3> probes;
  for (const Location& seed : surfaceSeeds(mesh, 0.0, boxes))
  {
    probes.push_back(positionAt(mesh, seed));
  }
  return probes;
}

/// Points all over the surface, closer than particles.
std::vector<glm::dvec3> probesOf(const ElementMesh& mesh, double spacing)
{
  return probesIn(mesh, findSurfaceBoxes(mesh, 0.0, 0.5 * spacing, {}));
}

class FastQuality : public ::testing::TestWithParam<std::tuple<QualityCase, Domain>>
{
};

INSTANTIATE_TEST_SUITE_P(FastDistribution, FastQuality,
  ::testing::Combine(
    ::testing::Values(sphereCase(), torusCase("Torus", 0.04, 0.0),
      torusCase("TorusDense7", 0.12, 7.0), torusCase("TorusDense15", 0.15, 15.0), ellipsoidCase()),
    ::testing::ValuesIn(allDomains)),
  [](const auto& which)
  {
    return std::get<0>(which.param).name +
      ("In" + ::testing::PrintToString(std::get<1>(which.param)));
  });

TEST_P(FastQuality, IsAsPromised)
{
  const auto& [which, domain] = this->GetParam();
  const ElementMesh mesh = bentMesh(which, domain);
  DistributionParameters parameters;
  parameters.sizing = which.sizing;
  const Distribution result = distributeFast({ &mesh, 0.0, tolerance }, parameters, {}, {});
  ASSERT_TRUE(result.report.error.empty()) << result.report.error;
  const double count = static_cast<double>(result.particles.size());
  // The target for the share with six neighbours is 0.72 everywhere. The dense cases, some thousand particles on
  // strongly bent surfaces, reach 0.71 to 0.80.
  const bool even = which.sizing.angularDensity == 0.0;
  EXPECT_NEAR(count / hexagonalCountOf(which), 1.0, 0.02);
  EXPECT_LE(static_cast<double>(result.report.evaluations) / count, 8.0);
  double smallest = which.sizing.spacing;
  for (const Particle& p : result.particles)
  {
    ASSERT_LE(p.residual, tolerance);
    smallest = std::min(smallest, p.spacing);
  }
  const Evenness evenness = measureEvenness(result.particles);
  EXPECT_GE(evenness.minSpacing, 0.80);
  EXPECT_LE(evenness.variation, 0.035);
  EXPECT_GE(evenness.sixValentShare, even ? 0.72 : 0.70);
  EXPECT_GE(evenness.meanMinAngle, 50.5);
  EXPECT_GE(evenness.worstMinAngle, 30.0);
  EXPECT_EQ(evenness.openStars, 0u);
  EXPECT_LE(coverageRadius(result.particles, probesOf(mesh, smallest)), 0.80);
}

TEST_P(FastQuality, OfDraftsLeavesNoHoles)
{
  const auto& [which, domain] = this->GetParam();
  const ElementMesh mesh = bentMesh(which, domain);
  DistributionParameters parameters;
  parameters.sizing = which.sizing;
  parameters.quality = Quality::Draft;
  const Distribution result = distributeFast({ &mesh, 0.0, tolerance }, parameters, {}, {});
  double smallest = which.sizing.spacing;
  for (const Particle& p : result.particles)
  {
    ASSERT_LE(p.residual, tolerance);
    smallest = std::min(smallest, p.spacing);
  }
  EXPECT_NEAR(static_cast<double>(result.particles.size()) / hexagonalCountOf(which), 1.0, 0.09);
  // As far as splats reach.
  EXPECT_LE(coverageRadius(result.particles, probesOf(mesh, smallest)), 0.928);
}

class FastQualityOnNeedle : public ::testing::TestWithParam<double>
{
};

INSTANTIATE_TEST_SUITE_P(FastDistribution, FastQualityOnNeedle, ::testing::Values(0.0, 7.0));

TEST_P(FastQualityOnNeedle, IsCoveredAlthoughThinnerThanSpacings)
{
  const ElementMesh mesh = needleMesh();
  DistributionParameters parameters;
  parameters.sizing = { 0.04, this->GetParam() };
  const auto isCloserThanParticles = [&](const SurfaceBox& box)
  {
    constexpr double bodyEnd = 0.3;
    const bool onNeedle = positionAt(mesh, box.middle).x > bodyEnd;
    const double spacing = parameters.sizing.spacing / (onNeedle ? 1.0 + this->GetParam() : 1.0);
    return box.size <= 0.5 * spacing;
  };
  const auto probes = probesIn(mesh, findSurfaceBoxes(mesh, 0.0, isCloserThanParticles, {}));
  std::vector<double> coverages;
  for (parameters.seed = 1; parameters.seed <= 5; ++parameters.seed)
  {
    const Distribution result = distributeFast({ &mesh, 0.0, tolerance }, parameters, {}, {});
    // The needle bends less and less around as it thickens, so that spacings vary: 0.80 and 0.035 cannot be had.
    const Evenness evenness = measureEvenness(result.particles);
    EXPECT_GE(evenness.minSpacing, 0.5);
    EXPECT_LE(evenness.variation, 0.09);
    coverages.push_back(coverageRadius(result.particles, probes));
  }
  // With some seeds it is covered less well.
  std::sort(coverages.begin(), coverages.end());
  EXPECT_LE(coverages[2], 1.0);
  EXPECT_LE(coverages[4], 1.2);
}

/// A surface that ends at the faces of the cube [-1,1]^3.
struct OpenCase
{
  const char* name;
  KnownSurface surface;
};

std::ostream& operator<<(std::ostream& out, const OpenCase& which)
{
  return out << which.name;
}

class FastQualityAtBoundaries : public ::testing::TestWithParam<std::tuple<OpenCase, Domain>>
{
};

INSTANTIATE_TEST_SUITE_P(FastDistribution, FastQualityAtBoundaries,
  ::testing::Combine(
    ::testing::Values(OpenCase{ "Plane", plane({ 0, 0, 1 }, 0.05) },
      OpenCase{ "SlantedPlane", plane(glm::normalize(glm::dvec3(0.3, 0.5, 1.0)), 0.1) },
      OpenCase{ "Cylinder", cylinder(0.7) }, OpenCase{ "Sphere", sphere({ 0, 0, 0 }, 1.2) }),
    ::testing::ValuesIn(allDomains)),
  [](const auto& which)
  {
    return std::get<0>(which.param).name +
      ("In" + ::testing::PrintToString(std::get<1>(which.param)));
  });

TEST_P(FastQualityAtBoundaries, IsAsPromised)
{
  constexpr double spacing = 0.05;
  const auto& [which, domain] = this->GetParam();
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.field = which.surface.field;
  const ElementMesh mesh = makeMesh(recipe);
  DistributionParameters parameters;
  parameters.sizing.spacing = spacing;
  const Distribution result = distributeFast({ &mesh, 0.0, tolerance }, parameters, {}, {});
  const double count = static_cast<double>(result.particles.size());
  EXPECT_LE(static_cast<double>(result.report.evaluations) / count, 8.0);
  const Evenness evenness = measureEvenness(result.particles);
  EXPECT_GE(evenness.minSpacing, 0.80);
  EXPECT_LE(evenness.variation, 0.035);
  EXPECT_GE(evenness.sixValentShare, 0.72);
  EXPECT_GE(evenness.meanMinAngle, 50.5);
  EXPECT_GE(evenness.worstMinAngle, 30.0);
  EXPECT_LE(coverageRadius(result.particles, probesOf(mesh, spacing)), 0.80);
  // Only particles on boundary curves miss neighbours: there is no hole between the others.
  std::size_t onBoundary = 0;
  for (const Particle& p : result.particles)
  {
    onBoundary += boundaryFaceCount(mesh, p.location) > 0;
  }
  EXPECT_GT(onBoundary, 0u);
  EXPECT_LE(evenness.openStars, onBoundary);
}

/// Roofs, by the dihedral angle at their ridges, degrees; and what holds of all of them. Over 24 heights each: 0.820,
/// 0.820, 0.707 and 0.664 spacings between the nearest, all of them pairs across the ridge, and a variation of 0.0318,
/// 0.0321, 0.0341 and 0.0361.
struct Roofs
{
  double angle = 0.0;
  double minSpacing = 0.0;
  double variation = 0.0;
};

std::ostream& operator<<(std::ostream& out, const Roofs& roofs)
{
  return out << roofs.angle;
}

class FastQualityAtCreases : public ::testing::TestWithParam<Roofs>
{
};

// From 60 degrees on particles of the two sides repel each other less and less.
INSTANTIATE_TEST_SUITE_P(FastDistribution, FastQualityAtCreases,
  ::testing::Values(Roofs{ 15.0, 0.8, 0.0325 }, Roofs{ 30.0, 0.8, 0.0325 },
    Roofs{ 45.0, 0.7, 0.0345 }, Roofs{ 60.0, 0.65, 0.0365 }));

TEST_P(FastQualityAtCreases, IsAlmostAsPromised)
{
  const Roofs& roofs = this->GetParam();
  const double slope = std::tan(glm::radians(0.5 * roofs.angle));
  for (int n = 0; n < 8; ++n)
  {
    const double height = 0.1 + 0.0037 * n;
    MeshRecipe recipe;
    recipe.field = [=](const glm::dvec3& x)
    { return x.z - height + slope * (std::abs(x.x) + 0.3 * x.y); };
    const ElementMesh mesh = makeMesh(recipe);
    DistributionParameters parameters;
    parameters.sizing.spacing = 0.03;
    const Distribution result = distributeFast({ &mesh, 0.0, tolerance }, parameters, {}, {});
    const Evenness evenness = measureEvenness(result.particles);
    EXPECT_GE(evenness.minSpacing, roofs.minSpacing) << height;
    EXPECT_LE(evenness.variation, roofs.variation) << height;
  }
}

TEST_P(FastQuality, DoesNotDependOnThreads)
{
  const auto& [which, domain] = this->GetParam();
  const ElementMesh mesh = bentMesh(which, domain);
  DistributionParameters parameters;
  parameters.sizing = which.sizing;
  const Isosurface surface{ &mesh, 0.0, tolerance };
  const Distribution serial = distributeFast(surface, parameters, {}, {});
  for (const int threads : { 1, 2, 3, 8 })
  {
    SCOPED_TRACE(::testing::Message() << threads << " threads");
    const Distribution other = distributeFast(surface, parameters, {}, threadedFor(threads));
    EXPECT_EQ(other.report.evaluations, serial.report.evaluations);
    ASSERT_EQ(other.particles.size(), serial.particles.size());
    for (std::size_t i = 0; i < serial.particles.size(); ++i)
    {
      const Particle& a = other.particles[i];
      const Particle& b = serial.particles[i];
      ASSERT_EQ(a.location.element, b.location.element);
      ASSERT_EQ(a.location.u.xyz, b.location.u.xyz);
      ASSERT_EQ(a.position.xyz, b.position.xyz);
      ASSERT_EQ(a.normal.xyz, b.normal.xyz);
      ASSERT_EQ(a.curvature.mean, b.curvature.mean);
      ASSERT_EQ(a.residual, b.residual);
      ASSERT_EQ(a.spacing, b.spacing);
    }
  }
}

} // namespace
} // namespace hop::testing
