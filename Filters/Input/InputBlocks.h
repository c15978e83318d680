#pragma once

#include "Elements/Quantity.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkPointSet;
class vtkUnsignedCharArray;
class vtkUnstructuredGrid;

namespace hop
{

class FieldExpression;

/// One grid of the input, and the output that receives its particles or their mesh.
struct InputBlock
{
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  /// Nodal values to contour by: a point array of the grid, or an array that was made for it.
  vtkSmartPointer<vtkDataArray> scalars;
  /// vtkPolyData, or vtkUnstructuredGrid for curved triangles.
  vtkPointSet* particles = nullptr;
  /// For messages; empty where the input is one grid.
  std::string name;
  /// Modification time of what the scalars were made of.
  vtkMTimeType scalarsTime = 0;
  /// Its place in a composite, VTK's flat index: the same on all ranks. 0 where the input is one grid.
  int number = 0;
};

/// A cell, given by its block and its number in the block.
struct BlockCell
{
  std::size_t block = 0;
  vtkIdType cell = 0;
};

/// Grids that are contoured as one mesh. Their cells are numbered through: first the cells of the first block, then the
/// cells of the second, and so on.
class InputBlocks
{
public:
  static constexpr int Magnitude = -1;

  /// \param blocks all with the same number of components; none where only other ranks have blocks
  /// \param component of the scalars, or Magnitude
  /// \param quantity of the component, or of all components
  /// \param expression of the scalars' components, where that is the quantity
  InputBlocks(std::vector<InputBlock> blocks, int component, Quantity quantity = Quantity::Value,
    std::shared_ptr<const FieldExpression> expression = nullptr);

  std::size_t size() const { return this->Blocks.size(); }
  const InputBlock& operator[](std::size_t block) const { return this->Blocks[block]; }
  int component() const { return this->Component; }
  /// The same blocks, contoured by another component.
  Quantity quantity() const { return this->ItsQuantity; }
  const std::shared_ptr<const FieldExpression>& expression() const { return this->Expression; }
  InputBlocks withComponent(int component) const
  {
    return { this->Blocks, component, this->ItsQuantity, this->Expression };
  }
  /// Whether all components of the scalars are read, not only one.
  bool readsAllComponents() const { return this->Component == Magnitude; }
  bool isDerived() const { return this->ItsQuantity != Quantity::Value; }
  bool isMagnitude() const { return this->readsAllComponents() && !this->isDerived(); }
  std::int64_t cellCount() const { return this->FirstCells.back(); }
  /// The number of a block's first cell; for block size() the number of all cells.
  std::int64_t firstCell(std::size_t block) const { return this->FirstCells[block]; }
  /// \pre 0 <= number < cellCount()
  BlockCell locate(std::int64_t number) const;
  /// "cell 7", or "cell 7 of block 'wing'".
  std::string describe(std::int64_t number) const;

private:
  std::vector<InputBlock> Blocks;
  int Component;
  Quantity ItsQuantity;
  std::shared_ptr<const FieldExpression> Expression;
  std::vector<std::int64_t> FirstCells;
};

/// The component of the blocks' scalars to contour by, or InputBlocks::Magnitude.
/// \param asked number of components or more for the magnitude; scalars have but one component
/// \param quantity that may need all components
int componentOf(
  const std::vector<InputBlock>& blocks, int asked, Quantity quantity = Quantity::Value);

/// Whether a cell belongs to another piece, is hidden, or was replaced by finer cells. Such a cell is left out: the
/// piece that it belongs to has it, too. Other bits of `vtkGhostType` are ignored.
/// \param ghosts the grid's ghost array, or nullptr
bool isGhostCell(vtkUnsignedCharArray* ghosts, vtkIdType cell);

/// The bounds of the points of a grid with finite coordinates, without points that only ghost cells have.
vtkBoundingBox finiteBounds(vtkUnstructuredGrid* grid);

/// The lowest and highest finite value of an array of a grid's points, without points that only ghost cells have.
/// \param component or InputBlocks::Magnitude
/// \return the lowest above the highest where there is none
std::array<double, 2> finiteRange(vtkUnstructuredGrid* grid, vtkDataArray* values, int component);

} // namespace hop
