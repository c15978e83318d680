#pragma once

#include "Conversion/GridElements.h"
#include "Surface/ParticleMesh.h"

#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>

namespace hop
{

/// A particle on its way to its row of the output.
struct ParticleRow
{
  const Particle* particle = nullptr;
  double isovalue = 0.0;
  /// Of a mesh's particle on a crease: a particle in the same place on another side; nullptr otherwise.
  const Particle* otherSide = nullptr;
  /// For a corner of a mesh that lies in another block, or on another rank: a corner of the same triangle in this block,
  /// and its row.
  const Particle* standIn = nullptr;
  std::ptrdiff_t rowOfStandIn = -1;
  /// Where such a corner is at home if that is on another rank; nullptr otherwise.
  const ElementHome* home = nullptr;

  const Location& location() const { return this->particle->location; }
  /// Where this rank evaluates what the row is to have: at its stand-in until the particle's own rank is asked.
  const Location& evaluated() const
  {
    return (this->home ? this->standIn : this->particle)->location;
  }
};

/// Looks up the cells in which the particles of one block stand.
class RowCells
{
public:
  RowCells(const InputBlocks& blocks, std::size_t block, const GridElements& elements)
    : Blocks(blocks)
    , Grid(blocks[block].grid)
    , FirstCell(blocks.firstCell(block))
    , Elements(elements)
    , Mesh(elements.mesh)
    , UnitOfLength(elements.units.length)
    , UnitOfValue(elements.units.value)
    , IsSquared(elements.squared)
  {
  }

  /// A length of the run in world units; the same of a curvature, which is an inverse length.
  double length(double ofRun) const { return ofRun * this->UnitOfLength; }
  double curvature(double ofRun) const { return finite(ofRun / this->UnitOfLength); }
  /// The position of a particle in world units.
  WorldPoint position(const ParticleRow& row) const
  {
    return { this->UnitOfLength * row.particle->position.xyz };
  }
  /// A difference of the mesh's field, in the unit of the chosen scalar, squared where the field is.
  double difference(double ofRun) const
  {
    return finite(ofRun * this->UnitOfValue * (this->IsSquared ? this->UnitOfValue : 1.0));
  }

  /// An area of the run in world units squared.
  double area(double ofRun) const { return finite(this->length(this->length(ofRun))); }

  /// Where the particle stands in its cell. Of a particle at home on another rank: in its element.
  ReferencePoint inCell(const ParticleRow& row) const
  {
    return row.location().element < 0 ? row.location().u : this->Elements.inCell(row.location());
  }

  /// The number of the particle's cell in the block's grid, or of its stand-in's.
  vtkIdType cellOf(const ParticleRow& row) const
  {
    const Particle& particle = row.standIn ? *row.standIn : *row.particle;
    return this->Mesh.elements[particle.location.element].cell - this->FirstCell;
  }

  /// VTK's type of the particle's own cell.
  int cellTypeOf(const ParticleRow& row) const
  {
    if (!row.standIn || row.home)
    {
      return this->Grid->GetCellType(this->cellOf(row));
    }
    const BlockCell own = this->Blocks.locate(this->Mesh.elements[row.location().element].cell);
    return this->Blocks[own.block].grid->GetCellType(own.cell);
  }

private:
  /// Numbers beyond the largest double become that double: curvatures of tiny surfaces, squares of large values.
  static double finite(double number)
  {
    constexpr double largest = std::numeric_limits<double>::max();
    return std::clamp(number, -largest, largest);
  }

  const InputBlocks& Blocks;
  vtkUnstructuredGrid* Grid;
  std::int64_t FirstCell;
  const GridElements& Elements;
  const ElementMesh& Mesh;
  double UnitOfLength;
  double UnitOfValue;
  bool IsSquared;
};

} // namespace hop
