#pragma once

#include "Conversion/GridElements.h"
#include "Output/ParticleRow.h"
#include "Support/Interruptible.h"
#include "Surface/ParticleMesh.h"

#include <cstdint>
#include <vector>

namespace hop
{

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
};

/// Shares out particles and cells to the blocks: a particle goes to the block of its cell, a triangle to the block of
/// its first corner. Corners in other blocks are copied.
/// \throw Interrupted
std::vector<BlockRows> shareOutToBlocks(const InputBlocks& blocks, const ElementMesh& mesh,
  const std::vector<IsovalueParticles>& isovalues, Interruptible& work);

} // namespace hop
