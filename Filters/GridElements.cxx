#include "GridElements.h"

#include "SurfaceGeometry.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellTypes.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStaticPointLocator.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace
{

enum class Verdict : char
{
  Keep,
  Drop,
  BrokenConnectivity,
  NotFinite,
  Unsupported,
  Hidden
};

class Builder
{
public:
  Builder(vtkUnstructuredGrid* grid, vtkDataArray* scalars, const std::vector<double>& isovalues,
    const hop::ParallelFor& parallelFor)
    : Grid(grid)
    , Scalars(scalars)
    , Isovalues(isovalues)
    , Parallel(parallelFor)
  {
  }

  GridElements build();

private:
  void judgeCells();
  Verdict judge(vtkIdList* ids, std::vector<double>& values) const;
  void count(const std::vector<Verdict>& verdicts);
  void convertElements();
  void convert(int element, vtkIdList* ids);
  void numberCorners();
  void dropCollapsed();
  bool canHoldSurface(const hop::NodalBasis& basis, const std::vector<double>& values) const;

  vtkUnstructuredGrid* Grid;
  vtkDataArray* Scalars;
  const std::vector<double>& Isovalues;
  const hop::ParallelFor& Parallel;
  GridElements Result;
  std::vector<hop::JacobianSign> Signs;
  double Tolerance = 0.0;
};

GridElements Builder::build()
{
  this->judgeCells();
  this->convertElements();
  this->dropCollapsed();
  this->numberCorners();
  hop::findFaceNeighbors(this->Result.mesh, this->Tolerance);
  return std::move(this->Result);
}

/// Sorts out which cells become elements. Only values are read here, not coordinates.
void Builder::judgeCells()
{
  const vtkIdType cells = this->Grid->GetNumberOfCells();
  CellBases known(this->Grid);
  std::vector<std::shared_ptr<const hop::NodalBasis>> bases(cells);
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    bases[cell] = known.basisOf(cell);
  }
  std::vector<Verdict> verdicts(cells, Verdict::Unsupported);
  vtkUnsignedCharArray* ghosts = this->Grid->GetCellGhostArray();
  hop::runParallel(this->Parallel, cells,
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      vtkNew<vtkIdList> ids;
      std::vector<double> values;
      for (std::ptrdiff_t cell = begin; cell < end; ++cell)
      {
        if (ghosts && (ghosts->GetValue(cell) & vtkDataSetAttributes::HIDDENCELL))
        {
          verdicts[cell] = Verdict::Hidden;
        }
        else if (bases[cell])
        {
          this->Grid->GetCells()->GetCellAtId(cell, ids);
          values.resize(ids->GetNumberOfIds());
          verdicts[cell] = this->judge(ids, values);
          if (verdicts[cell] == Verdict::Keep && !this->canHoldSurface(*bases[cell], values))
          {
            verdicts[cell] = Verdict::Drop;
          }
        }
      }
    });
  this->count(verdicts);
  std::size_t coefficients = 0;
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    if (verdicts[cell] == Verdict::Keep)
    {
      hop::Element element;
      element.domain = bases[cell]->domain();
      element.degrees = bases[cell]->degrees();
      element.firstCoefficient = coefficients;
      element.cell = cell;
      coefficients += bases[cell]->nodeCount();
      this->Result.mesh.elements.push_back(element);
      this->Result.bases.push_back(bases[cell]);
    }
  }
  this->Result.mesh.coefficients.resize(coefficients);
}

Verdict Builder::judge(vtkIdList* ids, std::vector<double>& values) const
{
  const vtkIdType points = this->Grid->GetNumberOfPoints();
  for (vtkIdType node = 0; node < ids->GetNumberOfIds(); ++node)
  {
    const vtkIdType id = ids->GetId(node);
    if (id < 0 || id >= points)
    {
      return Verdict::BrokenConnectivity;
    }
    values[node] = this->Scalars->GetComponent(id, 0);
    if (!std::isfinite(values[node]))
    {
      return Verdict::NotFinite;
    }
  }
  return Verdict::Keep;
}

/// Nodal values on both sides of an isovalue decide at once; else the convex hull of the Bernstein
/// coefficients does, widened by the rounding errors of the conversion.
bool Builder::canHoldSurface(
  const hop::NodalBasis& basis, const std::vector<double>& values) const
{
  const auto straddles = [this](double lower, double upper)
  {
    return std::any_of(this->Isovalues.begin(), this->Isovalues.end(),
      [&](double c) { return lower <= c && c <= upper; });
  };
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  if (straddles(*lowest, *highest))
  {
    return true;
  }
  std::vector<double> coefficients(values.size());
  basis.toBernstein(values.data(), 1, coefficients.data());
  const auto [lower, upper] = std::minmax_element(coefficients.begin(), coefficients.end());
  const double slack = 8.0 * std::numeric_limits<double>::epsilon() * basis.conversionNorm() *
    std::max(std::abs(*lowest), std::abs(*highest));
  return straddles(*lower - slack, *upper + slack);
}

void Builder::count(const std::vector<Verdict>& verdicts)
{
  CellCensus& census = this->Result.census;
  for (vtkIdType cell = 0; cell < static_cast<vtkIdType>(verdicts.size()); ++cell)
  {
    switch (verdicts[cell])
    {
      case Verdict::Drop:
        ++census.dropped;
        break;
      case Verdict::Unsupported:
        census.unsupported[this->Grid->GetCellType(cell)].add(cell);
        break;
      case Verdict::BrokenConnectivity:
        census.brokenConnectivity.add(cell);
        break;
      case Verdict::NotFinite:
        census.notFinite.add(cell);
        break;
      default:
        break;
    }
  }
}

void Builder::convertElements()
{
  const hop::ElementMesh& mesh = this->Result.mesh;
  this->Signs.resize(mesh.elements.size());
  hop::runParallel(this->Parallel, static_cast<std::ptrdiff_t>(mesh.elements.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      vtkNew<vtkIdList> ids;
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        this->convert(static_cast<int>(e), ids);
        this->Signs[e] = hop::jacobianSign(mesh.form(static_cast<int>(e)));
      }
    });
}

void Builder::convert(int element, vtkIdList* ids)
{
  const hop::Element& e = this->Result.mesh.elements[element];
  this->Grid->GetCells()->GetCellAtId(e.cell, ids);
  std::vector<hop::Coefficient> nodal(ids->GetNumberOfIds());
  for (vtkIdType node = 0; node < ids->GetNumberOfIds(); ++node)
  {
    this->Grid->GetPoints()->GetPoint(ids->GetId(node), &nodal[node].x);
    nodal[node].w = this->Scalars->GetComponent(ids->GetId(node), 0);
  }
  this->Result.bases[element]->toBernstein(
    &nodal[0].x, 4, &this->Result.mesh.coefficients[e.firstCoefficient].x);
}

/// Takes out elements without volume and those whose coordinates are not finite.
void Builder::dropCollapsed()
{
  hop::ElementMesh& mesh = this->Result.mesh;
  CellCensus& census = this->Result.census;
  std::size_t kept = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    const vtkIdType cell = mesh.elements[e].cell;
    const hop::JacobianSign sign = this->Signs[e];
    if (sign == hop::JacobianSign::NotFinite)
    {
      census.notFinite.add(cell);
      continue;
    }
    if (sign == hop::JacobianSign::Zero)
    {
      census.collapsed.add(cell);
      continue;
    }
    if (sign == hop::JacobianSign::Mixed)
    {
      census.folded.add(cell);
    }
    mesh.elements[kept] = mesh.elements[e];
    this->Result.bases[kept++] = this->Result.bases[e];
  }
  mesh.elements.resize(kept);
  this->Result.bases.resize(kept);
}

/// Equal numbers for coincident corners: most solvers write every cell with points of its own.
void Builder::numberCorners()
{
  hop::ElementMesh& mesh = this->Result.mesh;
  vtkNew<vtkPoints> corners;
  corners->SetDataTypeToDouble();
  double largest = 0.0;
  double shortestEdge = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    const hop::BernsteinForm form = mesh.form(static_cast<int>(e));
    glm::dvec3 previous;
    for (int c = 0; c < static_cast<int>(hop::facts(form.domain).corners.size()); ++c)
    {
      const glm::dvec3 x(form.coefficients[hop::coefficientIndex(form.domain, form.degrees,
        hop::cornerLatticePoint(form.domain, form.degrees, c))]);
      corners->InsertNextPoint(x.x, x.y, x.z);
      largest = std::max({ largest, std::abs(x.x), std::abs(x.y), std::abs(x.z) });
      const double edge = c > 0 ? glm::distance(x, previous) : 0.0;
      shortestEdge = edge > 0.0 ? std::min(shortestEdge, edge) : shortestEdge;
      previous = x;
    }
  }
  if (mesh.elements.empty())
  {
    return;
  }
  // Files may hold single precision or six decimal digits, whatever the type of their arrays; but
  // corners of one element must stay apart.
  this->Tolerance = std::min(1e-5 * largest, 1e-2 * shortestEdge);

  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(corners);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->SetTraversalOrderToPointOrder(); // the same result for any number of threads
  locator->BuildLocator();
  std::vector<vtkIdType> merged(corners->GetNumberOfPoints());
  locator->MergePoints(this->Tolerance, merged.data());
  auto next = merged.begin();
  for (hop::Element& element : mesh.elements)
  {
    element.corners.fill(-1);
    const std::size_t count = hop::facts(element.domain).corners.size();
    std::copy_n(next, count, element.corners.begin());
    next += static_cast<std::ptrdiff_t>(count);
  }
}

/// VTK's table of names has Lagrange and Bezier triangles and quadrilaterals the wrong way round, but
/// it also knows the types of which no cell can be made.
std::string nameOfCellType(int type)
{
  const auto cell = vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(type));
  return cell ? cell->GetClassName() : vtkCellTypes::GetClassNameFromTypeId(type);
}

void describeCells(std::ostream& text, const SkippedCells& cells, const std::string& reason)
{
  if (cells.count > 0)
  {
    text << "\n  " << cells.count << (cells.count == 1 ? " cell " : " cells ") << reason
         << " (first: cell " << cells.first << ")";
  }
}

} // namespace

vtkIdType CellCensus::skipped() const
{
  vtkIdType sum = this->brokenConnectivity.count + this->notFinite.count + this->collapsed.count;
  for (const auto& [type, cells] : this->unsupported)
  {
    sum += cells.count;
  }
  return sum;
}

std::string CellCensus::describe() const
{
  std::ostringstream text;
  for (const auto& [type, cells] : this->unsupported)
  {
    describeCells(text, cells,
      "of type " + nameOfCellType(type) +
        " skipped: not a supported 3-D cell, or its number of points fits no degree up to " +
        std::to_string(hop::MaximumDegree));
  }
  describeCells(text, this->brokenConnectivity, "skipped: point ids outside the grid");
  describeCells(text, this->notFinite, "skipped: coordinates or values that are NaN or infinite");
  describeCells(text, this->collapsed, "skipped: without volume");
  describeCells(text, this->folded, "kept, but partly inverted: the Jacobian changes its sign");
  return text.str();
}

GridElements buildGridElements(vtkUnstructuredGrid* grid, vtkDataArray* scalars,
  const std::vector<double>& isovalues, const hop::ParallelFor& parallelFor)
{
  return Builder(grid, scalars, isovalues, parallelFor).build();
}
