#include "Run/ParticleRun.h"

#include "Common/VtkThreads.h"
#include "Conversion/GridElements.h"
#include "Elements/CornerNumbers.h"
#include "Elements/GatheredMesh.h"
#include "Fast/SlabMeshes.h"
#include "Fast/SlabPlan.h"
#include "Fast/SlabWorkers.h"
#include "Input/BlockGroups.h"
#include "Output/ParticlePacker.h"
#include "Run/EarlyEnd.h"
#include "Run/RankBlocks.h"
#include "Run/Ranks.h"
#include "Run/RunMessages.h"
#include "Run/SurfaceWorker.h"
#include "Run/Work.h"
#include "Support/Interruptible.h"
#include "Surface/ParticlesHome.h"

#include "vtkPolyData.h"

#include <exception>
#include <functional>
#include <new>
#include <optional>

namespace hop
{

namespace
{

/// Where the progress of a group stands, as a fraction. The values only move the progress bar: they are roughly the
/// shares of the time, chosen by experiment.
struct ProgressAt
{
  /// Cells that can hold surface are known.
  static constexpr double Judged = 0.02;
  /// Cells are converted to elements.
  static constexpr double Converted = 0.03;
  /// Elements are joined.
  static constexpr double Joined = 0.1;
  /// Particles of all isovalues are distributed; packing follows.
  static constexpr double Distributed = 0.95;
};

/// The part of a run that is about one group of blocks, which are contoured as one mesh. Where it fails or is
/// interrupted on one rank, it goes on with the other ranks to the next step that all take together, where all leave.
class GroupRun
{
public:
  /// \param blocks none where only other ranks have blocks of the group
  GroupRun(Exchange& exchange, const InputBlocks& blocks, std::size_t group,
    const RunProperties& properties, const RunScale& scale, const RunCaller& caller,
    PreviousRun& previous)
    : Ranks(exchange)
    , Blocks(blocks)
    , AllBlocks(exchange, blocks)
    , Group(group)
    , Properties(properties)
    , Scale(scale)
    , Caller(caller)
    , Previous(previous)
    , IsSound(!caller.isAborted())
  {
  }

  /// \param counts one an isovalue; receives the numbers of particles in addition to what is there
  /// \return whether all ranks have their particles; the same on all ranks
  bool run(const Work& work, std::vector<std::int64_t>& counts);

private:
  template <class Use>
  void attempt(const Use& use);
  bool areAllSound() { return allAgree(this->Ranks, this->IsSound); }
  std::size_t numberOf(std::size_t isovalue) const
  {
    return this->Group * this->Properties.isovalues.size() + isovalue;
  }
  /// The rank that distributes the particles of an isovalue. It follows from the isovalue's number alone, so that the
  /// rank that remembers the particles of the last run is asked again.
  int workerOf(std::size_t isovalue) const
  {
    return static_cast<int>(this->numberOf(isovalue) % this->Ranks.size());
  }
  bool isWorker(int rank) const;
  std::optional<GridElements> convert(const Work& work);
  bool gather(GridElements& elements);
  std::vector<IsovalueParticles> distribute(const GridElements& elements, const Work& work);
  bool bringHome(std::vector<IsovalueParticles>& particles, const Work& work);
  bool distributeAtWorkers(
    GridElements& elements, const Work& work, std::vector<IsovalueParticles>& particles);
  bool plan(const GridElements& elements, const Work& work);
  bool distributeInSlabs(
    GridElements& elements, const Work& work, std::vector<IsovalueParticles>& particles);
  void distributeSlabsOf(
    const SlabMeshes& meshes, double fieldIsovalue, const Work& work, IsovalueParticles& some);
  bool bringSlabsHome(const SlabMeshes& meshes, std::vector<Distribution>& ofSlabs,
    const Work& work, Distribution& home);
  void attemptAgain(const std::exception_ptr& failure);

  Exchange& Ranks;
  const InputBlocks& Blocks;
  const RankBlocks AllBlocks;
  std::size_t Group;
  const RunProperties& Properties;
  const RunScale& Scale;
  const RunCaller& Caller;
  PreviousRun& Previous;
  /// Of all ranks' elements.
  std::vector<MeshSize> Sizes;
  /// Of each isosurface.
  std::vector<Slab> Slabs;
  /// On workers: the elements of all ranks.
  GatheredMesh All;
  /// Whether nothing has failed on this rank, and nobody has asked it to stop.
  bool IsSound;
};

/// Does some work that is this rank's own, unless something has failed before.
template <class Use>
void GroupRun::attempt(const Use& use)
{
  if (!this->IsSound)
  {
    return;
  }
  try
  {
    use();
  }
  catch (const Interrupted&)
  {
    this->IsSound = false;
  }
  catch (const std::exception& failure)
  {
    this->IsSound = false;
    this->Caller.tell({ describeFailure(failure, this->Properties.numberOfParticles) });
  }
}

bool GroupRun::isWorker(int rank) const
{
  for (std::size_t i = 0; i < this->Properties.isovalues.size(); ++i)
  {
    if (this->workerOf(i) == rank)
    {
      return true;
    }
  }
  return false;
}

bool GroupRun::run(const Work& work, std::vector<std::int64_t>& counts)
{
  std::optional<GridElements> elements = this->convert(work);
  if (!elements || !this->plan(*elements, work))
  {
    return false;
  }
  std::vector<IsovalueParticles> particles;
  const bool isDone = this->Slabs.size() > 1
    ? this->distributeInSlabs(*elements, work, particles)
    : this->distributeAtWorkers(*elements, work, particles);
  if (!isDone)
  {
    return false;
  }
  std::vector<ForeignCorners> foreign;
  this->attempt(
    [&]()
    {
      const Work packing = work.part(ProgressAt::Distributed, 1.0);
      Interruptible loops(packing.monitor, packing.parallelFor);
      foreign = packParticles(this->Blocks, *elements, particles, this->Properties.passed, loops);
    });
  if (this->Properties.outputType != OutputType::Particles)
  {
    const Work asking = work.part(1.0, 1.0);
    Interruptible loops(asking.monitor, asking.parallelFor);
    askForForeignCorners(
      this->Ranks, this->Blocks, *elements, foreign, this->IsSound, std::ref(loops));
    this->IsSound = this->IsSound && !this->Caller.isAborted();
  }
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    counts[i] += static_cast<std::int64_t>(particles[i].distribution.particles.size());
  }
  return this->areAllSound();
}

/// Converts this rank's cells.
/// \return nothing, on all ranks, where one of them has failed
std::optional<GridElements> GroupRun::convert(const Work& work)
{
  Interruptible loops(work.monitor, work.parallelFor);
  std::optional<GridConversion> conversion;
  std::optional<GridElements> elements;
  UnitCounts counts;
  this->attempt(
    [&]()
    {
      conversion.emplace(this->Blocks, this->Properties.nodeSpacing, this->Properties.isovalues,
        originFor(this->AllBlocks.range()), this->Scale.unit);
      counts = conversion->judge(std::ref(loops));
      loops.raiseFraction(ProgressAt::Judged);
      loops.ask();
    });
  // Cells of all ranks are divided alike, so that their parts meet face to face.
  const auto countResolved = [&]()
  { return sumOfRanks(this->Ranks, conversion ? conversion->countResolved() : ResolvedCounts{}); };
  for (int halvings = firstHalvings(this->Blocks.quantity());
       isWorthDividing(this->Blocks.quantity(), countResolved(), halvings);)
  {
    ++halvings;
    this->attempt(
      [&]()
      {
        counts = conversion->divideCells(halvings, std::ref(loops));
        loops.ask();
      });
  }
  const double unit = usualUnit(sumOfRanks(this->Ranks, counts));
  this->attempt(
    [&]()
    {
      elements = conversion->convert(unit, std::ref(loops));
      loops.raiseFraction(ProgressAt::Converted);
      loops.ask();
      this->Caller.tell(reviewCells(this->Blocks, elements->census));
    });
  return this->areAllSound() ? std::move(elements) : std::nullopt;
}

/// Finds out how many workers an isosurface has. More than one make neither meshes, given numbers nor
/// polygons, and remember nothing for the next run.
/// \return false, on all ranks, where one of them has failed
bool GroupRun::plan(const GridElements& elements, const Work& work)
{
  const RunProperties& asked = this->Properties;
  this->Slabs.assign(1, Slab());
  if (asked.particlesPerWorker == 0 || asked.isClassic || asked.numberOfParticles > 0 ||
    asked.isWarmStart || asked.outputType != OutputType::Particles || !asked.polygons.empty())
  {
    return true;
  }
  std::vector<double> isovalues;
  for (const double isovalue : asked.isovalues)
  {
    if (elements.canBe(isovalue))
    {
      isovalues.push_back(elements.fieldIsovalue(isovalue));
    }
  }
  const SurfaceWorker worker(
    elements.mesh, this->AllBlocks, asked, this->Scale, this->Caller, this->Previous);
  if (!isovalues.empty())
  {
    Interruptible loops(work.monitor, work.parallelFor);
    loops.raiseFraction(ProgressAt::Converted);
    SlabPlan slabs =
      planSlabs(this->Ranks, elements.mesh, isovalues, worker.parametersOf(0.0).sizing,
        static_cast<double>(asked.particlesPerWorker), std::ref(loops));
    this->attemptAgain(slabs.failure);
    this->Slabs = std::move(slabs.slabs);
  }
  return this->areAllSound();
}

/// Passes on what went wrong in a step that all ranks took together.
void GroupRun::attemptAgain(const std::exception_ptr& failure)
{
  this->attempt(
    [&]()
    {
      if (failure)
      {
        std::rethrow_exception(failure);
      }
    });
}

/// Distributes the particles of all isovalues in slabs, and brings them home.
/// \return false, on all ranks, where one of them has failed
bool GroupRun::distributeInSlabs(
  GridElements& elements, const Work& work, std::vector<IsovalueParticles>& particles)
{
  Interruptible loops(work.monitor, work.parallelFor);
  loops.raiseFraction(ProgressAt::Converted);
  const SlabMeshes meshes = gatherSlabs(this->Ranks, elements.mesh, this->Blocks.cellCount(),
    this->Slabs, this->Scale.spacing, this->IsSound, std::ref(loops));
  this->attemptAgain(meshes.failure);
  elements.mesh.releaseFields();
  if (!meshes.isComplete)
  {
    return false;
  }
  this->Sizes = gatherFromAll(this->Ranks, sizeOf(elements.mesh, this->Blocks.cellCount()));
  const std::vector<double>& isovalues = this->Properties.isovalues;
  const double share =
    (ProgressAt::Distributed - ProgressAt::Joined) / static_cast<double>(isovalues.size());
  for (std::size_t i = 0; i < isovalues.size(); ++i)
  {
    particles.emplace_back().isovalue = isovalues[i];
    if (elements.canBe(isovalues[i]))
    {
      const double begin = ProgressAt::Joined + static_cast<double>(i) * share;
      this->distributeSlabsOf(meshes, elements.fieldIsovalue(isovalues[i]),
        work.part(begin, begin + share), particles[i]);
    }
    if (!this->areAllSound())
    {
      return false;
    }
  }
  return true;
}

/// Distributes the particles of one isovalue, and brings them home.
void GroupRun::distributeSlabsOf(
  const SlabMeshes& meshes, double fieldIsovalue, const Work& work, IsovalueParticles& some)
{
  const auto workerOn = [&](const ElementMesh& mesh)
  {
    return SurfaceWorker(
      mesh, this->AllBlocks, this->Properties, this->Scale, this->Caller, this->Previous);
  };
  SlabResult result = hop::distributeInSlabs(this->Ranks, this->Slabs, meshes.meshes,
    { nullptr, fieldIsovalue, this->Scale.tolerance },
    workerOn(meshes.meshes[0].mesh).parametersOf(some.isovalue), this->IsSound, work.monitor,
    work.parallelFor);
  this->attemptAgain(result.failure);
  this->attempt(
    [&]()
    {
      for (std::size_t slab = 0; slab < this->Slabs.size(); ++slab)
      {
        workerOn(meshes.meshes[slab].mesh)
          .review(some.isovalue, fieldIsovalue, result.distributions[slab], work.part(1.0, 1.0));
      }
    });
  this->IsSound = this->IsSound && result.isComplete && !this->Caller.isAborted();
  if (!result.isComplete ||
    !this->bringSlabsHome(meshes, result.distributions, work.part(1.0, 1.0), some.distribution))
  {
    this->IsSound = false;
  }
}

/// \param home receives this rank's particles, and the sums of the reports of all slabs
/// \return false, on all ranks, where one of them has failed
bool GroupRun::bringSlabsHome(const SlabMeshes& meshes, std::vector<Distribution>& ofSlabs,
  const Work& work, Distribution& home)
{
  Interruptible loops(work.monitor, work.parallelFor);
  bool isComplete = true;
  for (std::size_t slab = 0; slab < ofSlabs.size(); ++slab)
  {
    HomeParticles part =
      hop::bringHome(this->Ranks, rankOfSlab(slab, ofSlabs.size(), this->Ranks.size()),
        ofSlabs[slab], this->IsSound, meshes.meshes[slab], this->Sizes, std::ref(loops), false);
    isComplete = isComplete && part.isComplete;
    this->attempt(
      [&]()
      {
        if (part.lacksMemory)
        {
          throw std::bad_alloc();
        }
        add(std::move(part.distribution), home);
      });
    ofSlabs[slab] = {};
  }
  return isComplete;
}

/// Sends this rank's elements to the workers; their coefficients are not needed here any more.
/// \return false, on all ranks, where a worker has no memory for the elements
bool GroupRun::gather(GridElements& elements)
{
  this->Sizes = gatherFromAll(this->Ranks, sizeOf(elements.mesh, this->Blocks.cellCount()));
  this->attempt(
    [&]()
    {
      if (this->isWorker(this->Ranks.rank()))
      {
        this->All = roomFor(this->Sizes);
      }
    });
  if (!this->areAllSound())
  {
    return false;
  }
  for (int worker = 0; worker < this->Ranks.size(); ++worker)
  {
    if (this->isWorker(worker))
    {
      gatherMesh(this->Ranks, worker, elements.mesh, this->Sizes, this->All);
    }
  }
  elements.mesh.releaseFields();
  return true;
}

/// Distributes the particles of isovalues with one worker each, and brings them home.
/// \return false, on all ranks, where one of them has failed
bool GroupRun::distributeAtWorkers(
  GridElements& elements, const Work& work, std::vector<IsovalueParticles>& particles)
{
  if (!this->gather(elements))
  {
    return false;
  }
  particles = this->distribute(elements, work);
  const bool isDone =
    this->bringHome(particles, work.part(ProgressAt::Distributed, ProgressAt::Distributed));
  this->All = {};
  return isDone;
}

/// Distributes the particles of the isovalues that this rank is the worker of.
/// \return one entry an isovalue; those of other workers have no particles
std::vector<IsovalueParticles> GroupRun::distribute(const GridElements& elements, const Work& work)
{
  const std::vector<double>& isovalues = this->Properties.isovalues;
  std::vector<IsovalueParticles> particles(isovalues.size());
  for (std::size_t i = 0; i < isovalues.size(); ++i)
  {
    particles[i].isovalue = isovalues[i];
  }
  if (!this->isWorker(this->Ranks.rank()))
  {
    return particles;
  }
  const double share =
    (ProgressAt::Distributed - ProgressAt::Joined) / static_cast<double>(isovalues.size());
  this->attempt(
    [&]()
    {
      Interruptible loops(work.monitor, work.parallelFor);
      loops.raiseFraction(ProgressAt::Converted);
      orderCanonically(this->All, std::ref(loops));
      joinElements(this->All.mesh, std::ref(loops));
      const SurfaceWorker worker(this->All.mesh, this->AllBlocks, this->Properties, this->Scale,
        this->Caller, this->Previous);
      for (std::size_t i = 0; i < isovalues.size() && !this->Caller.isAborted(); ++i)
      {
        if (this->workerOf(i) == this->Ranks.rank() && elements.canBe(isovalues[i]))
        {
          const double begin = ProgressAt::Joined + static_cast<double>(i) * share;
          worker.distribute(elements.fieldIsovalue(isovalues[i]), this->numberOf(i),
            work.part(begin, begin + share), particles[i]);
        }
      }
    });
  this->IsSound = this->IsSound && !this->Caller.isAborted();
  return particles;
}

/// \param particles of the isovalues that this rank is the worker of; receives this rank's of all isovalues
/// \return false, on all ranks, where one of them has failed
bool GroupRun::bringHome(std::vector<IsovalueParticles>& particles, const Work& work)
{
  Interruptible loops(work.monitor, work.parallelFor);
  bool isComplete = true;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    Distribution& distribution = particles[i].distribution;
    HomeParticles home = hop::bringHome(this->Ranks, this->workerOf(i), distribution, this->IsSound,
      this->All, this->Sizes, std::ref(loops));
    if (home.isComplete)
    {
      home.isComplete = bringMeshHome(
        this->Ranks, this->workerOf(i), distribution, this->IsSound, this->All,
        [this](std::int64_t cell) { return this->AllBlocks.blockOf(cell); }, particles[i].mesh,
        home.distribution, std::ref(loops));
    }
    distribution = std::move(home.distribution);
    isComplete = isComplete && home.isComplete;
    this->attempt(
      [&]()
      {
        if (home.lacksMemory)
        {
          throw std::bad_alloc();
        }
      });
  }
  return isComplete;
}

void empty(const InputBlocks& blocks)
{
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    blocks[b].particles->Initialize();
  }
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

RunResult ParticleRun::run(const InputBlocks& mine) const
{
  RunResult result;
  result.counts.resize(this->Properties.isovalues.size(), 0);
  const std::unique_ptr<Exchange> exchange = makeExchange();
  UserMessages messages;
  const InputBlocks blocks = mine.withComponent(agreeOnComponent(*exchange, mine, messages));
  this->Caller.tell(messages);
  std::vector<std::set<int>> groups;
  result.isComplete =
    allAgree(*exchange, messages.empty()) && this->findGroups(*exchange, blocks, groups);
  EarlyEnd early(this->Caller);
  const RunCaller& caller = early.ofAllRanks();
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const double share = 1.0 / static_cast<double>(groups.size());
    const double begin = share * static_cast<double>(g);
    const InputBlocks members = blocksOfGroup(blocks, groups[g]);
    withThreads(
      [&](const ParallelFor& parallelFor)
      {
        const Work whole{ { caller.report, caller.expect }, parallelFor };
        GroupRun group(
          *exchange, members, g, this->Properties, this->Scale, caller, this->Previous);
        if (!group.run(whole.part(begin, begin + share), result.counts))
        {
          empty(members);
          result.isComplete = false;
        }
      });
  }
  early.settle(*exchange);
  return result;
}

/// The numbers of blocks that are contoured as one mesh each.
/// \return false, on all ranks, where one of them has failed or is to stop
bool ParticleRun::findGroups(
  Exchange& exchange, const InputBlocks& blocks, std::vector<std::set<int>>& groups) const
{
  bool isSound = !this->Caller.isAborted();
  BlockPairs sharing;
  // Grouping is quick beside the rest: the progress stays at 0.
  const Monitor monitor{ [this](double) { return this->Caller.report(0.0); } };
  const auto find = [&](const ParallelFor& parallelFor)
  {
    Interruptible loops(monitor, parallelFor);
    sharing = blocksThatShareCells(blocks, std::ref(loops));
  };
  try
  {
    if (isSound && blocks.size() > 1)
    {
      withThreads(find);
    }
  }
  catch (const Interrupted&)
  {
    isSound = false;
  }
  catch (const std::exception& failure)
  {
    isSound = false;
    this->Caller.tell({ describeFailure(failure, this->Properties.numberOfParticles) });
  }
  if (!allAgree(exchange, isSound))
  {
    return false;
  }
  groups = agreeOnGroups(exchange, blocks, sharing);
  return true;
}

} // namespace hop
