#pragma once

#include "Input/InputChecks.h"

#include <functional>
#include <string>

namespace hop
{

/// Of a cell of a grid.
using CellTest = std::function<bool(vtkUnstructuredGrid*, vtkIdType)>;

/// The blocks with the arrays that a formula names: their scalars are the components of all of these, side by side.
CheckedBlocks checkExpression(const GatheredBlocks& gathered, const std::string& text);

/// The blocks with a quantity at their nodes as scalars: made of the means of the gradients, by VTK's cells, in all cells
/// around a node, also where several points stand in its place. Blocks that nothing is derived of stay as they are.
/// \param component of the scalars, or InputBlocks::Magnitude
/// \param isSound says whether VTK's cell may be asked; other cells are left out
CheckedBlocks averagedAtNodes(CheckedBlocks checked, int component, const CellTest& isSound);

} // namespace hop
