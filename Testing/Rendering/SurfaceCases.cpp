#include "SurfaceCases.h"

#include "AnalyticFields.h"

#include "vtkContourFilter.h"
#include "vtkDoubleArray.h"
#include "vtkHighOrderParticleIsosurface.h"
#include "vtkLagrangeHexahedron.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPUnstructuredGridReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace
{
constexpr const char* FieldName = "f";

// The cube [-1,1]^3 as cells^3 Lagrange hexahedra of an order, each with nodes of its own.
vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(
  int cells, int order, const hop::testing::Field& field)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName(FieldName);
  const int orders[3] = { order, order, order };
  const int nodes = (order + 1) * (order + 1) * (order + 1);
  std::vector<vtkIdType> ids(nodes);
  for (int cell = 0; cell < cells * cells * cells; ++cell)
  {
    const glm::ivec3 at(cell % cells, cell / cells % cells, cell / (cells * cells));
    for (int node = 0; node < nodes; ++node)
    {
      const glm::ivec3 ijk(
        node % (order + 1), node / (order + 1) % (order + 1), node / ((order + 1) * (order + 1)));
      const glm::dvec3 x =
        2. / cells * (glm::dvec3(at) + glm::dvec3(ijk) / double(order)) - glm::dvec3(1.);
      ids[vtkLagrangeHexahedron::PointIndexFromIJK(ijk.x, ijk.y, ijk.z, orders)] =
        points->InsertNextPoint(x.x, x.y, x.z);
      values->InsertNextValue(field(x));
    }
    grid->InsertNextCell(VTK_LAGRANGE_HEXAHEDRON, nodes, ids.data());
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(values);
  return grid;
}

template <class Reader>
vtkSmartPointer<vtkUnstructuredGrid> ReadBy(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid> ReadGrid(const std::string& path, const std::string& array)
{
  const bool isInPieces = path.size() > 5 && path.substr(path.size() - 5) == ".pvtu";
  vtkSmartPointer<vtkUnstructuredGrid> grid = isInPieces
    ? ReadBy<vtkXMLPUnstructuredGridReader>(path)
    : ReadBy<vtkXMLUnstructuredGridReader>(path);
  if (!grid->GetPointData()->HasArray(array.c_str()))
  {
    throw std::invalid_argument("no point array '" + array + "' in '" + path + "'");
  }
  return grid;
}

void MakeParticles(SurfaceCase& surface, double spacing)
{
  double bounds[6];
  surface.Grid->GetBounds(bounds);
  surface.Spacing =
    spacing * std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  vtkNew<vtkHighOrderParticleIsosurface> filter;
  filter->SetInputData(surface.Grid);
  filter->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, surface.Array.c_str());
  filter->SetValue(0, surface.Isovalue);
  filter->SetSpacing(surface.Spacing);
  filter->PassDiagnosticsOn(); // views of corners are found by the clip planes
  filter->Update();
  surface.Particles = filter->GetOutput();
  if (surface.Spacing == 0.)
  {
    vtkDataArray* radii = surface.Particles->GetPointData()->GetArray("Radius");
    surface.Spacing = radii ? radii->GetRange()[1] : 0.;
  }
}

SurfaceCase AnalyticCase(
  const std::string& name, int cells, int order, const hop::testing::Field& field, double spacing)
{
  return MakeSurfaceCase(name, MakeGrid(cells, order, field), FieldName, 0., spacing);
}

SurfaceCase FileCase(const std::string& name, const std::string& path, const std::string& array,
  double isovalue, double spacing)
{
  return MakeSurfaceCase(name, ReadGrid(path, array), array, isovalue, spacing);
}

// FILE.vtu:ARRAY:ISOVALUE, called by the name of the file.
SurfaceCase NamedFileCase(const std::string& name, double spacing)
{
  const std::size_t second = name.rfind(':');
  const std::size_t first = second == std::string::npos ? second : name.rfind(':', second - 1);
  if (first == std::string::npos)
  {
    throw std::invalid_argument("no case '" + name + "', nor is it FILE.vtu:ARRAY:ISOVALUE");
  }
  const std::string path = name.substr(0, first);
  return FileCase(path.substr(path.rfind('/') + 1), path,
    name.substr(first + 1, second - first - 1), std::stod(name.substr(second + 1)), spacing);
}

SurfaceCase CreaseCase(double spacing)
{
  const hop::testing::Field half = hop::testing::sphere({ 0.35, 0., 0. }, 0.6).field;
  return AnalyticCase(
    "crease", 4, 2,
    [&half](const glm::dvec3& x) {
      return half({ std::abs(x.x), x.y, x.z });
    },
    spacing);
}
}

SurfaceCase MakeSurfaceCase(const std::string& name, vtkUnstructuredGrid* grid,
  const std::string& array, double isovalue, double spacing)
{
  SurfaceCase surface;
  surface.Name = name;
  surface.Grid = grid;
  surface.Array = array;
  surface.Isovalue = isovalue;
  MakeParticles(surface, spacing);
  return surface;
}

SurfaceCase MakeSurfaceCase(const std::string& name, double spacing)
{
  if (name == "sphere")
  {
    return AnalyticCase(name, 4, 2, hop::testing::sphere({ 0., 0., 0. }, 0.8).field, spacing);
  }
  if (name == "torus")
  {
    return AnalyticCase(name, 4, 4, hop::testing::torus(0.6, 0.25).field, spacing);
  }
  if (name == "boundary")
  {
    return AnalyticCase(name, 4, 2, hop::testing::sphere({ 0., 0., 0.7 }, 0.8).field, spacing);
  }
  if (name == "crease")
  {
    return CreaseCase(spacing);
  }
  if (name == "hexahedron")
  {
    return FileCase(name, HOP_DATA "/mfem_hex1_p8.vtu", "u", 0.2, spacing);
  }
  if (name == "cylinder")
  {
    return FileCase(name, HOP_DATA "/mfem_cylinder_hex_prism_p3.vtu", "pressure", -0.5, spacing);
  }
  return NamedFileCase(name, spacing);
}

const std::vector<std::string>& SurfaceCaseNames()
{
  static const std::vector<std::string> names = { "sphere", "torus", "boundary", "crease",
    "hexahedron", "cylinder" };
  return names;
}

vtkSmartPointer<vtkPolyData> ContourOf(const SurfaceCase& surface)
{
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(surface.Grid);
  contour->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, surface.Array.c_str());
  contour->SetValue(0, surface.Isovalue);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(contour->GetOutputPort());
  normals->SplittingOff();
  normals->Update();
  return normals->GetOutput();
}
