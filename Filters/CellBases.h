#pragma once

#include "JacobianTest.h"
#include "NodalBasis.h"
#include "Space.h"

#include "vtkType.h"

#include <map>
#include <memory>
#include <tuple>
#include <utility>

class vtkCell;
class vtkUnstructuredGrid;

/// How the cells of one kind are rewritten as elements.
struct CellBasis
{
  CellBasis(hop::NodalBasis nodal, bool isBezier)
    : basis(std::move(nodal))
    , jacobian(basis.domain(), basis.degrees())
    , bezier(isBezier)
  {
  }

  hop::NodalBasis basis;
  hop::JacobianTest jacobian;
  /// Bezier: nodal values are Bernstein coefficients, and the grid's RationalWeights apply.
  bool bezier = false;
};

/// The bases of grids' cells: one a combination of cell type, number of points and degrees, shared
/// by all cells of that kind. VTK stays the one authority on its cells: the order of the nodes of
/// Lagrange and Bezier cells comes from their parametric coordinates, and the shape functions of all
/// other cells are sampled from VTK's own InterpolateFunctions.
///
/// Pyramids live on the hexahedron's domain, as in VTK's parametric coordinates, where their shape
/// functions are polynomial: its upper face collapses to the apex.
class CellBases
{
public:
  explicit CellBases(hop::NodeSpacing spacing);
  CellBases(const CellBases&) = delete;
  CellBases& operator=(const CellBases&) = delete;

  /// The basis of a cell, or nullptr: its type is not supported, or its number of points does not
  /// fit its degrees. Not for several threads at once.
  std::shared_ptr<const CellBasis> basisOf(vtkUnstructuredGrid* grid, vtkIdType cell);

private:
  using Key = std::tuple<int, vtkIdType, hop::Degrees>;

  std::shared_ptr<const CellBasis> makeBasis(const Key& key) const;
  std::shared_ptr<const CellBasis> makeLatticeBasis(
    vtkCell* vtk, hop::Domain domain, const hop::Degrees& degrees) const;

  hop::NodeSpacing Spacing;
  std::map<Key, std::shared_ptr<const CellBasis>> Known;
  std::map<Key, std::shared_ptr<const CellBasis>>::iterator Latest;
};

/// VTK's parametric coordinates of a cell of that type at a reference point. They are the reference
/// coordinates themselves except for the 19-node pyramid, whose own are those of a true pyramid.
hop::ReferencePoint parametricCoordinates(int cellType, const hop::ReferencePoint& u);
