#include "Conversion/CellBases.h"

#include "Elements/Bernstein.h"
#include "Support/Random.h"

#include "vtkCellArray.h"
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

namespace hop
{

namespace
{

/// Stands for degrees that follow from the number of points.
constexpr Degrees degreesFromCount{ 0, 0, 0 };

bool isBezier(int cellType)
{
  return cellType == VTK_BEZIER_HEXAHEDRON || cellType == VTK_BEZIER_TETRAHEDRON ||
    cellType == VTK_BEZIER_WEDGE;
}

bool isLagrange(int cellType)
{
  return cellType == VTK_LAGRANGE_HEXAHEDRON || cellType == VTK_LAGRANGE_TETRAHEDRON ||
    cellType == VTK_LAGRANGE_WEDGE;
}

/// The domain on which cells of a type are polynomial; none for types that are not supported.
std::optional<Domain> domainOf(int cellType)
{
  switch (cellType)
  {
    case VTK_HEXAHEDRON:
    case VTK_VOXEL:
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_HEXAHEDRON:
    case VTK_PYRAMID:
    case VTK_QUADRATIC_PYRAMID:
    case VTK_TRIQUADRATIC_PYRAMID:
      return Domain::Hexahedron;
    case VTK_TETRA:
    case VTK_QUADRATIC_TETRA:
    case VTK_LAGRANGE_TETRAHEDRON:
    case VTK_BEZIER_TETRAHEDRON:
      return Domain::Tetrahedron;
    case VTK_WEDGE:
    case VTK_QUADRATIC_WEDGE:
    case VTK_QUADRATIC_LINEAR_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
    case VTK_LAGRANGE_WEDGE:
    case VTK_BEZIER_WEDGE:
      return Domain::Wedge;
    default:
      return {};
  }
}

/// Whether a Lagrange cell has more nodes than its lattice: VTK's tetrahedron of 15 and wedge of 21 nodes have nodes in
/// the middles of faces and of the cell.
bool isEnriched(int cellType, vtkIdType points)
{
  return (cellType == VTK_LAGRANGE_TETRAHEDRON && points == 15) ||
    (cellType == VTK_LAGRANGE_WEDGE && points == 21);
}

/// The degrees that the grid gives for a cell, -1 for a degree out of range; zeros if they follow from the number of
/// points.
Degrees explicitDegrees(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  const int type = grid->GetCellType(cell);
  vtkDataArray* given =
    isLagrange(type) || isBezier(type) ? grid->GetCellData()->GetHigherOrderDegrees() : nullptr;
  if (!given || given->GetNumberOfComponents() != 3)
  {
    return degreesFromCount;
  }
  double tuple[3];
  given->GetTuple(cell, tuple);
  const auto degree = [](double value)
  { return value >= 0.0 && value <= MaximumInputDegree ? static_cast<int>(value) : -1; };
  return { degree(tuple[0]), degree(tuple[1]), degree(tuple[2]) };
}

/// The degrees with which a cell on the domain has that many nodes: the given degrees if there are any, else equal
/// ones. None if there are no such degrees.
std::optional<Degrees> fittingDegrees(Domain domain, const Degrees& given, vtkIdType nodes)
{
  if (given != degreesFromCount)
  {
    const auto [lowest, highest] = std::minmax_element(given.begin(), given.end());
    return *lowest >= 1 && *highest <= maximumInputDegree(domain) &&
        coefficientCount(domain, given) == nodes
      ? std::optional<Degrees>(given)
      : std::nullopt;
  }
  for (int p = 1; p <= maximumInputDegree(domain); ++p)
  {
    if (coefficientCount(domain, { p, p, p }) == nodes)
    {
      return Degrees{ p, p, p };
    }
  }
  return {};
}

/// The number of points of cells of a type that always has the same number.
/// \pre VTK has a class for the type; it has one for all types with a domain
vtkIdType usualPointCount(int cellType)
{
  return vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(cellType))->GetNumberOfPoints();
}

/// A grid with one cell of a kind and with all points at the origin. VTK can be asked about the cell's nodes, whatever
/// is wrong with the cells of the input.
/// \param degrees for cells whose nodes fill their lattice
vtkSmartPointer<vtkUnstructuredGrid> gridOfOneCell(
  int cellType, vtkIdType nodes, const std::optional<Degrees>& degrees)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(nodes);
  points->GetData()->Fill(0.0);
  grid->SetPoints(points);
  std::vector<vtkIdType> ids(nodes);
  std::iota(ids.begin(), ids.end(), 0);
  grid->InsertNextCell(cellType, nodes, ids.data());
  if (degrees)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetNumberOfComponents(3);
    array->InsertNextTuple3((*degrees)[0], (*degrees)[1], (*degrees)[2]);
    grid->GetCellData()->SetHigherOrderDegrees(array);
  }
  return grid;
}

/// The values of VTK's shape functions, one a node.
std::vector<double> shapeFunctions(vtkCell* cell, const ReferencePoint& u)
{
  // VTK's cells write as many values as they have points; some write more. The reserve is ample.
  constexpr int reserve = 32;
  std::vector<double> weights(cell->GetNumberOfPoints() + reserve);
  const ReferencePoint parametric = parametricCoordinates(cell->GetCellType(), u);
  cell->InterpolateFunctions(&parametric.xyz.x, weights.data());
  weights.resize(cell->GetNumberOfPoints());
  return weights;
}

/// Where VTK has the nodes of a cell; see CellBasis::nodes.
std::vector<ReferencePoint> placesOfNodes(vtkCell* cell)
{
  const double* parametric = cell->GetParametricCoords();
  std::vector<ReferencePoint> places;
  for (vtkIdType n = 0; parametric && n < cell->GetNumberOfPoints(); ++n, parametric += 3)
  {
    places.push_back({ { parametric[0], parametric[1], parametric[2] } });
  }
  return cell->GetCellType() == VTK_TRIQUADRATIC_PYRAMID ? std::vector<ReferencePoint>() : places;
}

/// Whether a basis gives back VTK's shape functions away from the points where it was sampled.
bool reproduces(vtkCell* cell, const NodalBasis& basis)
{
  // Number of random points: polynomials that differ do not agree at all of them.
  constexpr int trials = 20;
  // Largest difference of shape functions, whose values are about 1: far above rounding errors, far below the
  // difference of polynomials of different degrees. Chosen by experiment.
  constexpr double tolerance = 1e-9;
  const int nodes = basis.nodeCount();
  std::vector<double> unit(static_cast<std::size_t>(nodes) * nodes, 0.0);
  for (int node = 0; node < nodes; ++node)
  {
    unit[node * nodes + node] = 1.0;
  }
  std::vector<double> coefficients(static_cast<std::size_t>(basis.coefficientCount()) * nodes);
  basis.toBernstein(unit.data(), nodes, coefficients.data());
  std::vector<double> bernstein(basis.coefficientCount());
  Random random(1);
  for (int trial = 0; trial < trials; ++trial)
  {
    // Coordinates up to 1/3 are in every domain, simplices included.
    const ReferencePoint u{ glm::dvec3(
      random.uniform() / 3.0, random.uniform() / 3.0, random.uniform() / 3.0) };
    evaluateBasis(basis.domain(), basis.degrees(), u, bernstein.data());
    const std::vector<double> expected = shapeFunctions(cell, u);
    for (int node = 0; node < nodes; ++node)
    {
      double value = 0.0;
      for (int i = 0; i < basis.coefficientCount(); ++i)
      {
        value += bernstein[i] * coefficients[i * nodes + node];
      }
      if (!(std::abs(value - expected[node]) < tolerance))
      {
        return false;
      }
    }
  }
  return true;
}

/// VTK's own shape functions in the first of some Bernstein bases that holds them.
std::unique_ptr<const CellBasis> sampleBasis(vtkCell* cell, Domain domain)
{
  // Degree 4 is that of the bubble in the middle of the tetrahedron of 15 nodes.
  constexpr Degrees candidates[] = { { 1, 1, 1 }, { 2, 2, 1 }, { 2, 2, 2 }, { 3, 3, 3 },
    { 4, 4, 4 } };
  for (const Degrees& degrees : candidates)
  {
    if (domain == Domain::Tetrahedron && degrees[0] != degrees[2])
    {
      continue;
    }
    std::vector<double> samples;
    for (const LatticePoint& point : latticePoints(domain, degrees))
    {
      const std::vector<double> values = shapeFunctions(cell, latticePosition(degrees, point));
      samples.insert(samples.end(), values.begin(), values.end());
    }
    const NodalBasis basis = NodalBasis::sampled(domain, degrees, samples);
    if (reproduces(cell, basis))
    {
      return std::make_unique<const CellBasis>(CellBasis(basis, false, placesOfNodes(cell)));
    }
  }
  return nullptr;
}

} // namespace

CellBases::CellBases(NodeSpacing spacing)
  : Spacing(spacing)
{
}

const CellBasis* CellBases::basisOf(const CellKind& kind)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto [known, isNew] = this->Known.try_emplace(kind);
  if (isNew)
  {
    known->second = this->makeBasis(kind);
  }
  return known->second.get();
}

std::unique_ptr<const CellBasis> CellBases::makeBasis(const CellKind& kind) const
{
  const auto& [type, points, given] = kind;
  const std::optional<Domain> domain = domainOf(type);
  // VTK can make no cell of some types without a domain.
  if (!domain)
  {
    return nullptr;
  }
  const bool onLattice = (isLagrange(type) || isBezier(type)) && !isEnriched(type, points);
  std::optional<Degrees> degrees;
  if (onLattice)
  {
    degrees = fittingDegrees(*domain, given, points);
  }
  // VTK's cells crash with a wrong number of points.
  const bool fits =
    onLattice ? degrees.has_value() : isEnriched(type, points) || points == usualPointCount(type);
  if (!fits)
  {
    return nullptr;
  }
  vtkNew<vtkGenericCell> vtk;
  gridOfOneCell(type, points, degrees)->GetCell(0, vtk);
  try
  {
    return onLattice ? this->makeLatticeBasis(vtk, *domain, *degrees) : sampleBasis(vtk, *domain);
  }
  catch (const std::invalid_argument&)
  {
    return nullptr;
  }
}

std::unique_ptr<const CellBasis> CellBases::makeLatticeBasis(
  vtkCell* vtk, Domain domain, const Degrees& degrees) const
{
  const double* parametric = vtk->GetParametricCoords();
  std::vector<LatticePoint> order;
  for (vtkIdType node = 0; parametric && node < vtk->GetNumberOfPoints(); ++node)
  {
    const auto onLattice = [&](int axis)
    { return static_cast<int>(std::lround(parametric[3 * node + axis] * degrees[axis])); };
    order.push_back({ onLattice(0), onLattice(1), onLattice(2) });
  }
  const bool bezier = isBezier(vtk->GetCellType());
  return std::make_unique<const CellBasis>(bezier
      ? NodalBasis::bezier(domain, degrees, order)
      : NodalBasis::lagrange(domain, degrees, order, this->Spacing),
    bezier, placesOfNodes(vtk));
}

BasisLookup::BasisLookup(CellBases& bases)
  : Bases(bases)
  , Latest(Known.end())
{
}

const CellBasis* BasisLookup::basisOf(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  const CellKind kind{ grid->GetCellType(cell), grid->GetCells()->GetCellSize(cell),
    explicitDegrees(grid, cell) };
  // Consecutive cells are mostly of the same kind.
  if (this->Latest == this->Known.end() || this->Latest->first != kind)
  {
    bool isNew = false;
    std::tie(this->Latest, isNew) = this->Known.try_emplace(kind);
    if (isNew)
    {
      this->Latest->second = this->Bases.basisOf(kind);
    }
  }
  return this->Latest->second;
}

ReferencePoint parametricCoordinates(int cellType, const ReferencePoint& u)
{
  if (cellType != VTK_TRIQUADRATIC_PYRAMID)
  {
    return u;
  }
  // The base stands at height 1/2, the apex above its middle at height 1.
  const glm::dvec2 shrunk = (1.0 - u.xyz.z) * glm::dvec2(u.xyz) + u.xyz.z * glm::dvec2(0.5, 0.5);
  return { { shrunk.x, shrunk.y, 0.5 + 0.5 * u.xyz.z } };
}

} // namespace hop
