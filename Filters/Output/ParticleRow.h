#pragma once

#include "Conversion/GridElements.h"
#include "Surface/Particles.h"

#include "vtkUnstructuredGrid.h"

namespace hop
{

/// A particle on its way to its row of the output.
struct ParticleRow
{
  const Particle* particle = nullptr;
  double isovalue = 0.0;
};

/// Looks up the cells in which the particles of one block stand.
class RowCells
{
public:
  RowCells(const InputBlocks& blocks, std::size_t block, const GridElements& elements)
    : Grid(blocks[block].grid)
    , FirstCell(blocks.firstCell(block))
    , Mesh(elements.mesh)
  {
  }

  /// The number of the particle's cell in the block's grid.
  vtkIdType cellOf(const ParticleRow& row) const
  {
    return this->Mesh.elements[row.particle->location.element].cell - this->FirstCell;
  }

  /// VTK's type of the particle's cell.
  int cellTypeOf(const ParticleRow& row) const
  {
    return this->Grid->GetCellType(this->cellOf(row));
  }

private:
  vtkUnstructuredGrid* Grid;
  std::int64_t FirstCell;
  const ElementMesh& Mesh;
};

} // namespace hop
