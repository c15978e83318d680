#pragma once

#include "NodalBasis.h"

#include "vtkType.h"

#include <map>
#include <memory>
#include <tuple>

class vtkDataArray;
class vtkUnstructuredGrid;

/// The nodal bases of a grid's cells: one a combination of cell type and degrees, shared by all
/// cells of that kind. The order of the nodes is asked from VTK's own cells, through their
/// parametric coordinates, so that VTK stays the one authority on it.
class CellBases
{
public:
  explicit CellBases(vtkUnstructuredGrid* grid);

  /// The basis of a cell, or nullptr: its type is not supported, or its number of points does not
  /// fit its degrees. Not for several threads at once.
  std::shared_ptr<const hop::NodalBasis> basisOf(vtkIdType cell);

private:
  using Key = std::tuple<int, vtkIdType, hop::Degrees>;

  hop::Degrees explicitDegrees(vtkIdType cell) const;
  static std::shared_ptr<const hop::NodalBasis> makeBasis(const Key& key);

  vtkUnstructuredGrid* Grid;
  vtkDataArray* HigherOrderDegrees;
  std::map<Key, std::shared_ptr<const hop::NodalBasis>> Known;
};
