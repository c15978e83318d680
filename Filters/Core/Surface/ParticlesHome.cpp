#include "Surface/ParticlesHome.h"

#include "Support/SortedBy.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <optional>

namespace hop
{

namespace
{

/// What the worker sends ahead of a rank's particles.
struct Header
{
  std::int64_t particles = 0;
  std::int64_t undecidedCells = 0;
  std::int64_t evaluations = 0;
  std::int64_t iterations = 0;
  std::int64_t boxes = 0;
  std::int64_t boxesUndecided = 0;
  std::int64_t singularPoints = 0;
  std::int64_t particlesRejected = 0;
  std::int64_t particlesUndersampled = 0;
  std::int64_t facesReached = 0;
  std::int64_t facesEnded = 0;
  bool converged = true;
  bool isDone = false;
};

Header headerOf(const DistributionReport& report)
{
  Header header;
  header.evaluations = report.evaluations;
  header.iterations = report.iterations;
  header.boxes = report.boxes;
  header.boxesUndecided = report.boxesUndecided;
  header.singularPoints = report.singularPoints;
  header.particlesRejected = report.particlesRejected;
  header.particlesUndersampled = report.particlesUndersampled;
  header.facesReached = report.facesReached;
  header.facesEnded = report.facesEnded;
  header.converged = report.converged;
  header.isDone = !report.aborted;
  return header;
}

DistributionReport reportOf(const Header& header)
{
  DistributionReport report;
  report.evaluations = header.evaluations;
  report.iterations = header.iterations;
  report.boxes = header.boxes;
  report.boxesUndecided = header.boxesUndecided;
  report.singularPoints = header.singularPoints;
  report.particlesRejected = header.particlesRejected;
  report.particlesUndersampled = header.particlesUndersampled;
  report.facesReached = header.facesReached;
  report.facesEnded = header.facesEnded;
  report.converged = header.converged;
  report.aborted = !header.isDone;
  return report;
}

/// A rank's part of what the worker has.
struct Part
{
  Header header;
  Buffer<Particle> particles;
  std::vector<std::int64_t> undecidedCells;
};

/// Takes the worker's particles apart, rank by rank.
class Sorter
{
public:
  Sorter(Exchange& exchange, const Distribution& distribution, const GatheredMesh& all,
    const std::vector<MeshSize>& sizes, const ParallelFor& parallelFor)
    : Source(distribution)
    , All(all)
    , Sizes(sizes)
    , Parallel(parallelFor)
    , OfRanks(groupedBy(
        distribution.particles, static_cast<std::size_t>(exchange.size()),
        [&](const Particle& particle) { return all.homes[particle.location.element].rank; },
        parallelFor))
  {
    // Room for the largest part: writing parts needs no more memory.
    std::size_t most = 0;
    for (std::size_t r = 0; r + 1 < this->OfRanks.start.size(); ++r)
    {
      most = std::max<std::size_t>(most, this->OfRanks.start[r + 1] - this->OfRanks.start[r]);
    }
    this->Room.particles.reserve(most);
    this->Room.undecidedCells.reserve(distribution.report.undecidedCells.size());
  }

  /// What belongs to a rank; until the next call.
  const Part& partOf(int rank)
  {
    const int begin = this->OfRanks.start[rank];
    this->Room.particles.resize(this->OfRanks.start[rank + 1] - begin);
    forAll(this->Parallel, this->Room.particles.size(),
      [&](std::size_t i)
      {
        Particle& particle = this->Room.particles[i];
        particle = this->Source.particles[this->OfRanks.order[begin + i]];
        particle.location.element = this->All.homes[particle.location.element].element;
      });
    this->findUndecided(rank);
    this->Room.header = headerOf(this->Source.report);
    this->Room.header.particles = static_cast<std::int64_t>(this->Room.particles.size());
    this->Room.header.undecidedCells = static_cast<std::int64_t>(this->Room.undecidedCells.size());
    return this->Room;
  }

private:
  void findUndecided(int rank)
  {
    std::int64_t first = 0;
    for (int r = 0; r < rank; ++r)
    {
      first += this->Sizes[r].cells;
    }
    this->Room.undecidedCells.clear();
    for (const std::int64_t cell : this->Source.report.undecidedCells)
    {
      if (cell >= first && cell < first + this->Sizes[rank].cells)
      {
        this->Room.undecidedCells.push_back(cell - first);
      }
    }
  }

  const Distribution& Source;
  const GatheredMesh& All;
  const std::vector<MeshSize>& Sizes;
  const ParallelFor& Parallel;
  const Grouping OfRanks;
  Part Room;
};

void sendPart(Exchange& exchange, const Part& part, int to)
{
  sendArray(exchange, &part.header, 1, to);
  sendArray(exchange, part.particles.data(), part.particles.size(), to);
  sendArray(exchange, part.undecidedCells.data(), part.undecidedCells.size(), to);
}

/// Receives a rank's part; where memory does not hold it, it is thrown away.
/// \return whether there was a part
bool receivePart(Exchange& exchange, int from, HomeParticles& home)
{
  Header header;
  receiveArray(exchange, &header, 1, from);
  Distribution& result = home.distribution;
  result.report = reportOf(header);
  try
  {
    result.particles.resize(header.particles);
    result.report.undecidedCells.resize(header.undecidedCells);
  }
  catch (const std::exception&)
  {
    home.lacksMemory = true;
  }
  Particle* particles = home.lacksMemory ? nullptr : result.particles.data();
  std::int64_t* cells = home.lacksMemory ? nullptr : result.report.undecidedCells.data();
  receiveArray(exchange, particles, header.particles, from);
  receiveArray(exchange, cells, header.undecidedCells, from);
  return header.isDone;
}

/// The only rank's particles.
bool takeAll(Distribution& distribution, const GatheredMesh& all, const ParallelFor& parallelFor,
  Distribution& result)
{
  result = std::move(distribution);
  forAll(parallelFor, result.particles.size(),
    [&](std::size_t i)
    {
      Location& location = result.particles[i].location;
      location.element = all.homes[location.element].element;
    });
  return !result.report.aborted;
}

/// Sends all parts but the worker's own, which it keeps. Where there are none, ranks are told so.
void sendParts(Exchange& exchange, std::optional<Sorter>& parts, HomeParticles& home)
{
  for (int to = 0; to < exchange.size(); ++to)
  {
    if (to != exchange.rank())
    {
      sendPart(exchange, parts ? parts->partOf(to) : Part(), to);
    }
  }
  try
  {
    if (parts)
    {
      const Part& own = parts->partOf(exchange.rank());
      home.distribution = { own.particles, {}, reportOf(own.header) };
      home.distribution.report.undecidedCells = own.undecidedCells;
    }
  }
  catch (const std::exception&)
  {
    home.lacksMemory = true;
  }
}

} // namespace

HomeParticles bringHome(Exchange& exchange, int worker, Distribution& distribution, bool isDone,
  const GatheredMesh& all, const std::vector<MeshSize>& sizes, const ParallelFor& parallelFor)
{
  HomeParticles home;
  bool isHere = isDone;
  if (exchange.isAlone())
  {
    isHere = isDone && takeAll(distribution, all, parallelFor, home.distribution);
  }
  else if (exchange.rank() == worker)
  {
    std::optional<Sorter> parts;
    try
    {
      if (isDone)
      {
        parts.emplace(exchange, distribution, all, sizes, parallelFor);
      }
    }
    catch (const std::exception&)
    {
      home.lacksMemory = true;
    }
    sendParts(exchange, parts, home);
    isHere = parts && !home.distribution.report.aborted;
  }
  else
  {
    isHere = receivePart(exchange, worker, home) && isDone;
  }
  home.isComplete = allAgree(exchange, isHere && !home.lacksMemory);
  return home;
}

void add(const Distribution& part, Distribution& sum)
{
  sum.particles.insert(sum.particles.end(), part.particles.begin(), part.particles.end());
  const DistributionReport& more = part.report;
  DistributionReport& report = sum.report;
  report.evaluations += more.evaluations;
  report.iterations += more.iterations;
  report.boxes += more.boxes;
  report.boxesUndecided += more.boxesUndecided;
  report.singularPoints += more.singularPoints;
  report.particlesRejected += more.particlesRejected;
  report.particlesUndersampled += more.particlesUndersampled;
  report.converged = report.converged && more.converged;
  report.aborted = report.aborted || more.aborted;
  std::vector<std::int64_t> cells;
  std::set_union(report.undecidedCells.begin(), report.undecidedCells.end(),
    more.undecidedCells.begin(), more.undecidedCells.end(), std::back_inserter(cells));
  report.undecidedCells = std::move(cells);
}

} // namespace hop
