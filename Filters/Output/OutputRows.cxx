#include "Output/OutputRows.h"

#include "Support/SortedBy.h"

#include <array>
#include <functional>
#include <map>

namespace hop
{

namespace
{

constexpr int none = -1;

ParticleRow rowOf(const IsovalueParticles& some, int particle)
{
  ParticleRow row;
  row.particle = &some.distribution.particles[particle];
  row.isovalue = some.isovalue;
  return row;
}

/// Shares out the particles and cells of one isovalue.
class Sharing
{
public:
  Sharing(const InputBlocks& blocks, const ElementMesh& mesh, const IsovalueParticles& some,
    Interruptible& work);

  /// Adds all particles to the rows of their blocks.
  void addParticles(std::vector<BlockRows>& result) const;
  /// Adds the cells of the mesh, and the particles that they use.
  void addMesh(std::vector<BlockRows>& result);

private:
  bool isForeign(int particle) const { return this->Particles[particle].location.element < 0; }
  const ForeignHome& homeOf(int particle) const
  {
    const std::size_t firstForeign = this->Particles.size() - this->Some.mesh.foreign.size();
    return this->Some.mesh.foreign[particle - firstForeign];
  }
  /// Blocks.size() for a block that only other ranks have.
  std::size_t blockOf(int particle) const
  {
    if (!this->isForeign(particle))
    {
      return this->BlockOfElements[this->Particles[particle].location.element];
    }
    std::size_t block = 0;
    while (
      block < this->Blocks.size() && this->Blocks[block].number != this->homeOf(particle).block)
    {
      ++block;
    }
    return block;
  }
  int vertexOf(int particle) const { return this->Some.mesh.vertices[particle]; }
  void addCellsOf(std::size_t block, const std::vector<int>& cells, BlockRows& result);
  void findSides();
  void chooseParticles(std::size_t block);
  ParticleRow rowOfVertex(std::size_t block, int vertex) const;

  const InputBlocks& Blocks;
  const ElementMesh& Mesh;
  const IsovalueParticles& Some;
  const Buffer<Particle>& Particles;
  Interruptible& Work;
  std::vector<std::size_t> BlockOfElements;
  /// Particles in the order of their elements, corners of other ranks last.
  std::vector<int> Order;
  /// For each vertex of the block at hand, or `none`: the corner by which it came into the block, the particle that the
  /// block sees in its place, and its row.
  std::vector<int> StandIn;
  std::vector<int> Chosen;
  std::vector<int> RowOf;
  /// For each place on a crease the first two particles of different sides.
  std::map<int, std::array<int, 2>> SidesOf;
};

Sharing::Sharing(const InputBlocks& blocks, const ElementMesh& mesh, const IsovalueParticles& some,
  Interruptible& work)
  : Blocks(blocks)
  , Mesh(mesh)
  , Some(some)
  , Particles(some.distribution.particles)
  , Work(work)
{
  for (const Element& element : mesh.elements)
  {
    this->BlockOfElements.push_back(blocks.locate(element.cell).block);
  }
  this->Order = sortedBy(
    this->Particles, mesh.elements.size() + 1,
    [&](const Particle& particle)
    {
      const int element = particle.location.element;
      return element < 0 ? mesh.elements.size() : static_cast<std::size_t>(element);
    },
    std::ref(work));
}

void Sharing::addParticles(std::vector<BlockRows>& result) const
{
  for (const int particle : this->Order)
  {
    result[this->blockOf(particle)].rows.push_back(rowOf(this->Some, particle));
  }
}

void Sharing::addMesh(std::vector<BlockRows>& result)
{
  const ParticleMesh& mesh = this->Some.mesh;
  std::vector<std::vector<int>> cellsOfBlocks(this->Blocks.size());
  for (std::size_t first = 0; first < mesh.nodes.size(); first += mesh.nodesPerCell)
  {
    cellsOfBlocks[this->blockOf(mesh.nodes[first])].push_back(static_cast<int>(first));
  }
  this->findSides();
  this->StandIn.assign(this->Particles.size(), none);
  this->Chosen.assign(this->Particles.size(), none);
  this->RowOf.assign(this->Particles.size(), none);
  for (std::size_t b = 0; b < this->Blocks.size(); ++b)
  {
    this->Work.ask();
    result[b].nodesPerCell = mesh.nodesPerCell;
    this->addCellsOf(b, cellsOfBlocks[b], result[b]);
  }
}

void Sharing::findSides()
{
  const auto hasSide = [this](int p) { return this->Particles[p].sideNormal != glm::vec3(0.0f); };
  for (const auto& [vertex, particle] : this->Some.mesh.shared)
  {
    if (hasSide(particle))
    {
      auto& sides =
        this->SidesOf.try_emplace(vertex, std::array<int, 2>{ particle, none }).first->second;
      if (sides[1] == none &&
        this->Particles[sides[0]].sideNormal != this->Particles[particle].sideNormal)
      {
        sides[1] = particle;
      }
    }
  }
}

/// Of the particles in one place the block sees the first one of its own, so that values that jump are those of its side.
void Sharing::chooseParticles(std::size_t block)
{
  for (const auto& [vertex, particle] : this->Some.mesh.shared)
  {
    if (this->StandIn[vertex] != none && this->Chosen[vertex] == none &&
      this->blockOf(particle) == block)
    {
      this->Chosen[vertex] = particle;
    }
  }
}

/// The row of a vertex that cells of the block use.
ParticleRow Sharing::rowOfVertex(std::size_t block, int vertex) const
{
  const int particle = this->Chosen[vertex] == none ? vertex : this->Chosen[vertex];
  ParticleRow row = rowOf(this->Some, particle);
  const auto sides = this->SidesOf.find(vertex);
  if (sides != this->SidesOf.end() && sides->second[1] != none)
  {
    const auto& [first, second] = sides->second;
    row.otherSide = &this->Particles[first == particle ? second : first];
  }
  if (this->isForeign(particle) || this->blockOf(particle) != block)
  {
    row.standIn = &this->Particles[this->StandIn[vertex]];
    row.home = this->isForeign(particle) ? &this->homeOf(particle).element : nullptr;
  }
  return row;
}

/// \param cells index of the first node of each
void Sharing::addCellsOf(std::size_t block, const std::vector<int>& cells, BlockRows& result)
{
  const ParticleMesh& mesh = this->Some.mesh;
  const auto forNodes = [&](const auto& use)
  {
    for (const int first : cells)
    {
      for (int n = first; n < first + mesh.nodesPerCell; ++n)
      {
        use(mesh.nodes[first], this->vertexOf(mesh.nodes[n]));
      }
    }
  };
  forNodes([&](int corner, int vertex)
    { this->StandIn[vertex] = this->StandIn[vertex] == none ? corner : this->StandIn[vertex]; });
  this->chooseParticles(block);
  for (const int vertex : this->Order)
  {
    if (this->StandIn[vertex] != none)
    {
      this->RowOf[vertex] = static_cast<int>(result.rows.size());
      result.rows.push_back(this->rowOfVertex(block, vertex));
    }
  }
  for (const int vertex : this->Order)
  {
    if (this->RowOf[vertex] != none)
    {
      result.rows[this->RowOf[vertex]].rowOfStandIn =
        this->RowOf[this->vertexOf(this->StandIn[vertex])];
    }
  }
  const std::int64_t firstCell = this->Blocks.firstCell(block);
  forNodes([&](int, int vertex) { result.nodes.push_back(this->RowOf[vertex]); });
  for (const int first : cells)
  {
    const int element = this->Particles[mesh.nodes[first]].location.element;
    result.cells.push_back(this->Mesh.elements[element].cell - firstCell);
  }
  forNodes([&](int, int vertex)
    { this->StandIn[vertex] = this->Chosen[vertex] = this->RowOf[vertex] = none; });
}

} // namespace

std::vector<BlockRows> shareOutToBlocks(const InputBlocks& blocks, const ElementMesh& mesh,
  const std::vector<IsovalueParticles>& isovalues, Interruptible& work)
{
  std::vector<BlockRows> result(blocks.size());
  for (const IsovalueParticles& some : isovalues)
  {
    work.ask();
    Sharing sharing(blocks, mesh, some, work);
    if (some.mesh.nodesPerCell > 0)
    {
      sharing.addMesh(result);
    }
    else
    {
      sharing.addParticles(result);
    }
  }
  return result;
}

} // namespace hop
