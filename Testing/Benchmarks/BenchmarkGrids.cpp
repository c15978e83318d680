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
    case Domain::Hexahedron:
      return kind == CellKind::Bezier ? VTK_BEZIER_HEXAHEDRON : VTK_LAGRANGE_HEXAHEDRON;
    case Domain::Tetrahedron:
      return kind == CellKind::Bezier ? VTK_BEZIER_TETRAHEDRON : VTK_LAGRANGE_TETRAHEDRON;
    case Domain::Wedge:
      return kind == CellKind::Bezier ? VTK_BEZIER_WEDGE : VTK_LAGRANGE_WEDGE;
  }
  unknownDomain();
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

ElementMesh inOneHexahedron(const KnownSurface& surface)
{
  MeshRecipe recipe;
  recipe.degrees = { surface.degree, surface.degree, surface.degree };
  recipe.cells = 1;
  recipe.field = surface.field;
  return makeMesh(recipe);
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
  const std::pair<const char*, ElementMesh (*)()> splines[] = { { "teardrop", teardropMesh },
    { "needle", needleMesh } };
  for (const auto& [spline, make] : splines)
  {
    if (name == spline)
    {
      return gridOf(make(), CellKind::Bezier);
    }
  }
  const std::pair<const char*, KnownSurface (*)()> algebraic[] = { { "quartic", quartic },
    { "tangle", tangleCube }, { "octic", octic } };
  for (const auto& [surface, make] : algebraic)
  {
    if (name == surface)
    {
      return gridOf(inOneHexahedron(make()), CellKind::Lagrange);
    }
  }
  if (name == "vortex_street")
  {
    return gridOf(vortexStreetMesh(), CellKind::Lagrange);
  }
  if (name == "gyroid")
  {
    return gridOf(makeMesh(bentCubes(Domain::Hexahedron, 3, 16, gyroid(1.0))), CellKind::Lagrange);
  }
  return readFile(name);
}

} // namespace hop::testing
