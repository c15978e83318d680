#include "Run/RunMessages.h"

#include "Output/ParticlePacker.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hop
{

namespace
{

/// Fraction of undersampled particles above which there is a warning, and which the recommended spacing leaves; the
/// text says 1%. Smaller values warn of a few particles at a tip, larger ones hide visible flaws. Chosen by experiment.
constexpr double warnUndersampledShare = 0.01;

/// The spacing at which all but this fraction of the particles would follow the surface, if spread evenly; in the unit
/// of the run.
double resolvingSpacing(const Buffer<Particle>& particles)
{
  std::vector<double> curvatures;
  curvatures.reserve(particles.size());
  for (const Particle& particle : particles)
  {
    curvatures.push_back(particle.curvature.magnitude);
  }
  const auto above =
    static_cast<std::ptrdiff_t>(warnUndersampledShare * static_cast<double>(curvatures.size()));
  const auto rank = static_cast<std::ptrdiff_t>(curvatures.size()) - 1 - above;
  std::nth_element(curvatures.begin(), curvatures.begin() + rank, curvatures.end());
  return Particle::LargestCurvatureTimesSpacing / curvatures[rank];
}

/// What a user has to choose for fewer particles.
const char* fewerParticles(std::int64_t numberOfParticles)
{
  return numberOfParticles > 0 ? "a smaller NumberOfParticles" : "a larger Spacing";
}

/// What a user has to choose for particles that follow the curvature of the surface.
/// \param unit of lengths in the distribution, world units
std::string moreParticles(
  const Distribution& distribution, std::int64_t numberOfParticles, double unit)
{
  if (numberOfParticles > 0)
  {
    return "a larger NumberOfParticles";
  }
  std::ostringstream text;
  text << "a Spacing of " << unit * resolvingSpacing(distribution.particles)
       << ", which follows all but 1%,";
  return text.str();
}

std::string describeError(const DistributionReport& report, std::int64_t numberOfParticles)
{
  return report.error + ", which is what memory holds. Choose " +
    fewerParticles(numberOfParticles) + ".";
}

std::string describeUndecided(const InputBlocks& blocks, const DistributionReport& report)
{
  std::ostringstream text;
  text
    << "in " << report.undecidedCells.size()
    << " cells (first: " << blocks.describe(report.undecidedCells.front())
    << "; all: field data 'UnresolvedCellIds') " << report.boxesUndecided
    << " parts are not proven to hold at most one sheet of the surface; of the surface there some "
    << "may be missing, or all where sheets of it nearly coincide. Singular points found on it: "
    << report.singularPoints << ".";
  return text.str();
}

std::string describeUndersampled(
  const Distribution& distribution, std::int64_t numberOfParticles, double unit)
{
  const std::size_t count = distribution.particles.size();
  const std::int64_t undersampled = distribution.report.particlesUndersampled;
  std::ostringstream text;
  text << "at " << undersampled << " of " << count << " particles ("
       << std::lround(100.0 * undersampled / static_cast<double>(count))
       << "%) the surface bends faster than their spacing can follow. Choose "
       << moreParticles(distribution, numberOfParticles, unit) << " or a larger AngularDensity.";
  return text.str();
}

} // namespace

UserMessage describeFailure(const std::exception& failure, std::int64_t numberOfParticles)
{
  return { UserMessage::Error,
    std::string("There are no particles, as the run failed (") + failure.what() +
      "). If that is for want of memory, choose " + fewerParticles(numberOfParticles) + "." };
}

UserMessages reviewArrays(const std::vector<InputBlock>& blocks)
{
  const std::vector<std::string> names = replacedArrays(blocks);
  if (names.empty())
  {
    return {};
  }
  return { { UserMessage::Warning,
    "The output has arrays of its own with names of the input's; not passed on: " + listOf(names) +
      ". Where they are needed, copy them under other names before this filter, by Calculator "
      "for instance." } };
}

UserMessages reviewCells(const InputBlocks& blocks, const std::vector<CellCensus>& census)
{
  std::string remarks;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const std::string some = census[b].describe();
    const bool isNamed = !some.empty() && !blocks[b].name.empty();
    remarks += (isNamed ? "\n  in " + blocks[b].name + ":" : "") + some;
  }
  if (remarks.empty())
  {
    return {};
  }
  return { { UserMessage::Warning, "Not every cell is as it should be:" + remarks } };
}

UserMessages reviewDistribution(const InputBlocks& blocks, const Distribution& distribution,
  double isovalue, std::int64_t numberOfParticles, double unit)
{
  UserMessages messages;
  const auto add = [&](UserMessage::Kind kind, const std::string& text)
  {
    std::ostringstream whole;
    whole << "Isovalue " << isovalue << ": " << text;
    messages.push_back({ kind, whole.str() });
  };
  const DistributionReport& report = distribution.report;
  if (!report.error.empty())
  {
    add(UserMessage::Error, describeError(report, numberOfParticles));
  }
  else if (!report.converged)
  {
    add(UserMessage::Warning,
      "the particles did not come to rest; they lie on the surface, but less evenly than they "
      "should.");
  }
  if (report.boxesUndecided > 0)
  {
    add(UserMessage::Warning, describeUndecided(blocks, report));
  }
  if (report.particlesUndersampled >
    warnUndersampledShare * static_cast<double>(distribution.particles.size()))
  {
    add(UserMessage::Warning, describeUndersampled(distribution, numberOfParticles, unit));
  }
  return messages;
}

} // namespace hop
