#include "CellBases.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace
{

constexpr hop::Degrees degreesFromCount{ 0, 0, 0 };

bool isLagrange(int cellType)
{
  return cellType == VTK_LAGRANGE_HEXAHEDRON || cellType == VTK_LAGRANGE_TETRAHEDRON ||
    cellType == VTK_LAGRANGE_WEDGE;
}

/// Cell types whose nodes fill a Lagrange lattice, by the domain on which they live.
std::optional<hop::Domain> domainOf(int cellType)
{
  switch (cellType)
  {
    case VTK_HEXAHEDRON:
    case VTK_VOXEL:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
    case VTK_LAGRANGE_HEXAHEDRON:
      return hop::Domain::Hexahedron;
    case VTK_TETRA:
    case VTK_QUADRATIC_TETRA:
    case VTK_LAGRANGE_TETRAHEDRON:
      return hop::Domain::Tetrahedron;
    case VTK_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
    case VTK_LAGRANGE_WEDGE:
      return hop::Domain::Wedge;
    default:
      return {};
  }
}

/// The degree at which the domain has that many nodes, or the given degrees if they have.
std::optional<hop::Degrees> fittingDegrees(
  hop::Domain domain, const hop::Degrees& given, vtkIdType nodes)
{
  if (given != degreesFromCount)
  {
    const bool inRange = std::min({ given[0], given[1], given[2] }) >= 1 &&
      std::max({ given[0], given[1], given[2] }) <= hop::MaximumDegree;
    return inRange && hop::coefficientCount(domain, given) == nodes
      ? std::optional<hop::Degrees>(given)
      : std::nullopt;
  }
  for (int p = 1; p <= hop::MaximumDegree; ++p)
  {
    if (hop::coefficientCount(domain, { p, p, p }) == nodes)
    {
      return hop::Degrees{ p, p, p };
    }
  }
  return {};
}

/// A cell of that kind, alone and with all points at the origin. The order of its nodes can be asked
/// from it whatever is wrong with the cells of the input.
vtkSmartPointer<vtkUnstructuredGrid> gridOfOneCell(
  int cellType, vtkIdType nodes, const hop::Degrees& degrees)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(nodes);
  points->GetData()->Fill(0.0);
  grid->SetPoints(points);
  std::vector<vtkIdType> ids(nodes);
  std::iota(ids.begin(), ids.end(), 0);
  grid->InsertNextCell(cellType, nodes, ids.data());
  if (isLagrange(cellType))
  {
    vtkNew<vtkDoubleArray> array;
    array->SetNumberOfComponents(3);
    array->InsertNextTuple3(degrees[0], degrees[1], degrees[2]);
    grid->GetCellData()->SetHigherOrderDegrees(array);
  }
  return grid;
}

} // namespace

CellBases::CellBases(vtkUnstructuredGrid* grid)
  : Grid(grid)
  , HigherOrderDegrees(grid->GetCellData()->GetHigherOrderDegrees())
{
}

/// The degrees that the file gives for this cell; zeros if it leaves them to the number of points.
hop::Degrees CellBases::explicitDegrees(vtkIdType cell) const
{
  if (!this->HigherOrderDegrees || this->HigherOrderDegrees->GetNumberOfComponents() != 3 ||
    !isLagrange(this->Grid->GetCellType(cell)))
  {
    return degreesFromCount;
  }
  double tuple[3];
  this->HigherOrderDegrees->GetTuple(cell, tuple);
  return { static_cast<int>(tuple[0]), static_cast<int>(tuple[1]), static_cast<int>(tuple[2]) };
}

std::shared_ptr<const hop::NodalBasis> CellBases::basisOf(vtkIdType cell)
{
  const Key key{ this->Grid->GetCellType(cell), this->Grid->GetCellSize(cell),
    this->explicitDegrees(cell) };
  auto [entry, isNew] = this->Known.try_emplace(key);
  if (isNew)
  {
    entry->second = makeBasis(key);
  }
  return entry->second;
}

std::shared_ptr<const hop::NodalBasis> CellBases::makeBasis(const Key& key)
{
  const auto& [type, nodes, given] = key;
  const std::optional<hop::Domain> domain = domainOf(type);
  if (!domain)
  {
    return nullptr;
  }
  const std::optional<hop::Degrees> degrees = fittingDegrees(*domain, given, nodes);
  if (!degrees)
  {
    return nullptr;
  }
  vtkNew<vtkGenericCell> vtk;
  gridOfOneCell(type, nodes, *degrees)->GetCell(0, vtk);
  const double* parametric = vtk->GetParametricCoords();
  std::vector<hop::LatticePoint> order;
  for (vtkIdType node = 0; parametric && node < nodes; ++node)
  {
    const auto onLattice = [&](int axis)
    { return static_cast<int>(std::lround(parametric[3 * node + axis] * (*degrees)[axis])); };
    order.push_back({ onLattice(0), onLattice(1), onLattice(2) });
  }
  try
  {
    return std::make_shared<const hop::NodalBasis>(*domain, *degrees, order);
  }
  catch (const std::invalid_argument&)
  {
    return nullptr; // nodes that do not fill the lattice: no Lagrange cell after all
  }
}
