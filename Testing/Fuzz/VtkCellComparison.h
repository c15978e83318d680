#pragma once

#include <string>
#include <vector>

class vtkPointSet;
class vtkUnstructuredGrid;

namespace hop::testing
{

class FilterSession;

/// Compares some points of an output with VTK's own cells, and adds what is wrong: a point that is not where its
/// parametric coordinates are, a value that is not the isovalue to the tolerance. Cells that VTK evaluates otherwise are
/// left out: voxels that are bent, rational Bezier cells, nodes at Gauss-Lobatto-Legendre points, cells whose type or
/// nodes the recipe has made wrong; values, also where derivatives are contoured.
void compareWithVtk(const FilterSession& session, vtkUnstructuredGrid& grid, vtkPointSet& output,
  std::vector<std::string>& found);

} // namespace hop::testing
