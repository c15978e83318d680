#include "BenchmarkGrids.h"

#include "AnalyticFields.h"
#include "TestMeshes.h"
#include "VtkCells.h"

#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNonLinearCell.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <filesystem>

namespace hop::testing
{
namespace
{

enum class CellKind
{
  Lagrange,
  Bezier
};

int cellType(Domain domain, CellKind kind)
{
  switch (domain)
  {
    case Domain::Tetrahedron:
      return kind == CellKind::Bezier ? VTK_BEZIER_TETRAHEDRON : VTK_LAGRANGE_TETRAHEDRON;
    case Domain::Wedge:
      return kind == CellKind::Bezier ? VTK_BEZIER_WEDGE : VTK_LAGRANGE_WEDGE;
    default:
      return kind == CellKind::Bezier ? VTK_BEZIER_HEXAHEDRON : VTK_LAGRANGE_HEXAHEDRON;
  }
}

/// What VTK stores at a node: the polynomial's value there, or the coefficient that belongs to it.
Coefficient atNode(const BernsteinForm& form, const glm::dvec3& node, CellKind kind)
{
  if (kind == CellKind::Lagrange)
  {
    return evaluateGradient(form, { node }).value;
  }
  const auto place = [&](int axis)
  { return static_cast<int>(std::lround(node[axis] * form.degrees[axis])); };
  const LatticePoint at{ place(0), place(1), place(2) };
  return form.coefficients[coefficientIndex(form.domain, form.degrees, at)];
}

/// The same polynomials as VTK's cells, every one with nodes of its own.
vtkSmartPointer<vtkUnstructuredGrid> gridOf(const ElementMesh& mesh, CellKind kind)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> field;
  field->SetName("f");
  vtkNew<vtkIdList> ids;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    const BernsteinForm form = mesh.form(static_cast<int>(e));
    const int count = coefficientCount(form.domain, form.degrees);
    const auto cell = makeLagrangeCell(form.domain, count);
    const double* nodes = cell->GetParametricCoords();
    ids->Reset();
    for (int n = 0; n < count; ++n)
    {
      const glm::dvec3 node(nodes[3 * n], nodes[3 * n + 1], nodes[3 * n + 2]);
      const Coefficient value = atNode(form, node, kind);
      ids->InsertNextId(points->InsertNextPoint(value.x, value.y, value.z));
      field->InsertNextValue(value.w);
    }
    grid->InsertNextCell(cellType(form.domain, kind), ids);
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(field);
  return grid;
}

MeshRecipe bentCubes(Domain domain, int degree, int cells, const Field& field)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { degree, degree, degree };
  recipe.cells = cells;
  recipe.map = wavyMap(0.1);
  recipe.field = field;
  return recipe;
}

/// Values of the three quadratic B-splines over one span, t in [0,1].
glm::dvec3 quadraticSplines(double t)
{
  return { 0.5 * (1.0 - t) * (1.0 - t), 0.5 + t * (1.0 - t), 0.5 * t * t };
}

/// The map of a 4^3 net of control points over the two spans of [-1,1] a side; the net is the regular
/// one, which gives the identity, with its points moved.
glm::dvec3 splineMap(const glm::dvec3& x)
{
  const Map moved = wavyMap(0.25);
  glm::ivec3 span;
  glm::dmat3 weights;
  for (int axis = 0; axis < 3; ++axis)
  {
    span[axis] = x[axis] < 0.0 ? 0 : 1;
    weights[axis] = quadraticSplines(x[axis] + 1.0 - span[axis]);
  }
  glm::dvec3 sum(0.0);
  for (int n = 0; n < 27; ++n)
  {
    const glm::ivec3 local(n % 3, n / 3 % 3, n / 9);
    const glm::dvec3 control = glm::dvec3(span + local) - 1.5;
    sum += weights[0][local.x] * weights[1][local.y] * weights[2][local.z] * moved(control);
  }
  return sum;
}

vtkSmartPointer<vtkUnstructuredGrid> teardrop()
{
  // The field is a polynomial of the straight cube, the map bends what it is drawn in.
  MeshRecipe recipe;
  recipe.degrees = { 5, 5, 5 };
  recipe.field = [](const glm::dvec3& t)
  {
    const double x = 0.575 * t.x - 0.475, y = 0.5 * t.y, z = 0.5 * t.z;
    return 0.5 * x * x * x * x * (x + 1.0) - y * y - z * z;
  };
  const ElementMesh straight = makeMesh(recipe);
  recipe.map = splineMap;
  ElementMesh bent = makeMesh(recipe);
  for (std::size_t c = 0; c < bent.coefficients.size(); ++c)
  {
    bent.coefficients[c].w = straight.coefficients[c].w;
  }
  return gridOf(bent, CellKind::Bezier);
}

vtkSmartPointer<vtkUnstructuredGrid> readFile(const std::string& name)
{
  if (!std::filesystem::is_regular_file(name))
  {
    return nullptr;
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  return reader->GetOutput();
}

} // namespace

vtkSmartPointer<vtkUnstructuredGrid> benchmarkGrid(const std::string& name)
{
  const std::pair<const char*, Domain> domains[] = { { "_hexahedra", Domain::Hexahedron },
    { "_tetrahedra", Domain::Tetrahedron }, { "_wedges", Domain::Wedge } };
  for (const auto& [suffix, domain] : domains)
  {
    if (name == std::string("sphere") + suffix)
    {
      return gridOf(
        makeMesh(bentCubes(domain, 4, 4, sphere({ 0, 0, 0 }, 0.6).field)), CellKind::Lagrange);
    }
    if (name == std::string("torus") + suffix)
    {
      return gridOf(makeMesh(bentCubes(domain, 4, 4, torus(0.5, 0.22).field)), CellKind::Lagrange);
    }
  }
  if (name == "teardrop")
  {
    return teardrop();
  }
  if (name == "gyroid")
  {
    return gridOf(makeMesh(bentCubes(Domain::Hexahedron, 3, 16, gyroid(1.0))), CellKind::Lagrange);
  }
  return readFile(name);
}

} // namespace hop::testing
