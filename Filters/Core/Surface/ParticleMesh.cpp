#include "Surface/ParticleMesh.h"

#include "Support/SortedBy.h"

#include <exception>
#include <limits>
#include <map>
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
  std::int64_t twins = 0;
  bool isDone = false;
};

/// A rank's part of the mesh; its copies of particles, and where they are at home.
struct Part
{
  Header header;
  std::vector<MeshComponent> components;
  std::vector<int> nodes;
  Buffer<Particle> copies;
  std::vector<ElementHome> foreign;
  /// Pairs of particles in the same place.
  std::vector<std::array<int, 2>> twins;
};

/// Takes the worker's mesh apart, rank by rank.
class Sorter
{
public:
  Sorter(int ranks, const Distribution& whole, const GatheredMesh& all, const ParticleMesh& mesh)
    : Whole(whole)
    , All(all)
    , Mesh(mesh)
    , CellCount(mesh.nodesPerCell > 0 ? mesh.nodes.size() / mesh.nodesPerCell : 0)
    , PlaceAtHome(whole.particles.size())
    , Copy(whole.particles.size(), none)
  {
    const Grouping particles = groupedBy(whole.particles, ranks,
      [&](const Particle& particle) { return all.homes[particle.location.element].rank; });
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
    this->Cells = groupedBy(firstNodes, ranks, [&](int node) { return this->homeOf(node).rank; });
    std::vector<int> counts(whole.particles.size(), 0);
    for (const int vertex : mesh.vertices)
    {
      ++counts[vertex];
    }
    for (std::size_t p = 0; p < mesh.vertices.size(); ++p)
    {
      if (counts[mesh.vertices[p]] > 1)
      {
        this->Shared.push_back(static_cast<int>(p));
      }
    }
  }

  Part partOf(int rank)
  {
    Part part;
    const int own = this->OwnCount[rank + 1] - this->OwnCount[rank];
    std::vector<int> copied;
    for (int c = this->Cells.start[rank]; c < this->Cells.start[rank + 1]; ++c)
    {
      const std::size_t first =
        static_cast<std::size_t>(this->Cells.order[c]) * this->Mesh.nodesPerCell;
      for (std::size_t n = first; n < first + this->Mesh.nodesPerCell; ++n)
      {
        const int node = this->Mesh.nodes[n];
        if (this->homeOf(node).rank == rank)
        {
          part.nodes.push_back(this->PlaceAtHome[node]);
          continue;
        }
        int& copy = this->Copy[this->Mesh.vertices[node]];
        if (copy == none)
        {
          copy = own + static_cast<int>(copied.size());
          copied.push_back(this->Mesh.vertices[node]);
        }
        part.nodes.push_back(copy);
      }
    }
    this->addTwins(rank, own, copied, part);
    for (const int particle : copied)
    {
      part.copies.push_back(this->Whole.particles[particle]);
      part.copies[part.copies.size() - 1].location.element = -1;
      part.foreign.push_back(this->homeOf(particle));
      this->Copy[particle] = none;
    }
    part.components = this->Mesh.parts;
    part.header = { this->Mesh, static_cast<std::int64_t>(part.components.size()),
      static_cast<std::int64_t>(part.nodes.size()), static_cast<std::int64_t>(part.foreign.size()),
      static_cast<std::int64_t>(part.twins.size()), true };
    return part;
  }

private:
  static constexpr int none = -1;

  /// Pairs each particle with the first one in its place on a rank.
  /// \param own number of particles that are at home there; copies follow them
  void addTwins(int rank, int own, const std::vector<int>& copied, Part& part) const
  {
    std::map<int, int> firstAt;
    const auto add = [&](int particle, int place)
    {
      const auto [first, isNew] = firstAt.emplace(this->Mesh.vertices[particle], place);
      if (!isNew)
      {
        part.twins.push_back({ first->second, place });
      }
    };
    for (const int particle : this->Shared)
    {
      if (this->homeOf(particle).rank == rank)
      {
        add(particle, this->PlaceAtHome[particle]);
      }
    }
    for (std::size_t n = 0; n < copied.size() && !this->Shared.empty(); ++n)
    {
      add(copied[n], own + static_cast<int>(n));
    }
  }

  const ElementHome& homeOf(int particle) const
  {
    return this->All.homes[this->Whole.particles[particle].location.element];
  }

  const Distribution& Whole;
  const GatheredMesh& All;
  const ParticleMesh& Mesh;
  const std::size_t CellCount;
  /// The index of each particle among those of its rank.
  std::vector<int> PlaceAtHome;
  /// Of each rank, summed up.
  std::vector<int> OwnCount;
  Grouping Cells;
  /// Particles that are not alone in their places.
  std::vector<int> Shared;
  /// The index of each particle's copy on the rank at hand.
  std::vector<int> Copy;
};

void send(Exchange& exchange, const Part& part, int to)
{
  sendArray(exchange, &part.header, 1, to);
  sendArray(exchange, part.components.data(), part.components.size(), to);
  sendArray(exchange, part.nodes.data(), part.nodes.size(), to);
  sendArray(exchange, part.copies.data(), part.copies.size(), to);
  sendArray(exchange, part.foreign.data(), part.foreign.size(), to);
  sendArray(exchange, part.twins.data(), part.twins.size(), to);
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
    part.twins.resize(part.header.twins);
  }
  catch (const std::exception&)
  {
    fits = false;
  }
  receiveArray(exchange, fits ? part.components.data() : nullptr, part.header.components, from);
  receiveArray(exchange, fits ? part.nodes.data() : nullptr, part.header.nodes, from);
  receiveArray(exchange, fits ? part.copies.data() : nullptr, part.header.foreign, from);
  receiveArray(exchange, fits ? part.foreign.data() : nullptr, part.header.foreign, from);
  receiveArray(exchange, fits ? part.twins.data() : nullptr, part.header.twins, from);
  return fits && part.header.isDone ? std::move(part) : std::optional<Part>();
}

/// Sends all parts but the worker's own, which it keeps. A part that memory does not hold is sent as none.
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
    catch (const std::exception&)
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
  for (const auto& [first, other] : part.twins)
  {
    mesh.vertices[other] = first;
  }
}

} // namespace

bool bringMeshHome(Exchange& exchange, int worker, const Distribution& whole, bool isDone,
  const GatheredMesh& all, ParticleMesh& mesh, Distribution& home)
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
          parts.emplace(exchange.size(), whole, all, mesh);
        }
      }
      catch (const std::exception&)
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
