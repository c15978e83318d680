#pragma once

#include "Common/Monitor.h"
#include "Conversion/CellBases.h"
#include "Input/InputBlocks.h"

#include <algorithm>
#include <string>
#include <vector>

namespace hop
{

/// Cells of one kind that are left out, as the file seems to have its nodes in another order than VTK's: that of
/// another program.
struct MisorderedCells
{
  /// One ascending list a block. All cells of the kind are looked at, with or without surface, but for ghost cells.
  std::vector<std::vector<vtkIdType>> cells;
  /// What mends them: "nodes 8 and 9 exchanged", "their nodes in the order 0 1 3 2"; empty where it is not known.
  std::string remedy;
  /// Whether they are partly inverted; else they are bent.
  bool areFolded = true;

  /// For a message: "partly inverted, but sound with nodes 8 and 9 exchanged".
  std::string describe() const;
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

/// Finds the cells of one kind that a wrong order bends without folding them: tetrahedra of degree 2 with the nodes of
/// two opposite edges exchanged, for instance, whose Jacobian determinant is constant. Each of their nodes is the
/// nearest to the place of another in the straight-sided cell with the same corners, and much nearer than the node that
/// has the place. If most of the given cells are such, all are found; else there are none.
/// \param sound the cells of the kind at the surface that are not folded
/// \param kinds have the basis `cell`
MisorderedCells findDisplaced(const InputBlocks& blocks, const std::vector<BlockCell>& sound,
  const CellBasis& cell, CellBases& kinds, const ParallelFor& parallelFor);

} // namespace hop
