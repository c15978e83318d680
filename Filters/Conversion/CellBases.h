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
#include <vector>

class vtkCell;
class vtkUnstructuredGrid;

namespace hop
{

/// How the cells of one kind are rewritten as elements.
struct CellBasis
{
  CellBasis(NodalBasis nodal, bool isBezier, std::vector<ReferencePoint> places)
    : basis(std::move(nodal))
    , jacobian(basis.domain(), basis.degrees())
    , bezier(isBezier)
    , nodes(std::move(places))
  {
  }

  NodalBasis basis;
  JacobianTest jacobian;
  /// Whether nodal values are Bernstein coefficients, and the grid's RationalWeights apply.
  bool bezier = false;
  /// Where VTK has the nodes, in the mesh's order; empty where VTK's parametric coordinates are not the element's.
  std::vector<ReferencePoint> nodes;
};

/// A kind of cells: VTK cell type, number of points, and degrees; zeros where the degrees follow from the number of
/// points.
using CellKind = std::tuple<int, vtkIdType, Degrees>;

/// The bases of grids' cells; all cells of a kind share one basis. VTK stays the only authority on its cells: the order
/// of the nodes of Lagrange and Bezier cells comes from their parametric coordinates, and the shape functions of all
/// other cells are sampled from VTK's own InterpolateFunctions.
///
/// Pyramids live on the hexahedron's domain, as in VTK's parametric coordinates: its upper face collapses to the apex.
/// There their shape functions are polynomial.
class CellBases
{
public:
  explicit CellBases(NodeSpacing spacing);

  /// The basis of the cells of a kind; nullptr if the type is not supported, or the number of points does not fit the
  /// degrees. Several threads may call it at once.
  const CellBasis* basisOf(const CellKind& kind);

private:
  std::unique_ptr<const CellBasis> makeBasis(const CellKind& kind) const;
  std::unique_ptr<const CellBasis> makeLatticeBasis(
    vtkCell* vtk, Domain domain, const Degrees& degrees) const;

  NodeSpacing Spacing;
  std::mutex Mutex;
  std::map<CellKind, std::unique_ptr<const CellBasis>> Known;
};

/// Looks up the bases of one cell after the other. Each thread has a BasisLookup of its own.
class BasisLookup
{
public:
  explicit BasisLookup(CellBases& bases);
  BasisLookup(const BasisLookup&) = delete;
  BasisLookup& operator=(const BasisLookup&) = delete;

  /// The basis of a cell, or nullptr, see CellBases.
  const CellBasis* basisOf(vtkUnstructuredGrid* grid, vtkIdType cell);

private:
  CellBases& Bases;
  std::map<CellKind, const CellBasis*> Known;
  std::map<CellKind, const CellBasis*>::iterator Latest;
};

/// VTK's parametric coordinates, in a cell of a type, of a reference point. They are the reference coordinates
/// themselves except in the 19-node pyramid, whose parametric coordinates describe a true pyramid.
ReferencePoint parametricCoordinates(int cellType, const ReferencePoint& u);

} // namespace hop
