#pragma once

#include "Input/InputBlocks.h"

class vtkDataObject;

namespace hop
{

/// The grids of an input, with a name and a place for their particles each, but without scalars.
struct GatheredBlocks
{
  std::vector<InputBlock> blocks;
  /// Names of leaves of a composite that are something else.
  std::vector<std::string> others;
};

/// \param input a vtkUnstructuredGrid, or a composite of data sets
/// \param output vtkPolyData, or a composite of the input's kind, which gets the input's structure with
/// names and, in the place of every grid, empty vtkPolyData
GatheredBlocks gatherBlocks(vtkDataObject* input, vtkDataObject* output);

} // namespace hop
