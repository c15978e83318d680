#pragma once

#include "Input/InputBlocks.h"

class vtkDataObject;

namespace hop
{

/// The grids of an input, each with a name and a place for its particles, but without scalars.
struct GatheredBlocks
{
  std::vector<InputBlock> blocks;
  /// Names of the leaves of a composite that are no unstructured grids.
  std::vector<std::string> others;
};

/// \param input a vtkUnstructuredGrid, or a composite of data sets
/// \param kind of the outputs of grids: VTK_POLY_DATA or VTK_UNSTRUCTURED_GRID
/// \param output of that kind, or a composite of the input's kind, which receives the input's structure, its names and,
/// in the place of every grid, an empty output
GatheredBlocks gatherBlocks(vtkDataObject* input, int kind, vtkDataObject* output);

} // namespace hop
