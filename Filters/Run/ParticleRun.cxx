#include "Run/ParticleRun.h"

#include "Classic/ClassicDistribution.h"
#include "Common/VtkThreads.h"
#include "Conversion/GridElements.h"
#include "Fast/FastDistribution.h"
#include "Input/BlockGroups.h"
#include "Output/ParticlePacker.h"
#include "Run/ParticleLimit.h"
#include "Run/Ranks.h"
#include "Run/RunMessages.h"
#include "Run/SpacingAdvice.h"
#include "Support/Interruptible.h"
#include "Surface/SpacingSearch.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

namespace hop
{

namespace
{

/// Where the progress of a group stands, as a fraction. The values only move the progress bar: they are roughly the
/// shares of the time, chosen by experiment.
struct ProgressAt
{
  /// Cells are converted to elements.
  static constexpr double Converted = 0.1;
  /// Particles of all isovalues are distributed; packing follows.
  static constexpr double Distributed = 0.95;
};

/// A part of the run, as far as progress and threads are concerned.
struct Work
{
  Monitor monitor;
  const ParallelFor& parallelFor;

  /// \param begin, end fractions of this work
  Work part(double begin, double end) const
  {
    return { { [this, begin, end](double fraction)
               { return this->monitor.proceed(begin + (end - begin) * fraction); } },
      this->parallelFor };
  }
};

/// Uses blocks for some work; if it is interrupted or memory runs out, they stay without particles.
template <class Use>
void unlessAborted(const InputBlocks& blocks, const RunProperties& properties,
  const RunCaller& caller, const Use& use)
{
  if (blocks.size() == 0 || caller.isAborted())
  {
    return;
  }
  const auto empty = [&]()
  {
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      blocks[b].particles->Initialize();
    }
  };
  try
  {
    use();
  }
  catch (const Interrupted&)
  {
    empty();
  }
  catch (const std::exception& failure)
  {
    empty();
    caller.tell({ describeFailure(failure, properties.numberOfParticles) });
  }
}

/// The part of a run that is about one group of blocks, which are contoured as one mesh.
class GroupRun
{
public:
  /// \param blocks none where only other ranks have a group of that number
  GroupRun(const InputBlocks& blocks, std::size_t group, const RunProperties& properties,
    const RunScale& scale, const RunCaller& caller, PreviousRun& previous)
    : Blocks(blocks)
    , Group(group)
    , Properties(properties)
    , Scale(scale)
    , Caller(caller)
    , Previous(previous)
  {
  }

  /// \param counts one an isovalue; receives the numbers of particles in addition to what is there
  void run(const Work& work, std::vector<std::int64_t>& counts);

private:
  template <class Use>
  void unlessAborted(const Use& use) const
  {
    hop::unlessAborted(this->Blocks, this->Properties, this->Caller, use);
  }
  GridElements convert(const Work& work) const;
  std::vector<RankShare> shareOut(const GridElements& elements, const Work& work) const;
  SurfaceCount countWanted(
    const GridElements& elements, double isovalue, double spacing, const Work& work) const;
  void fill(const GridElements& elements, const std::vector<RankShare>& shares, const Work& work,
    std::vector<std::int64_t>& counts) const;
  void reviewSpacing(const GridElements& elements, const RunOrigin& origin,
    const Distribution& distribution, const Work& work) const;
  SizingFunction sizingAt(double spacing) const;
  RunOrigin makeOrigin() const;
  Distribution distribute(const GridElements& elements, const RunOrigin& origin, std::size_t number,
    const RankShare& share, const Work& work) const;

  const InputBlocks& Blocks;
  std::size_t Group;
  const RunProperties& Properties;
  const RunScale& Scale;
  const RunCaller& Caller;
  PreviousRun& Previous;
};

/// Distributes the particles of all isovalues. A rank without blocks, or one that is to stop, takes part in what ranks
/// agree on.
void GroupRun::run(const Work& work, std::vector<std::int64_t>& counts)
{
  std::optional<GridElements> elements;
  this->unlessAborted([&]() { elements = this->convert(work.part(0.0, ProgressAt::Converted)); });
  const GridElements none;
  const std::vector<RankShare> shares = this->shareOut(
    elements ? *elements : none, work.part(ProgressAt::Converted, ProgressAt::Converted));
  if (elements)
  {
    this->unlessAborted([&]() { this->fill(*elements, shares, work, counts); });
  }
}

/// \throw Interrupted
GridElements GroupRun::convert(const Work& work) const
{
  Interruptible loops(work.monitor, work.parallelFor);
  const auto reached = [&](double share)
  {
    loops.raiseFraction(share);
    loops.ask();
  };
  GridElements elements = buildGridElements(this->Blocks, this->Properties.nodeSpacing,
    this->Properties.isovalues, std::ref(loops), reached, this->Scale.unit);
  this->Caller.tell(reviewCells(this->Blocks, elements.census));
  return elements;
}

/// How many particles of each isovalue this rank is to give, if their number is given; those in ghost cells, which
/// are not kept, are more.
std::vector<RankShare> GroupRun::shareOut(const GridElements& elements, const Work& work) const
{
  const std::vector<double>& isovalues = this->Properties.isovalues;
  const std::int64_t number = this->Properties.numberOfParticles;
  std::vector<RankShare> shares(isovalues.size(), { number, 0.0 });
  const auto isGhost = [&](const Element& element)
  { return this->Blocks.isGhost(this->Blocks.locate(element.cell)); };
  const std::vector<Element>& all = elements.mesh.elements;
  const bool isShared = isOneOfRanks() || std::any_of(all.begin(), all.end(), isGhost);
  // More than all ranks hold is refused by each of them when it is asked for.
  if (isShared && number > 0 &&
    static_cast<double>(number) <= sumOfRanks(static_cast<double>(particlesThatFit())))
  {
    shares = shareOutToRanks(number, isovalues.size(),
      SpacingSearch::FirstSpacingPerDiagonal * this->Scale.diagonal,
      [&](std::size_t i, double spacing)
      {
        SurfaceCount wanted;
        this->unlessAborted(
          [&]() { wanted = this->countWanted(elements, isovalues[i], spacing, work); });
        return wanted;
      });
  }
  return shares;
}

/// \throw Interrupted
SurfaceCount GroupRun::countWanted(
  const GridElements& elements, double isovalue, double spacing, const Work& work) const
{
  if (!elements.canBe(isovalue))
  {
    return {};
  }
  const std::vector<double> ofElements =
    particlesPerElement({ &elements.mesh, elements.fieldIsovalue(isovalue), this->Scale.tolerance },
      this->sizingAt(spacing), work.monitor, work.parallelFor);
  SurfaceCount wanted;
  for (std::size_t e = 0; e < ofElements.size(); ++e)
  {
    const bool isGhost = this->Blocks.isGhost(this->Blocks.locate(elements.mesh.elements[e].cell));
    (isGhost ? wanted.ghosts : wanted.owned) += ofElements[e];
  }
  return wanted;
}

/// Distributes particles and packs them.
/// \throw Interrupted
void GroupRun::fill(const GridElements& elements, const std::vector<RankShare>& shares,
  const Work& work, std::vector<std::int64_t>& counts) const
{
  const std::vector<double>& isovalues = this->Properties.isovalues;
  const double shareOfIsovalue =
    (ProgressAt::Distributed - ProgressAt::Converted) / static_cast<double>(isovalues.size());
  RunOrigin origin = this->makeOrigin();
  std::vector<IsovalueParticles> particles;
  for (std::size_t i = 0; i < isovalues.size() && !this->Caller.isAborted(); ++i)
  {
    origin.isovalue = isovalues[i];
    const double begin = ProgressAt::Converted + static_cast<double>(i) * shareOfIsovalue;
    particles.push_back({ origin.isovalue,
      this->distribute(elements, origin, this->Group * isovalues.size() + i, shares[i],
        work.part(begin, begin + shareOfIsovalue)) });
    counts[i] += static_cast<std::int64_t>(particles.back().distribution.particles.size());
    this->Caller.tell(reviewDistribution(this->Blocks, particles.back().distribution,
      origin.isovalue, this->Properties.numberOfParticles));
    this->reviewSpacing(elements, origin, particles.back().distribution, work);
  }
  const Work packing = work.part(ProgressAt::Distributed, 1.0);
  Interruptible loops(packing.monitor, packing.parallelFor);
  packParticles(this->Blocks, elements, particles, this->Properties.passesDiagnostics, loops);
}

/// Tells of places where the surface bends faster than the particles can follow, and what it takes to follow it.
/// \throw Interrupted
void GroupRun::reviewSpacing(const GridElements& elements, const RunOrigin& origin,
  const Distribution& distribution, const Work& work) const
{
  if (distribution.report.aborted || !hasTooManyUndersampled(distribution))
  {
    return;
  }
  const std::int64_t number = this->Properties.numberOfParticles;
  const Work rest = work.part(ProgressAt::Distributed, ProgressAt::Distributed);
  const SizingFunction sizing = this->sizingAt(number > 0 ? 0.0 : this->Scale.spacing);
  const auto countAt = [&](double spacing)
  {
    const std::vector<double> counts = particlesPerElement(
      { &elements.mesh, elements.fieldIsovalue(origin.isovalue), this->Scale.tolerance },
      this->sizingAt(spacing), rest.monitor, rest.parallelFor);
    return std::accumulate(counts.begin(), counts.end(), 0.0);
  };
  const SpacingAdvice advice = adviseSpacing(distribution, sizing, this->Scale.unit, countAt);
  const int worst = distribution.particles[advice.worst].location.element;
  this->Caller.tell({ reviewUndersampled(this->Blocks, distribution, advice,
    elements.mesh.elements[worst].cell, origin.isovalue, number) });
}

/// The sizing function with a spacing on flat surfaces, in units of the run. Nothing closer than the tolerance is told
/// apart, so that no smallest spacing is below it.
SizingFunction GroupRun::sizingAt(double spacing) const
{
  const double smallest = this->Properties.smallestSpacing;
  return { spacing, this->Properties.angularDensity,
    smallest > 0.0 ? std::max(smallest / this->Scale.unit, this->Scale.tolerance) : 0.0 };
}

/// What the group's isosurfaces are made of, but for the isovalue.
RunOrigin GroupRun::makeOrigin() const
{
  RunOrigin origin = originOf(this->Blocks);
  origin.nodeSpacing = this->Properties.nodeSpacing;
  origin.unit = this->Scale.unit;
  origin.parameters.sizing = this->sizingAt(this->Scale.spacing);
  origin.parameters.quality = this->Properties.quality;
  origin.parameters.seed = this->Properties.seed;
  origin.parameters.particleCount = this->Properties.numberOfParticles;
  origin.parameters.particleLimit = particlesThatFit();
  return origin;
}

/// \param number tells the isosurfaces of a run from one another
Distribution GroupRun::distribute(const GridElements& elements, const RunOrigin& origin,
  std::size_t number, const RankShare& share, const Work& work) const
{
  if ((this->Properties.numberOfParticles > 0 && share.count == 0) ||
    !elements.canBe(origin.isovalue))
  {
    return {};
  }
  const bool continues = this->Properties.isWarmStart && !this->Properties.isClassic;
  DistributionParameters parameters = origin.parameters;
  parameters.particleCount = share.count;
  parameters.firstSpacing = share.spacing;
  if (continues)
  {
    parameters.start = this->Previous.startOf(number, origin, elements.mesh);
  }
  const auto method = this->Properties.isClassic ? distributeClassic : distributeFast;
  Distribution distribution =
    method({ &elements.mesh, elements.fieldIsovalue(origin.isovalue), this->Scale.tolerance },
      parameters, work.monitor, work.parallelFor);
  if (continues)
  {
    this->Previous.remember(number, origin, elements.mesh, distribution, work.parallelFor);
  }
  return distribution;
}

} // namespace

ParticleRun::ParticleRun(const RunProperties& properties, const RunScale& scale,
  const RunCaller& caller, PreviousRun& previous)
  : Properties(properties)
  , Scale(scale)
  , Caller(caller)
  , Previous(previous)
{
}

std::vector<std::int64_t> ParticleRun::run(const InputBlocks& blocks) const
{
  std::vector<std::int64_t> counts(this->Properties.isovalues.size(), 0);
  const std::vector<InputBlocks> groups = this->groupsOf(blocks);
  const InputBlocks none({}, blocks.component());
  // A number of particles is shared out group by group, also by ranks that have fewer of them.
  const std::size_t count =
    this->Properties.numberOfParticles > 0 ? largestOfRanks(groups.size()) : groups.size();
  for (std::size_t g = 0; g < count; ++g)
  {
    GroupRun group(g < groups.size() ? groups[g] : none, g, this->Properties, this->Scale,
      this->Caller, this->Previous);
    const double share = 1.0 / static_cast<double>(count);
    const double begin = share * static_cast<double>(g);
    withThreads(
      [&](const ParallelFor& parallelFor)
      {
        const Work whole{ { this->Caller.report }, parallelFor };
        group.run(whole.part(begin, begin + share), counts);
      });
  }
  return counts;
}

/// Blocks that are contoured as one mesh each; none where the run is to stop.
std::vector<InputBlocks> ParticleRun::groupsOf(const InputBlocks& blocks) const
{
  if (blocks.size() == 1)
  {
    return { blocks };
  }
  std::vector<InputBlocks> groups;
  // Grouping is quick beside the rest: the progress stays at 0.
  const Monitor monitor{ [this](double) { return this->Caller.report(0.0); } };
  withThreads(
    [&](const ParallelFor& parallelFor)
    {
      Interruptible loops(monitor, parallelFor);
      unlessAborted(blocks, this->Properties, this->Caller,
        [&]() { groups = groupWithoutSharedCells(blocks, std::ref(loops)); });
    });
  return groups;
}

} // namespace hop
