// How even the particles of several workers stand where they meet: as those of one worker.

#include "DistributionMeasures.h"
#include "SlabCases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

/// A flat or wavy sheet across the bar, in a direction of its own.
SlabCase turnedSheet(const char* name, Domain domain, double angle, double angularDensity)
{
  return { name, domain,
    [angle](const glm::dvec3& x)
    { return std::cos(angle) * x.x + std::sin(angle) * x.y - 0.03 * std::sin(4.0 * x.z + angle); },
    { 0.0095, angularDensity } };
}

/// A tube of a circumference of some 24 particles.
SlabCase thinTubeCase()
{
  return { "ThinTube", Domain::Hexahedron,
    [](const glm::dvec3& x) { return std::hypot(x.x - 0.02 * std::sin(3.0 * x.z), x.y) - 0.035; },
    { 0.009, 7.0 } };
}

/// A tube of which one half lies in the bar: its ends run across all cuts.
SlabCase halfTubeCase()
{
  return { "HalfTube", Domain::Tetrahedron,
    [](const glm::dvec3& x) { return std::hypot(x.x - 0.21, x.y) - 0.13; }, { 0.009, 3.0 } };
}

/// A sheet with a crease of twice atan(slope) along the bar, which passes all cuts.
SlabCase creaseAcrossCuts(const char* name, Domain domain, double slope, double angularDensity)
{
  return { name, domain,
    [slope](const glm::dvec3& x)
    { return x.x + slope * std::abs(x.y) - 0.03 * std::sin(4.0 * x.z); },
    { 0.0095, angularDensity }, 0.0 };
}

/// A sheet with a crease in the middle of the bar, where two workers and four have a cut.
SlabCase creaseAlongCut(const char* name, Domain domain, double slope, double angularDensity)
{
  return { name, domain,
    [slope](const glm::dvec3& x) { return x.x + 0.3 * x.y - 0.1 + slope * std::abs(x.z); },
    { 0.0095, angularDensity }, 0.0 };
}

SlabCase threeIsovaluesCase()
{
  SlabCase result = ellipsoidCase();
  result.name = "ThreeIsovalues";
  result.sizing.spacing = 0.012;
  result.isovalues = { -0.015, 0.0, 0.02 };
  return result;
}

std::vector<SlabCase> allCases()
{
  return { ellipsoidCase(), wavyTubeCase(), sheetCase(), steppedCase("SmallSteps", 0.0017),
    steppedCase("LargeSteps", 0.03), turnedSheet("Sheet0", Domain::Hexahedron, 0.2, 0.0),
    turnedSheet("Sheet1", Domain::Tetrahedron, 0.5, 7.0),
    turnedSheet("Sheet2", Domain::Wedge, 0.8, 0.0),
    turnedSheet("Sheet3", Domain::Hexahedron, 1.7, 7.0), thinTubeCase(), halfTubeCase(),
    creaseAcrossCuts("CreaseAcrossCuts", Domain::Hexahedron, 0.2, 0.0),
    creaseAcrossCuts("SharpCreaseAcrossCuts", Domain::Wedge, 0.5, 7.0),
    creaseAlongCut("CreaseAlongCut", Domain::Tetrahedron, 0.2, 7.0),
    creaseAlongCut("SharpCreaseAlongCut", Domain::Hexahedron, 0.5, 0.0), threeIsovaluesCase() };
}

class SlabSeams : public ::testing::TestWithParam<SlabCase>
{
};

INSTANTIATE_TEST_SUITE_P(SlabDistribution, SlabSeams, ::testing::ValuesIn(allCases()),
  [](const auto& which) { return which.param.name; });

std::ptrdiff_t boundaryCount(const Buffer<Particle>& particles)
{
  return std::count_if(particles.begin(), particles.end(),
    [](const Particle& particle)
    {
      return std::any_of(particle.clips.begin(), particle.clips.end(),
        [](const ClipPlane& plane) { return plane.isBoundary() && plane.distance == 0.0; });
    });
}

/// What one worker makes of a surface. Beside creases and jumps the least distance is chance: several seeds are tried.
struct OneWorker
{
  Buffer<Particle> particles;
  std::vector<Buffer<Particle>> ofSeeds;
  double minSpacing = 1.0;

  OneWorker(const SlabCase& which, const ElementMesh& mesh)
  {
    for (const unsigned seed : { 1, 2, 3 })
    {
      this->ofSeeds.push_back(distributeAlone(which, mesh, seed).particles);
      this->minSpacing =
        std::min(this->minSpacing, measureEvenness(this->ofSeeds.back()).minSpacing);
    }
    this->particles = this->ofSeeds.front();
  }

  /// Largest variation beside the places of cuts.
  double variationBeside(const std::vector<Slab>& slabs, double near) const
  {
    double largest = 0.0;
    for (const Buffer<Particle>& some : this->ofSeeds)
    {
      const auto isNear = [&](const Particle& particle)
      { return isBesideCut(slabs, particle.position.xyz, near); };
      largest = std::max(largest, measureEvenness(some, isNear).variation);
    }
    return largest;
  }
};

/// Number of particles that have another one nearer than a distance, in units of the spacing.
template <class Counts>
std::size_t countNearer(const Together& together, const Counts& counts, double distance)
{
  const std::vector<double> nearest = nearestSpacings(together.particles);
  std::size_t count = 0;
  for (std::size_t i = 0; i < nearest.size(); ++i)
  {
    count += counts(together.particles[i]) && nearest[i] < distance;
  }
  return count;
}

/// How much more spacings may vary beside cuts than one worker's do there: what the two sides of a strip do not agree on
/// has no room to spread.
constexpr double roughness = 1.2;

/// Within two spacings of cuts particles stand as one worker has them, and no boundary curve is there twice or has a gap.
TEST_P(SlabSeams, FitTogether)
{
  const SlabCase& which = this->GetParam();
  const ElementMesh mesh = meshOf(which);
  const double near = 2.0 * which.sizing.spacing;
  const OneWorker alone(which, mesh);
  const std::vector<glm::dvec3> probes = probesOf(which, mesh);
  const double covered = coverageRadius(alone.particles, probes);
  const auto count = static_cast<double>(alone.particles.size());
  const auto onCurves = static_cast<double>(boundaryCount(alone.particles));
  // At small jumps chance decides which of two curves beside each other stays.
  const double curvesOff = which.jump != 0.0 ? 0.05 : 0.005;
  for (const std::size_t workers : { 2, 3, 4, 5 })
  {
    SCOPED_TRACE(workers);
    const Together together = distributeTogether(which, mesh, workers);
    const auto isNear = [&](const Particle& particle)
    { return isBesideCut(together.slabs, particle.position.xyz, near); };
    const Evenness evenness = measureEvenness(together.particles, isNear);
    // Where the least distance is chance, one pair may be nearer than those that three seeds have.
    EXPECT_LE(countNearer(together, isNear, std::min(0.82, alone.minSpacing)),
      alone.minSpacing < 0.8 ? 2 : 0);
    EXPECT_LE(
      evenness.variation, std::max(0.035, roughness * alone.variationBeside(together.slabs, near)));
    std::vector<glm::dvec3> probesNear;
    std::copy_if(probes.begin(), probes.end(), std::back_inserter(probesNear),
      [&](const glm::dvec3& probe) { return isBesideCut(together.slabs, probe, near); });
    ASSERT_FALSE(probesNear.empty());
    EXPECT_LE(coverageRadius(together.particles, probesNear), std::max(0.75, covered));
    EXPECT_NEAR(static_cast<double>(together.particles.size()), count, 0.005 * count);
    EXPECT_NEAR(static_cast<double>(boundaryCount(together.particles)), onCurves,
      static_cast<double>(workers) + curvesOff * onCurves);
  }
}

} // namespace
} // namespace hop::testing
