#pragma once

#include "Input/InputChecks.h"

#include <string>

namespace hop
{

/// The blocks with the arrays that a formula names: their scalars are the components of all of these, side by side.
CheckedBlocks checkExpression(const GatheredBlocks& gathered, const std::string& text);

/// The blocks with a quantity at their nodes as scalars: made of the means of the gradients, by VTK's cells, in all cells
/// around a node, also where several points stand in its place. Blocks that nothing is derived of stay as they are.
/// \param component of the scalars, or InputBlocks::Magnitude
CheckedBlocks averagedAtNodes(CheckedBlocks checked, int component);

} // namespace hop
