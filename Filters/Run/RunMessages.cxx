#include "Run/RunMessages.h"

#include "Run/Ranks.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace hop
{

namespace
{

/// What a user has to choose for fewer particles.
const char* fewerParticles(std::int64_t numberOfParticles)
{
  return numberOfParticles > 0 ? "a smaller NumberOfParticles" : "a larger Spacing";
}

std::string describeError(const DistributionReport& report, std::int64_t numberOfParticles)
{
  return report.error + ", which is what memory holds. Choose " +
    fewerParticles(numberOfParticles) + ".";
}

/// \param share of the faces of cells at which the surface ends
std::string describeGaps(double share)
{
  std::ostringstream text;
  text
    << "at " << std::lround(100.0 * share)
    << "% of the faces between cells that the surface reaches it ends. Derivatives jump there from "
       "cell to cell, so far that its two sides miss each other by more than 0.4 of the spacing. "
       "Gaps tell where the mesh is too coarse for this Quantity; a finer mesh or a higher degree "
       "closes them, another Spacing does not.";
  return text.str();
}

std::string describeUndecided(const RankBlocks& blocks, const DistributionReport& report)
{
  std::ostringstream text;
  text
    << "in " << report.undecidedCells.size()
    << " cells (first: " << blocks.describe(report.undecidedCells.front())
    << "; all, with PassDiagnostics: field data 'UnresolvedCellIds') " << report.boxesUndecided
    << " parts are not proven to hold at most one sheet of the surface; of the surface there some "
    << "may be missing, or all where sheets of it nearly coincide. Singular points found on it: "
    << report.singularPoints << ".";
  return text.str();
}

/// What to do where the surface bends too fast, or why there is nothing to do.
std::string describeAdvice(
  const SpacingAdvice& advice, const Particle& worst, std::int64_t numberOfParticles)
{
  std::ostringstream text;
  if (advice.spacing > 0.0 && numberOfParticles > 0)
  {
    text << "Choose a NumberOfParticles of " << advice.count << ".";
  }
  else if (advice.spacing > 0.0)
  {
    text << "Choose a Spacing of " << advice.spacing << ", which takes about " << advice.count
         << " particles.";
  }
  else if (advice.isBounded)
  {
    text << "SmallestSpacing keeps them apart; choose a smaller one, or 0.";
  }
  else if (advice.isSingular)
  {
    text << "The place is singular: the gradient of the field vanishes on the surface, or nearly "
            "so, and no spacing can follow it. Another isovalue may avoid it.";
  }
  else
  {
    text << "It bends with a radius of about " << advice.unit / worst.curvature.magnitude
         << " there, which more than " << SpacingAdvice::MostTimes
         << " times the particles would be needed to follow.";
  }
  return text.str();
}

std::string describeUndersampled(const RankBlocks& blocks, const Distribution& distribution,
  const SpacingAdvice& advice, std::int64_t cell, std::int64_t numberOfParticles)
{
  const std::size_t count = distribution.particles.size();
  const std::int64_t undersampled = distribution.report.particlesUndersampled;
  const Particle& worst = distribution.particles[advice.worst];
  const glm::dvec3 x = advice.unit * worst.position.xyz;
  std::ostringstream text;
  text << "at " << undersampled << " of " << count << " particles ("
       << std::lround(100.0 * static_cast<double>(undersampled) / static_cast<double>(count))
       << "%) the surface bends faster than their spacing can follow, most at (" << x.x << ", "
       << x.y << ", " << x.z << ") in " << blocks.describe(cell) << ". "
       << describeAdvice(advice, worst, numberOfParticles);
  return text.str();
}

/// Lowest and highest value of the chosen scalar on all ranks, magnitudes where they are contoured; the lowest is above
/// the highest where there are no values.
std::array<double, 2> rangeOfValues(const InputBlocks& blocks)
{
  vtkBoundingBox box;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const auto [lowest, highest] =
      finiteRange(blocks[b].grid, blocks[b].scalars, blocks.component());
    if (lowest <= highest)
    {
      box.AddPoint(lowest, 0.0, 0.0);
      box.AddPoint(highest, 0.0, 0.0);
    }
  }
  const vtkBoundingBox all = overAllRanks(box);
  return { all.GetBound(0), all.GetBound(1) };
}

const char* nameOf(Quantity quantity)
{
  switch (quantity)
  {
    case Quantity::Value:
      break;
    case Quantity::GradientMagnitude:
      return "The magnitude of the gradient";
    case Quantity::Divergence:
      return "The divergence";
    case Quantity::VorticityMagnitude:
      return "The magnitude of the vorticity";
    case Quantity::QCriterion:
      return "The Q criterion";
    case Quantity::Lambda2:
      return "Lambda 2";
    case Quantity::Expression:
      return "The expression";
  }
  return "The value";
}

/// "in cell 7, at (1, 2, 3)"
std::string describePlace(const RankBlocks& blocks, std::int64_t cell, const glm::dvec3& place)
{
  std::ostringstream text;
  text << "in " << blocks.describe(cell) << ", at (" << place.x << ", " << place.y << ", "
       << place.z << ")";
  return text.str();
}

/// "Isovalue 7: no surface. 'u' goes from 0 to 1."
std::string describeMissing(const InputBlocks& blocks, const std::vector<std::string>& isovalues,
  const std::array<double, 2>& range)
{
  const char* name = blocks.size() > 0 ? blocks[0].scalars->GetName() : nullptr;
  std::ostringstream text;
  text << (isovalues.size() == 1 ? "Isovalue " : "Isovalues ") << listOf(isovalues)
       << ": no surface. ";
  if (blocks.isDerived())
  {
    text << nameOf(blocks.quantity()) << " of "
         << (name ? "'" + std::string(name) + "'" : "the array")
         << (isovalues.size() == 1 ? " does not take this value" : " does not take these values")
         << " in any cell.";
    return text.str();
  }
  text << (blocks.isMagnitude() ? "The magnitude of " : "")
       << (name ? "'" + std::string(name) + "'" : std::string("The array"));
  if (range[0] <= range[1])
  {
    text << " goes from " << range[0] << " to " << range[1] << ".";
  }
  else
  {
    text << " has no finite value.";
  }
  return text.str();
}

} // namespace

std::string describeExpected(double particles)
{
  // Three digits: the number is an estimate.
  constexpr double digits = 1e3;
  std::int64_t unit = 1;
  while (particles >= digits * static_cast<double>(unit))
  {
    unit *= 10;
  }
  std::string count = std::to_string(unit * std::llround(particles / static_cast<double>(unit)));
  for (std::ptrdiff_t place = static_cast<std::ptrdiff_t>(count.size()) - 3; place > 0; place -= 3)
  {
    count.insert(static_cast<std::size_t>(place), ",");
  }
  return "Distributing about " + count + " particles";
}

UserMessage describeFailure(const std::exception& failure, std::int64_t numberOfParticles)
{
  return { UserMessage::Error,
    std::string("There are no particles, as the run failed (") + failure.what() +
      "). If that is for want of memory, choose " + fewerParticles(numberOfParticles) + "." };
}

UserMessages reviewArrays(const std::vector<InputBlock>& blocks, const PassedArrays& passed)
{
  const std::vector<std::string> names = replacedArrays(blocks, passed);
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

UserMessages reviewDistribution(const RankBlocks& blocks, const Distribution& distribution,
  double isovalue, std::int64_t numberOfParticles)
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
  // Share of the faces that is worth a warning: with fewer gaps the surface looks whole. Chosen by experiment.
  constexpr double manyFaces = 0.1;
  const double share = static_cast<double>(report.facesEnded) /
    static_cast<double>(std::max<std::int64_t>(report.facesReached, 1));
  if (blocks.origin().quantity != Quantity::Value && share > manyFaces)
  {
    add(UserMessage::Warning, describeGaps(share));
  }
  return messages;
}

UserMessage reviewUndersampled(const RankBlocks& blocks, const Distribution& distribution,
  const SpacingAdvice& advice, std::int64_t cell, double isovalue, std::int64_t numberOfParticles)
{
  std::ostringstream whole;
  whole << "Isovalue " << isovalue << ": "
        << describeUndersampled(blocks, distribution, advice, cell, numberOfParticles);
  return { UserMessage::Warning, whole.str() };
}

UserMessages reviewMesh(
  const RankBlocks& blocks, const ElementMesh& elements, const IsovalueParticles& some, double unit)
{
  const ParticleMesh& mesh = some.mesh;
  const Buffer<Particle>& particles = some.distribution.particles;
  std::ostringstream text;
  text << "Isovalue " << some.isovalue << ": ";
  if (mesh.openLoops > 0)
  {
    text << "the mesh has " << mesh.openLoops
         << " holes that are no boundary curves of the surface, " << unit * mesh.openLength
         << " long together; the longest, " << unit * mesh.longestLoop << ", "
         << describePlace(blocks,
              elements.elements[particles[mesh.onLongestLoop].location.element].cell,
              unit * particles[mesh.onLongestLoop].position.xyz)
         << ". ";
  }
  if (mesh.straightNodes > 0)
  {
    text << mesh.straightNodes
         << " nodes of curved triangles were not found on the surface and stay on straight edges. ";
  }
  if (mesh.unusedParticles > 0)
  {
    text << mesh.unusedParticles << " particles are corners of no triangle, and left out. ";
  }
  if (mesh.turnedTriangles > 0)
  {
    text << mesh.turnedTriangles
         << " triangles are turned away from the surface at a corner, as no others close small "
            "holes. ";
  }
  if (mesh.openLoops == 0 && mesh.straightNodes == 0 && mesh.unusedParticles == 0 &&
    mesh.turnedTriangles == 0)
  {
    return {};
  }
  const auto unproven = std::find_if(
    mesh.parts.begin(), mesh.parts.end(), [](const MeshComponent& part) { return !part.proven; });
  if (unproven != mesh.parts.end())
  {
    text << mesh.unprovenComponents
         << " components of mesh and surface are not proven to agree; the "
         << "first passes a point "
         << describePlace(blocks, unproven->cell, unit * unproven->place.xyz)
         << " (all: field data 'ComponentPoint' where 'ComponentProven' is 0). ";
  }
  const DistributionReport& report = some.distribution.report;
  text << "Of its particles " << report.particlesUndersampled << " are undersampled; of its boxes "
       << report.boxesUndecided << " are undecided, with " << report.singularPoints
       << " singular points. A smaller Spacing helps where the surface bends fast.";
  return { { UserMessage::Warning, text.str() } };
}

UserMessages reviewSurfaces(const InputBlocks& blocks, const std::vector<double>& isovalues,
  const std::vector<std::int64_t>& counts, bool isExplained)
{
  const bool explained = sumOfRanks(isExplained ? 1.0 : 0.0) > 0.0;
  const bool isEmpty = sumOfRanks(static_cast<double>(blocks.cellCount())) == 0.0;
  const std::array<double, 2> range = rangeOfValues(blocks);
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < isovalues.size(); ++i)
  {
    const bool isOutside =
      !blocks.isDerived() && (isovalues[i] < range[0] || isovalues[i] > range[1]);
    if (sumOfRanks(static_cast<double>(counts[i])) == 0.0 && (isOutside || !explained))
    {
      std::ostringstream text;
      text << isovalues[i];
      missing.push_back(text.str());
    }
  }
  UserMessages messages;
  if (isEmpty && !explained)
  {
    messages.push_back({ UserMessage::Warning, "There is no surface: the input has no cells." });
  }
  else if (!isEmpty && !missing.empty())
  {
    messages.push_back({ UserMessage::Warning, describeMissing(blocks, missing, range) });
  }
  return isFirstOfRanks() ? messages : UserMessages();
}

} // namespace hop
