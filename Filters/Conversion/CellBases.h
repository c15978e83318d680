#pragma once

#include "Elements/JacobianTest.h"
#include "Elements/NodalBasis.h"
#include "Elements/Space.h"

#include "vtkType.h"

#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

class vtkCell;
class vtkUnstructuredGrid;

namespace hop
{

/// How the cells of one kind are rewritten as elements.
struct CellBasis
{
  CellBasis(NodalBasis nodal, bool isBezier)
    : basis(std::move(nodal))
    , jacobian(basis.domain(), basis.degrees())
    , bezier(isBezier)
  {
  }

  NodalBasis basis;
  JacobianTest jacobian;
  /// Bezier: nodal values are Bernstein coefficients, and the grid's RationalWeights apply.
  bool bezier = false;
};

/// What tells the kinds of cells apart: cell type, number of points, and degrees, zeros if those follow from
/// the number of points.
using CellKind = std::tuple<int, vtkIdType, Degrees>;

/// The bases of grids' cells: one a kind, shared by all cells of it. VTK stays the one authority on its
/// cells: the order of the nodes of Lagrange and Bezier cells comes from their parametric coordinates, and
/// the shape functions of all other cells are sampled from VTK's own InterpolateFunctions.
///
/// Pyramids live on the hexahedron's domain, as in VTK's parametric coordinates, where their shape
/// functions are polynomial: its upper face collapses to the apex.
class CellBases
{
public:
  explicit CellBases(NodeSpacing spacing);

  /// The basis of cells of a kind, or nullptr: the type is not supported, or the number of points does not
  /// fit the degrees. For several threads.
  const CellBasis* basisOf(const CellKind& kind);

private:
  std::unique_ptr<const CellBasis> makeBasis(const CellKind& kind) const;
  std::unique_ptr<const CellBasis> makeLatticeBasis(
    vtkCell* vtk, Domain domain, const Degrees& degrees) const;

  NodeSpacing Spacing;
  std::mutex Mutex;
  std::map<CellKind, std::unique_ptr<const CellBasis>> Known;
};

/// Looks up the bases of one cell after the other. One a thread.
class BasisLookup
{
public:
  explicit BasisLookup(CellBases& bases);
  BasisLookup(const BasisLookup&) = delete;
  BasisLookup& operator=(const BasisLookup&) = delete;

  /// The basis of a cell, or nullptr.
  const CellBasis* basisOf(vtkUnstructuredGrid* grid, vtkIdType cell);

private:
  CellBases& Bases;
  std::map<CellKind, const CellBasis*> Known;
  std::map<CellKind, const CellBasis*>::iterator Latest;
};

/// VTK's parametric coordinates of a cell of that type at a reference point. They are the reference
/// coordinates themselves except for the 19-node pyramid, whose own are those of a true pyramid.
ReferencePoint parametricCoordinates(int cellType, const ReferencePoint& u);

} // namespace hop
