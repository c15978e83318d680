#pragma once

#include "Conversion/GridElements.h"
#include "Output/ParticleRow.h"
#include "Support/Interruptible.h"
#include "Surface/Particles.h"

#include <cstdint>
#include <vector>

namespace hop
{

/// Cells between the particles of one isovalue.
struct ParticleMesh
{
  /// Corners of a cell, and the nodes of a curved one; 0: there is no mesh, and each particle is a cell.
  int nodesPerCell = 0;
  /// nodesPerCell indices into the particles a cell, the corners first.
  std::vector<int> nodes;
  /// For each particle the first particle in the same place: itself, but for creases.
  std::vector<int> vertices;
  /// Boundary loops that are no boundary curves of the surface, and their length, in the unit of the run.
  std::int64_t openLoops = 0;
  double openLength = 0.0;
  /// Nodes of curved cells that are not on the surface.
  std::int64_t straightNodes = 0;
  /// Connected parts of the mesh, and those that are not proven to be as the surface is, with the components of the
  /// surface that the mesh lacks.
  std::int64_t components = 0;
  std::int64_t unprovenComponents = 0;
  /// Whether the mesh is proven to have the topology of the surface.
  bool isProven = true;
};

/// Particles of one isovalue.
struct IsovalueParticles
{
  double isovalue = 0.0;
  Distribution distribution;
  ParticleMesh mesh;
};

/// What the output of one block is made of.
struct BlockRows
{
  /// One an output point: isovalue by isovalue, sorted by element, so that neighbours in memory share an element.
  std::vector<ParticleRow> rows;
  /// As ParticleMesh, of all isovalues; numbers of rows.
  int nodesPerCell = 0;
  std::vector<vtkIdType> nodes;
  /// The input's cell, by its number in the block, for each cell of a mesh: that of the first corner.
  std::vector<vtkIdType> cells;
  /// Particles of the block that no cell uses.
  std::int64_t unusedParticles = 0;
};

/// Shares out particles and cells to the blocks: a particle goes to the block of its cell, a triangle to the block of
/// its first corner. Corners in other blocks are copied.
/// \throw Interrupted
std::vector<BlockRows> shareOutToBlocks(const InputBlocks& blocks, const ElementMesh& mesh,
  const std::vector<IsovalueParticles>& isovalues, Interruptible& work);

} // namespace hop
