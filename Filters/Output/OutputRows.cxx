#include "Output/OutputRows.h"

#include "Support/SortedBy.h"

#include <functional>

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
  row.normal = row.particle->normal;
  row.area = row.particle->area;
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
  /// Blocks.size() for a corner in an element of another rank.
  std::size_t blockOf(int particle) const
  {
    return this->isForeign(particle)
      ? this->Blocks.size()
      : this->BlockOfElements[this->Particles[particle].location.element];
  }
  int firstForeign() const
  {
    return static_cast<int>(this->Particles.size() - this->Some.mesh.foreign.size());
  }
  int vertexOf(int particle) const { return this->Some.mesh.vertices[particle]; }
  void collectVertices();
  void addCellsOf(std::size_t block, const std::vector<int>& cells, BlockRows& result);

  const InputBlocks& Blocks;
  const ElementMesh& Mesh;
  const IsovalueParticles& Some;
  const Buffer<Particle>& Particles;
  Interruptible& Work;
  std::vector<std::size_t> BlockOfElements;
  /// Particles in the order of their elements, corners of other ranks last.
  std::vector<int> Order;
  /// For each vertex, what all of its particles that are used make together.
  std::vector<WorldVector> Normals;
  std::vector<double> Areas;
  std::vector<char> IsUsed;
  /// For each vertex, its row in the block at hand, or `none`; and the corner by which it came into the block.
  std::vector<int> RowOf;
  std::vector<int> StandIn;
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

/// Sums what the particles of each vertex have.
void Sharing::collectVertices()
{
  const std::size_t count = this->Particles.size();
  this->IsUsed.assign(count, 0);
  for (const int node : this->Some.mesh.nodes)
  {
    this->IsUsed[node] = 1;
  }
  this->Normals.assign(count, {});
  this->Areas.assign(count, 0.0);
  for (std::size_t p = 0; p < count; ++p)
  {
    const int particle = static_cast<int>(p);
    if (this->IsUsed[p])
    {
      const int vertex = this->vertexOf(particle);
      this->Normals[vertex] = this->Normals[vertex] + this->Particles[p].normal;
      this->Areas[vertex] += rowOf(this->Some, particle).area;
    }
  }
}

void Sharing::addMesh(std::vector<BlockRows>& result)
{
  this->collectVertices();
  const ParticleMesh& mesh = this->Some.mesh;
  std::vector<std::vector<int>> cellsOfBlocks(this->Blocks.size());
  for (std::size_t first = 0; first < mesh.nodes.size(); first += mesh.nodesPerCell)
  {
    cellsOfBlocks[this->blockOf(mesh.nodes[first])].push_back(static_cast<int>(first));
  }
  this->RowOf.assign(this->Particles.size(), none);
  this->StandIn.assign(this->Particles.size(), none);
  for (std::size_t b = 0; b < this->Blocks.size(); ++b)
  {
    this->Work.ask();
    result[b].nodesPerCell = mesh.nodesPerCell;
    this->addCellsOf(b, cellsOfBlocks[b], result[b]);
  }
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
  for (const int vertex : this->Order)
  {
    if (this->StandIn[vertex] != none)
    {
      this->RowOf[vertex] = static_cast<int>(result.rows.size());
      ParticleRow row = rowOf(this->Some, vertex);
      const WorldVector& sum = this->Normals[vertex];
      const bool isMean = sum.xyz != row.normal.xyz && length(sum) > 0.0;
      row.normal = isMean ? (1.0 / length(sum)) * sum : row.normal;
      row.area = this->Areas[vertex];
      result.rows.push_back(row);
    }
  }
  for (const int vertex : this->Order)
  {
    if (this->RowOf[vertex] != none && this->blockOf(vertex) != block)
    {
      const int corner = this->StandIn[vertex];
      ParticleRow& row = result.rows[this->RowOf[vertex]];
      if (this->vertexOf(corner) == vertex)
      {
        row.particle = &this->Particles[corner]; // the same place, seen from this block
        continue;
      }
      if (this->isForeign(vertex))
      {
        row.home = &this->Some.mesh.foreign[vertex - this->firstForeign()];
      }
      row.standIn = &this->Particles[corner];
      row.rowOfStandIn = this->RowOf[this->vertexOf(corner)];
    }
  }
  const std::int64_t firstCell = this->Blocks.firstCell(block);
  forNodes([&](int, int vertex) { result.nodes.push_back(this->RowOf[vertex]); });
  for (const int first : cells)
  {
    const int element = this->Particles[mesh.nodes[first]].location.element;
    result.cells.push_back(this->Mesh.elements[element].cell - firstCell);
  }
  forNodes([&](int, int vertex) { this->RowOf[vertex] = this->StandIn[vertex] = none; });
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
