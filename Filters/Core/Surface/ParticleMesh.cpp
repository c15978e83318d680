#include "Surface/ParticleMesh.h"

#include "Support/SortedBy.h"

#include <exception>
#include <optional>

namespace hop
{

namespace
{

/// What the worker sends ahead of a rank's part.
struct Header
{
  MeshNumbers numbers;
  std::int64_t components = 0;
  std::int64_t nodes = 0;
  std::int64_t foreign = 0;
  std::int64_t shared = 0;
  bool isDone = false;
};

/// A rank's part of the mesh; its copies of particles, and where they are at home.
struct Part
{
  Header header;
  std::vector<MeshComponent> components;
  std::vector<int> nodes;
  Buffer<Particle> copies;
  std::vector<ForeignHome> foreign;
  std::vector<std::array<int, 2>> shared;
};

/// Takes the worker's mesh apart, rank by rank.
class Sorter
{
public:
  /// \param parallelFor may throw Interrupted, as in partOf()
  Sorter(int ranks, const Distribution& whole, const GatheredMesh& all, const BlockOfCell& blockOf,
    const ParticleMesh& mesh, const ParallelFor& parallelFor)
    : Whole(whole)
    , All(all)
    , BlockOf(blockOf)
    , Mesh(mesh)
    , Parallel(parallelFor)
    , CellCount(mesh.nodesPerCell > 0 ? mesh.nodes.size() / mesh.nodesPerCell : 0)
    , PlaceAtHome(whole.particles.size())
    , Copy(whole.particles.size(), none)
    , IsTouched(whole.particles.size(), 0)
  {
    const Grouping particles = groupedBy(
      whole.particles, ranks,
      [&](const Particle& particle) { return all.homes[particle.location.element].rank; },
      parallelFor);
    for (int r = 0; r < ranks; ++r)
    {
      for (int n = particles.start[r]; n < particles.start[r + 1]; ++n)
      {
        this->PlaceAtHome[particles.order[n]] = n - particles.start[r];
      }
    }
    this->OwnCount = particles.start;
    std::vector<int> firstNodes(this->CellCount);
    for (std::size_t c = 0; c < this->CellCount; ++c)
    {
      firstNodes[c] = mesh.nodes[c * mesh.nodesPerCell];
    }
    this->Cells = groupedBy(
      firstNodes, ranks, [&](int node) { return this->homeOf(node).rank; }, parallelFor);
  }

  Part partOf(int rank)
  {
    Part part;
    this->Rank = rank;
    this->Copied.clear();
    for (int c = this->Cells.start[rank]; c < this->Cells.start[rank + 1]; ++c)
    {
      if (c % cellsPerQuestion == 0)
      {
        this->ask();
      }
      const std::size_t first =
        static_cast<std::size_t>(this->Cells.order[c]) * this->Mesh.nodesPerCell;
      for (std::size_t n = first; n < first + this->Mesh.nodesPerCell; ++n)
      {
        const int node = this->Mesh.nodes[n];
        part.nodes.push_back(this->placeOf(node));
        this->IsTouched[this->Mesh.vertices[node]] = 1;
      }
    }
    for (const auto& [first, particle] : this->Mesh.shared)
    {
      if (this->IsTouched[first])
      {
        part.shared.push_back({ this->placeOf(first), this->placeOf(particle) });
      }
    }
    this->addCopies(part);
    this->IsTouched.assign(this->IsTouched.size(), 0);
    part.components = this->Mesh.parts;
    part.header = { this->Mesh, static_cast<std::int64_t>(part.components.size()),
      static_cast<std::int64_t>(part.nodes.size()), static_cast<std::int64_t>(part.foreign.size()),
      static_cast<std::int64_t>(part.shared.size()), true };
    return part;
  }

private:
  static constexpr int none = -1;
  /// A millisecond or less; more cells make the caller wait for an answer, fewer cost questions.
  static constexpr int cellsPerQuestion = 4096;

  /// Asks the caller whether to go on, as loops do.
  void ask() const
  {
    forAll(this->Parallel, 1, [](std::size_t) {});
  }

  const Element& elementOf(int particle) const
  {
    return this->All.mesh.elements[this->Whole.particles[particle].location.element];
  }
  const ElementHome& homeOf(int particle) const
  {
    return this->All.homes[this->Whole.particles[particle].location.element];
  }

  /// The index of a particle on the rank at hand, which gets a copy where the particle is not at home there.
  int placeOf(int particle)
  {
    if (this->homeOf(particle).rank == this->Rank)
    {
      return this->PlaceAtHome[particle];
    }
    if (this->Copy[particle] == none)
    {
      const int own = this->OwnCount[this->Rank + 1] - this->OwnCount[this->Rank];
      this->Copy[particle] = own + static_cast<int>(this->Copied.size());
      this->Copied.push_back(particle);
    }
    return this->Copy[particle];
  }

  void addCopies(Part& part)
  {
    for (const int particle : this->Copied)
    {
      part.copies.push_back(this->Whole.particles[particle]);
      part.copies[part.copies.size() - 1].location.element = -1;
      part.foreign.push_back(
        { this->homeOf(particle), this->BlockOf(this->elementOf(particle).cell) });
      this->Copy[particle] = none;
    }
  }

  const Distribution& Whole;
  const GatheredMesh& All;
  const BlockOfCell& BlockOf;
  const ParticleMesh& Mesh;
  const ParallelFor& Parallel;
  const std::size_t CellCount;
  /// The index of each particle among those of its rank.
  std::vector<int> PlaceAtHome;
  /// Of each rank, summed up.
  std::vector<int> OwnCount;
  Grouping Cells;
  /// The rank at hand; the particles that it gets copies of, and the index of each particle's copy there.
  int Rank = 0;
  std::vector<int> Copied;
  std::vector<int> Copy;
  /// Whether a cell of the rank at hand has a corner in the place of this first particle.
  std::vector<char> IsTouched;
};

void send(Exchange& exchange, const Part& part, int to)
{
  sendArray(exchange, &part.header, 1, to);
  sendArray(exchange, part.components.data(), part.components.size(), to);
  sendArray(exchange, part.nodes.data(), part.nodes.size(), to);
  sendArray(exchange, part.copies.data(), part.copies.size(), to);
  sendArray(exchange, part.foreign.data(), part.foreign.size(), to);
  sendArray(exchange, part.shared.data(), part.shared.size(), to);
}

/// \return nothing where there is none, or memory does not hold it
std::optional<Part> receive(Exchange& exchange, int from)
{
  Part part;
  receiveArray(exchange, &part.header, 1, from);
  bool fits = true;
  try
  {
    part.components.resize(part.header.components);
    part.nodes.resize(part.header.nodes);
    part.copies.resize(part.header.foreign);
    part.foreign.resize(part.header.foreign);
    part.shared.resize(part.header.shared);
  }
  catch (const std::exception&)
  {
    fits = false;
  }
  receiveArray(exchange, fits ? part.components.data() : nullptr, part.header.components, from);
  receiveArray(exchange, fits ? part.nodes.data() : nullptr, part.header.nodes, from);
  receiveArray(exchange, fits ? part.copies.data() : nullptr, part.header.foreign, from);
  receiveArray(exchange, fits ? part.foreign.data() : nullptr, part.header.foreign, from);
  receiveArray(exchange, fits ? part.shared.data() : nullptr, part.header.shared, from);
  return fits && part.header.isDone ? std::move(part) : std::optional<Part>();
}

/// Sends all parts but the worker's own, which it keeps. Where memory does not hold a part, or the caller asks for an
/// early end, ranks are sent none from then on.
std::optional<Part> sendParts(Exchange& exchange, std::optional<Sorter>& parts)
{
  std::optional<Part> own;
  for (int to = 0; to < exchange.size(); ++to)
  {
    Part part;
    try
    {
      part = parts ? parts->partOf(to) : Part();
    }
    catch (...)
    {
      part = {};
      parts.reset();
    }
    if (to != exchange.rank())
    {
      send(exchange, part, to);
    }
    else if (part.header.isDone)
    {
      own = std::move(part);
    }
  }
  return own;
}

/// Makes a part this rank's mesh.
void take(Part&& part, ParticleMesh& mesh, Distribution& home)
{
  mesh = {};
  static_cast<MeshNumbers&>(mesh) = part.header.numbers;
  mesh.parts = std::move(part.components);
  mesh.nodes = std::move(part.nodes);
  mesh.foreign = std::move(part.foreign);
  for (const Particle& copy : part.copies)
  {
    home.particles.push_back(copy);
  }
  for (std::size_t p = 0; p < home.particles.size(); ++p)
  {
    mesh.vertices.push_back(static_cast<int>(p));
  }
  mesh.shared = std::move(part.shared);
  for (const auto& [first, particle] : mesh.shared)
  {
    mesh.vertices[particle] = first;
  }
}

} // namespace

std::vector<std::array<int, 2>> sharedPlaces(const std::vector<int>& first)
{
  std::vector<int> counts(first.size(), 0);
  for (const int particle : first)
  {
    ++counts[particle];
  }
  std::vector<std::array<int, 2>> shared;
  for (std::size_t p = 0; p < first.size(); ++p)
  {
    if (counts[first[p]] > 1)
    {
      shared.push_back({ first[p], static_cast<int>(p) });
    }
  }
  return shared;
}

bool bringMeshHome(Exchange& exchange, int worker, const Distribution& whole, bool isDone,
  const GatheredMesh& all, const BlockOfCell& blockOf, ParticleMesh& mesh, Distribution& home,
  const ParallelFor& parallelFor)
{
  if (exchange.isAlone())
  {
    return isDone;
  }
  bool isHere = isDone;
  try
  {
    std::optional<Part> part;
    if (exchange.rank() == worker)
    {
      std::optional<Sorter> parts;
      try
      {
        if (isDone)
        {
          parts.emplace(exchange.size(), whole, all, blockOf, mesh, parallelFor);
        }
      }
      catch (...)
      {
        isHere = false;
      }
      part = sendParts(exchange, parts);
    }
    else
    {
      part = receive(exchange, worker);
    }
    isHere = isHere && part;
    if (isHere)
    {
      take(std::move(*part), mesh, home);
    }
  }
  catch (const std::exception&)
  {
    isHere = false;
  }
  return allAgree(exchange, isHere);
}

} // namespace hop
