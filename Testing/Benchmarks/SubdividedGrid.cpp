#include "SubdividedGrid.h"

#include "Elements/BatchEvaluator.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <map>

namespace hop::testing
{
namespace
{

/// How a domain is cut: sample points, and the cells between them.
struct Lattice
{
  std::vector<ReferencePoint> points;
  std::vector<std::vector<int>> cells;
  unsigned char cellType = VTK_EMPTY_CELL;
};

/// Cubes of k^3 points: those that a domain keeps of them, and where they end up.
class LatticeMaker
{
public:
  LatticeMaker(Domain domain, int pieces)
    : Kind(domain)
    , Pieces(pieces)
  {
  }

  Lattice make()
  {
    this->forCubes([this](int i, int j, int k) { this->cut(i, j, k); });
    this->Result.cellType = this->Kind == Domain::Hexahedron ? VTK_HEXAHEDRON
      : this->Kind == Domain::Wedge                          ? VTK_WEDGE
                                                             : VTK_TETRA;
    return this->Result;
  }

private:
  template <class Use>
  void forCubes(const Use& use) const
  {
    for (int k = 0; k < this->Pieces; ++k)
    {
      for (int j = 0; j < this->Pieces; ++j)
      {
        for (int i = 0; i < this->Pieces; ++i)
        {
          use(i, j, k);
        }
      }
    }
  }

  int pointAt(const glm::ivec3& at)
  {
    const auto key = std::array<int, 3>{ at.x, at.y, at.z };
    const auto [found, isNew] =
      this->Numbers.emplace(key, static_cast<int>(this->Result.points.size()));
    if (isNew)
    {
      this->Result.points.push_back({ glm::dvec3(at) / static_cast<double>(this->Pieces) });
    }
    return found->second;
  }

  void cut(int i, int j, int k)
  {
    const glm::ivec3 base(i, j, k);
    const auto corner = [&](int x, int y, int z) { return base + glm::ivec3(x, y, z); };
    if (this->Kind == Domain::Hexahedron)
    {
      this->add({ corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0),
        corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1) });
    }
    else if (this->Kind == Domain::Wedge)
    {
      const auto addWedge = [&](glm::ivec3 a, glm::ivec3 b, glm::ivec3 c)
      {
        const glm::ivec3 up(0, 0, 1);
        this->add({ a, b, c, a + up, b + up, c + up });
      };
      addWedge(corner(0, 0, 0), corner(1, 0, 0), corner(0, 1, 0));
      addWedge(corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0));
    }
    else
    {
      this->cutKuhn(base);
    }
  }

  /// Six tetrahedra a cube, one for each order of the axes. In coordinates x = u + v + w, y = v + w, z = w
  /// the domain is 1 >= x >= y >= z >= 0, which is one of the six of the unit cube.
  void cutKuhn(const glm::ivec3& base)
  {
    std::array<int, 3> axes{ 0, 1, 2 };
    do
    {
      std::vector<glm::ivec3> corners{ base };
      for (const int axis : axes)
      {
        corners.push_back(corners.back());
        ++corners.back()[axis];
      }
      for (glm::ivec3& c : corners)
      {
        c = { c.x - c.y, c.y - c.z, c.z };
      }
      this->add(corners);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  /// A cell, if the domain holds all its corners.
  void add(const std::vector<glm::ivec3>& corners)
  {
    const auto isOutside = [&](const glm::ivec3& c) {
      return insideMargin(this->Kind, { glm::dvec3(c) / static_cast<double>(this->Pieces) }) <
        -1e-9;
    };
    if (std::any_of(corners.begin(), corners.end(), isOutside))
    {
      return;
    }
    std::vector<int> cell;
    for (const glm::ivec3& c : corners)
    {
      cell.push_back(this->pointAt(c));
    }
    this->Result.cells.push_back(cell);
  }

  Domain Kind;
  int Pieces;
  std::map<std::array<int, 3>, int> Numbers;
  Lattice Result;
};

} // namespace

vtkSmartPointer<vtkUnstructuredGrid> subdividedGrid(
  const ElementMesh& mesh, int pieces, const ParallelFor& parallelFor)
{
  std::map<Domain, Lattice> lattices;
  std::vector<const Lattice*> latticeOf;
  std::vector<vtkIdType> firstPoint{ 0 }, firstCell{ 0 }, firstId{ 0 };
  for (const Element& element : mesh.elements)
  {
    auto& lattice = lattices[element.domain];
    if (lattice.points.empty())
    {
      lattice = LatticeMaker(element.domain, pieces).make();
    }
    const auto cells = static_cast<vtkIdType>(lattice.cells.size());
    latticeOf.push_back(&lattice);
    firstPoint.push_back(firstPoint.back() + static_cast<vtkIdType>(lattice.points.size()));
    firstCell.push_back(firstCell.back() + cells);
    firstId.push_back(firstId.back() + cells * static_cast<vtkIdType>(lattice.cells[0].size()));
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(firstPoint.back());
  auto* positions = static_cast<double*>(points->GetVoidPointer(0));
  vtkNew<vtkDoubleArray> field;
  field->SetName("f");
  field->SetNumberOfValues(firstPoint.back());
  vtkNew<vtkIdTypeArray> offsets;
  offsets->SetNumberOfValues(firstCell.back() + 1);
  offsets->SetValue(firstCell.back(), firstId.back());
  vtkNew<vtkIdTypeArray> ids;
  ids->SetNumberOfValues(firstId.back());
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(firstCell.back());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(mesh.elements.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      JetBatch jets;
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        const Lattice& lattice = *latticeOf[e];
        const auto count = static_cast<int>(lattice.points.size());
        evaluateGradients(mesh.form(static_cast<int>(e)), lattice.points.data(), count, jets);
        for (int n = 0; n < count; ++n)
        {
          const vtkIdType point = firstPoint[e] + n;
          for (int axis = 0; axis < 3; ++axis)
          {
            positions[3 * point + axis] = jets.row(quantity::value, axis)[n];
          }
          field->SetValue(point, jets.row(quantity::value, 3)[n]);
        }
        vtkIdType id = firstId[e];
        vtkIdType cell = firstCell[e];
        for (const std::vector<int>& corners : lattice.cells)
        {
          types->SetValue(cell, lattice.cellType);
          offsets->SetValue(cell++, id);
          for (const int corner : corners)
          {
            ids->SetValue(id++, firstPoint[e] + corner);
          }
        }
      }
    });
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, ids);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->SetCells(types, cells);
  grid->GetPointData()->SetScalars(field);
  return grid;
}

} // namespace hop::testing
