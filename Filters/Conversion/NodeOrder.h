#pragma once

#include "Common/Monitor.h"
#include "Conversion/CellBases.h"
#include "Input/InputBlocks.h"

#include <algorithm>
#include <string>
#include <vector>

namespace hop
{

/// Folded cells of one kind that are left out, as the file seems to have its nodes in another order than VTK's: that of
/// another program.
struct MisorderedCells
{
  /// One ascending list a block. All cells of the kind are looked at, with or without surface, but for ghost cells.
  std::vector<std::vector<vtkIdType>> cells;
  /// What makes them sound: "nodes 8 and 9 exchanged", "their nodes in the order 0 1 3 2"; empty where it is not known.
  std::string remedy;

  bool isEmpty() const
  {
    return std::all_of(
      this->cells.begin(), this->cells.end(), [](const auto& some) { return some.empty(); });
  }
};

/// Finds the cells of one kind whose nodes are in another order than VTK's. Three orders of a cell are tried, and the
/// orders of a few other cells: that in which each node stands nearest to its place in the straight-sided cell with the
/// same corners, and two lexicographic orders. If most folded cells become sound, these cells are found; if they do
/// not, but most cells of the kind are folded, all folded ones. Else there are none: a few bad cells are the mesh's own.
/// \param folded some cells of the kind, at least one
/// \param areMost whether these are most of the cells at the surface
/// \param kinds have the basis `cell`
MisorderedCells findMisordered(const InputBlocks& blocks, const std::vector<BlockCell>& folded,
  bool areMost, const CellBasis& cell, CellBases& kinds, const ParallelFor& parallelFor);

} // namespace hop
