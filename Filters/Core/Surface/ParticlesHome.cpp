#include "Surface/ParticlesHome.h"

#include "Support/Interruptible.h"
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

/// Particles of a message. Larger: the worker keeps a larger copy; smaller: messages are many.
constexpr std::size_t particlesPerMessage = 4096;

/// Calls use(first, count) for the particles of each message.
template <class Use>
void forMessages(std::size_t particles, const Use& use)
{
  for (std::size_t first = 0; first < particles; first += particlesPerMessage)
  {
    use(first, std::min(particlesPerMessage, particles - first));
  }
}

/// \return false where the caller asked for an early end
template <class Use>
bool wasAllowed(const Use& use)
{
  try
  {
    use();
    return true;
  }
  catch (const Interrupted&)
  {
    return false;
  }
}

/// Takes the worker's particles apart, rank by rank.
class Sorter
{
public:
  Sorter(Exchange& exchange, Distribution& distribution, const GatheredMesh& all,
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
    // Sending needs no more memory.
    this->Room.reserve(particlesPerMessage);
    this->UndecidedCells.reserve(distribution.report.undecidedCells.size());
  }

  /// Sends ahead of each message how many particles are in it: none where the caller asks for an early end.
  /// \return whether all have been sent
  bool send(Exchange& exchange, int to)
  {
    this->findUndecided(to);
    Header header = headerOf(this->Source.report);
    header.particles = static_cast<std::int64_t>(this->countOf(to));
    header.undecidedCells = static_cast<std::int64_t>(this->UndecidedCells.size());
    sendArray(exchange, &header, 1, to);
    bool goesOn = true;
    forMessages(this->countOf(to),
      [&](std::size_t first, std::size_t most)
      {
        if (!goesOn)
        {
          return;
        }
        this->Room.resize(most);
        goesOn = wasAllowed([&]() { this->copy(to, first, this->Room); });
        const std::uint64_t count = goesOn ? most : 0;
        sendArray(exchange, &count, 1, to);
        sendArray(exchange, this->Room.data(), count, to);
      });
    sendArray(exchange, this->UndecidedCells.data(), this->UndecidedCells.size(), to);
    return goesOn;
  }

  /// What belongs to a rank.
  /// \param keeps whether the distribution stays; otherwise its memory is used
  Distribution partOf(int rank, bool keeps)
  {
    this->findUndecided(rank);
    Distribution part;
    part.report = reportOf(headerOf(this->Source.report));
    part.report.undecidedCells = this->UndecidedCells;
    if (keeps)
    {
      part.particles.resize(this->countOf(rank));
      this->copy(rank, 0, part.particles);
    }
    else
    {
      this->keepOnly(rank);
      part.particles = std::move(this->Source.particles);
    }
    return part;
  }

private:
  std::size_t countOf(int rank) const
  {
    return static_cast<std::size_t>(this->OfRanks.start[rank + 1] - this->OfRanks.start[rank]);
  }

  /// Copies particles of a rank, from its first one on, as many as there is room for.
  void copy(int rank, std::size_t first, Buffer<Particle>& room) const
  {
    const std::size_t begin = static_cast<std::size_t>(this->OfRanks.start[rank]) + first;
    forAll(this->Parallel, room.size(),
      [&](std::size_t i)
      {
        Particle& particle = room[i];
        particle = this->Source.particles[this->OfRanks.order[begin + i]];
        particle.location.element = this->All.homes[particle.location.element].element;
      });
  }

  void keepOnly(int rank)
  {
    Buffer<Particle>& particles = this->Source.particles;
    std::size_t kept = 0;
    for (const Particle& particle : particles)
    {
      const ElementHome& home = this->All.homes[particle.location.element];
      if (home.rank == rank)
      {
        particles[kept] = particle;
        particles[kept++].location.element = home.element;
      }
    }
    particles.resize(kept);
  }

  void findUndecided(int rank)
  {
    std::int64_t first = 0;
    for (int r = 0; r < rank; ++r)
    {
      first += this->Sizes[r].cells;
    }
    this->UndecidedCells.clear();
    for (const std::int64_t cell : this->Source.report.undecidedCells)
    {
      if (cell >= first && cell < first + this->Sizes[rank].cells)
      {
        this->UndecidedCells.push_back(cell - first);
      }
    }
  }

  Distribution& Source;
  const GatheredMesh& All;
  const std::vector<MeshSize>& Sizes;
  const ParallelFor& Parallel;
  const Grouping OfRanks;
  Buffer<Particle> Room;
  std::vector<std::int64_t> UndecidedCells;
};

/// Receives a rank's part; where memory does not hold it, it is thrown away.
/// \return whether there was a whole part
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
  bool goesOn = true;
  forMessages(static_cast<std::size_t>(header.particles),
    [&](std::size_t first, std::size_t)
    {
      if (!goesOn)
      {
        return;
      }
      std::uint64_t count = 0;
      receiveArray(exchange, &count, 1, from);
      goesOn = count > 0;
      Particle* particles = home.lacksMemory ? nullptr : result.particles.data() + first;
      receiveArray(exchange, particles, static_cast<std::size_t>(count), from);
    });
  std::int64_t* cells = home.lacksMemory ? nullptr : result.report.undecidedCells.data();
  receiveArray(exchange, cells, header.undecidedCells, from);
  return header.isDone && goesOn;
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

/// Sends all parts but the worker's own, which it keeps. Where there are none, or none any more, ranks are told so.
void sendParts(Exchange& exchange, std::optional<Sorter>& parts, bool keeps, HomeParticles& home)
{
  for (int to = 0; to < exchange.size(); ++to)
  {
    if (to != exchange.rank() && parts)
    {
      if (!parts->send(exchange, to))
      {
        parts.reset();
      }
    }
    else if (to != exchange.rank())
    {
      const Header none;
      sendArray(exchange, &none, 1, to);
      sendArray(exchange, static_cast<const std::int64_t*>(nullptr), 0, to);
    }
  }
  try
  {
    const auto keep = [&]() { home.distribution = parts->partOf(exchange.rank(), keeps); };
    if (parts && !wasAllowed(keep))
    {
      parts.reset();
    }
  }
  catch (const std::exception&)
  {
    home.lacksMemory = true;
  }
}

/// Adds particles behind others, in the memory of either where it has room: a worker's own part leaves some.
void addBehind(Buffer<Particle>&& more, Buffer<Particle>& particles)
{
  const std::size_t before = particles.size();
  const std::size_t all = before + more.size();
  if (particles.capacity() >= all || more.capacity() < all)
  {
    particles.insert(particles.end(), more.begin(), more.end());
    return;
  }
  const auto end = more.end() - more.begin();
  more.resize(all);
  std::copy_backward(more.begin(), more.begin() + end, more.end());
  std::copy(particles.begin(), particles.end(), more.begin());
  particles = std::move(more);
}

} // namespace

HomeParticles bringHome(Exchange& exchange, int worker, Distribution& distribution, bool isDone,
  const GatheredMesh& all, const std::vector<MeshSize>& sizes, const ParallelFor& parallelFor,
  bool keeps)
{
  HomeParticles home;
  bool isHere = isDone;
  if (exchange.isAlone())
  {
    const auto take = [&]()
    { isHere = isDone && takeAll(distribution, all, parallelFor, home.distribution); };
    isHere = wasAllowed(take) && isHere;
  }
  else if (exchange.rank() == worker)
  {
    std::optional<Sorter> parts;
    try
    {
      if (isDone)
      {
        wasAllowed([&]() { parts.emplace(exchange, distribution, all, sizes, parallelFor); });
      }
    }
    catch (const std::exception&)
    {
      home.lacksMemory = true;
    }
    sendParts(exchange, parts, keeps, home);
    isHere = parts && !home.distribution.report.aborted;
  }
  else
  {
    isHere = receivePart(exchange, worker, home) && isDone;
  }
  home.isComplete = allAgree(exchange, isHere && !home.lacksMemory);
  return home;
}

void add(Distribution&& part, Distribution& sum)
{
  addBehind(std::move(part.particles), sum.particles);
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
