#include "Fast/SlabWorkers.h"

#include "Fast/SlabDistribution.h"
#include "Fast/SlabMessages.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

namespace hop
{
namespace
{

/// A worker on this rank.
struct Worker
{
  Worker(std::size_t number, const GatheredMesh& all)
    : slab(number)
    , mesh(all)
    , elements(all.homes)
  {
  }

  std::size_t slab;
  const GatheredMesh& mesh;
  ElementsByHome elements;
  Monitor monitor;
  std::optional<SlabDistribution> distribution;
  /// What it hears from the slab before or behind.
  Bytes heard;
};

class SlabWorkers
{
public:
  SlabWorkers(Exchange& exchange, const std::vector<Slab>& slabs, bool isSound)
    : Ranks(exchange)
    , Slabs(slabs)
    , IsSound(isSound)
  {
  }

  SlabResult run(const std::vector<GatheredMesh>& meshes, const Isosurface& surface,
    const DistributionParameters& parameters, const Monitor& monitor,
    const ParallelFor& parallelFor);

private:
  bool areAllSound() { return allAgree(this->Ranks, this->IsSound); }
  bool isHere(std::size_t slab) const
  {
    return rankOfSlab(slab, this->Slabs.size(), this->Ranks.size()) == this->Ranks.rank();
  }
  Worker& workerOf(std::size_t slab);
  template <class Use>
  bool attempt(const Use& use)
  {
    return attemptOnAll(this->Ranks, this->IsSound, this->Result.failure, use);
  }
  Monitor monitorOf(std::size_t worker, const Monitor& monitor);
  void makeWorkers(const std::vector<GatheredMesh>& meshes, const Isosurface& surface,
    const DistributionParameters& parameters, const Monitor& monitor,
    const ParallelFor& parallelFor);
  void relax();
  bool tell(bool goesForth);
  void pass(std::size_t from, std::size_t to, Bytes&& bytes);
  void keepErrorsOnly();

  Exchange& Ranks;
  const std::vector<Slab>& Slabs;
  /// Whether nothing has failed on this rank.
  bool IsSound;
  std::vector<std::unique_ptr<Worker>> Workers;
  /// The largest fraction that was reported: workers of one rank take turns.
  double Reported = 0.0;
  SlabResult Result;
};

Worker& SlabWorkers::workerOf(std::size_t slab)
{
  return **std::find_if(this->Workers.begin(), this->Workers.end(),
    [slab](const std::unique_ptr<Worker>& worker) { return worker->slab == slab; });
}

/// A worker's part of the progress.
Monitor SlabWorkers::monitorOf(std::size_t worker, const Monitor& monitor)
{
  return { [this, worker, &monitor](double fraction)
    {
      const auto count = static_cast<double>(this->Workers.size());
      this->Reported = std::max(this->Reported, (static_cast<double>(worker) + fraction) / count);
      return monitor.proceed(this->Reported);
    } };
}

void SlabWorkers::makeWorkers(const std::vector<GatheredMesh>& meshes, const Isosurface& surface,
  const DistributionParameters& parameters, const Monitor& monitor, const ParallelFor& parallelFor)
{
  for (std::size_t slab = 0; slab < this->Slabs.size(); ++slab)
  {
    if (this->isHere(slab))
    {
      this->Workers.push_back(std::make_unique<Worker>(slab, meshes[slab]));
    }
  }
  for (std::size_t n = 0; n < this->Workers.size(); ++n)
  {
    Worker& worker = *this->Workers[n];
    worker.monitor = this->monitorOf(n, monitor);
    Isosurface own = surface;
    own.mesh = &worker.mesh.mesh;
    worker.distribution.emplace(
      own, parameters, this->Slabs[worker.slab], worker.monitor, parallelFor);
  }
}

/// Lets workers begin. One that refuses the request says why, and no other goes on.
void SlabWorkers::relax()
{
  for (const auto& worker : this->Workers)
  {
    std::string& error = this->Result.distributions[worker->slab].report.error;
    error = worker->distribution->relax();
    this->IsSound = this->IsSound && error.empty();
  }
}

/// Passes a message on from one slab to the one beside it.
void SlabWorkers::pass(std::size_t from, std::size_t to, Bytes&& bytes)
{
  const auto rankOf = [&](std::size_t slab)
  { return rankOfSlab(slab, this->Slabs.size(), this->Ranks.size()); };
  if (this->isHere(from) && this->isHere(to))
  {
    this->workerOf(to).heard = std::move(bytes);
  }
  else if (this->isHere(from))
  {
    const auto size = static_cast<std::uint64_t>(bytes.size());
    sendArray(this->Ranks, &size, 1, rankOf(to));
    sendArray(this->Ranks, bytes.data(), bytes.size(), rankOf(to));
  }
  else if (this->isHere(to))
  {
    std::uint64_t size = 0;
    receiveArray(this->Ranks, &size, 1, rankOf(from));
    Bytes& heard = this->workerOf(to).heard;
    try
    {
      heard.resize(size);
    }
    catch (const std::exception&)
    {
      // The message has to be received all the same.
      this->IsSound = false;
      this->Result.failure = std::current_exception();
    }
    receiveArray(this->Ranks, heard.size() == size ? heard.data() : nullptr,
      static_cast<std::size_t>(size), rankOf(from));
  }
}

/// Lets workers tell the slab behind of their last particles, or the slab before of their first ones.
/// \return whether all have been told
bool SlabWorkers::tell(bool goesForth)
{
  const std::size_t cuts = this->Slabs.size() - 1;
  std::vector<Bytes> messages;
  const bool isWritten = this->attempt(
    [&]()
    {
      messages.resize(cuts);
      for (std::size_t cut = 0; cut < cuts; ++cut)
      {
        const std::size_t from = goesForth ? cut : cut + 1;
        if (this->isHere(from))
        {
          const Worker& worker = this->workerOf(from);
          messages[cut] = written(goesForth ? worker.distribution->lastParticles()
                                            : worker.distribution->firstParticles(),
            worker.mesh.homes);
        }
      }
    });
  for (std::size_t cut = 0; isWritten && cut < cuts; ++cut)
  {
    this->pass(goesForth ? cut : cut + 1, goesForth ? cut + 1 : cut, std::move(messages[cut]));
  }
  return isWritten && this->areAllSound();
}

/// Drops what workers of this rank have made before another one failed.
void SlabWorkers::keepErrorsOnly()
{
  for (Distribution& some : this->Result.distributions)
  {
    Distribution failed;
    failed.report.error = std::move(some.report.error);
    some = std::move(failed);
  }
}

SlabResult SlabWorkers::run(const std::vector<GatheredMesh>& meshes, const Isosurface& surface,
  const DistributionParameters& parameters, const Monitor& monitor, const ParallelFor& parallelFor)
{
  const auto settle = [&]()
  {
    for (const auto& worker : this->Workers)
    {
      if (worker->slab + 1 < this->Slabs.size())
      {
        worker->distribution->settleEnd(readParticles(worker->heard, worker->elements));
      }
      worker->heard = {};
    }
  };
  const auto finish = [&]()
  {
    for (const auto& worker : this->Workers)
    {
      this->Result.distributions[worker->slab] =
        worker->distribution->finish(readParticles(worker->heard, worker->elements));
      worker->distribution.reset();
    }
  };
  this->Result.isComplete =
    this->attempt(
      [&]()
      {
        this->Result.distributions.resize(this->Slabs.size());
        this->makeWorkers(meshes, surface, parameters, monitor, parallelFor);
        this->relax();
      }) &&
    this->tell(false) && this->attempt(settle) && this->tell(true) && this->attempt(finish);
  if (!this->Result.isComplete)
  {
    this->keepErrorsOnly();
  }
  return std::move(this->Result);
}

} // namespace

SlabResult distributeInSlabs(Exchange& exchange, const std::vector<Slab>& slabs,
  const std::vector<GatheredMesh>& meshes, const Isosurface& surface,
  const DistributionParameters& parameters, bool isSound, const Monitor& monitor,
  const ParallelFor& parallelFor)
{
  return SlabWorkers(exchange, slabs, isSound)
    .run(meshes, surface, parameters, monitor, parallelFor);
}

} // namespace hop
