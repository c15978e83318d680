#include "EdgeCases.h"

#include "vtkDoubleArray.h"
#include "vtkHigherOrderTetra.h"
#include "vtkLagrangeHexahedron.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <vector>

namespace
{
constexpr double Spacing = 0.02; // world units
constexpr double Pi = 3.14159265358979323846;

using Field = std::function<double(const glm::dvec3&)>;
using Map = std::function<glm::dvec3(const glm::dvec3&)>;

// Puts a grid together from cells with nodes of their own.
class GridBuilder
{
public:
  GridBuilder()
  {
    this->Points->SetDataTypeToDouble();
    this->Values->SetName("f");
  }

  // Boxes between two corners, in parameters that `map` takes to the world.
  void AddBox(const glm::ivec3& cells, int order, const glm::dvec3& low, const glm::dvec3& high,
    const Map& map, const Field& field);

  // A tetrahedron whose nodes are evenly spaced.
  void AddTetrahedron(int order, const glm::dvec3 (&corners)[4], const Field& field);

  vtkSmartPointer<vtkUnstructuredGrid> Finish()
  {
    this->Grid->SetPoints(this->Points);
    this->Grid->GetPointData()->AddArray(this->Values);
    return this->Grid;
  }

private:
  vtkIdType AddNode(const glm::dvec3& place, const Field& field)
  {
    this->Values->InsertNextValue(field(place));
    return this->Points->InsertNextPoint(place.x, place.y, place.z);
  }

  vtkSmartPointer<vtkUnstructuredGrid> Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> Points;
  vtkNew<vtkDoubleArray> Values;
};

void GridBuilder::AddBox(const glm::ivec3& cells, int order, const glm::dvec3& low,
  const glm::dvec3& high, const Map& map, const Field& field)
{
  const int orders[3] = { order, order, order };
  const int side = order + 1;
  std::vector<vtkIdType> ids(side * side * side);
  for (int cell = 0; cell < cells.x * cells.y * cells.z; ++cell)
  {
    const glm::dvec3 first(cell % cells.x, cell / cells.x % cells.y, cell / (cells.x * cells.y));
    for (int node = 0; node < side * side * side; ++node)
    {
      const glm::ivec3 ijk(node % side, node / side % side, node / (side * side));
      const glm::dvec3 share = (first + glm::dvec3(ijk) / double(order)) / glm::dvec3(cells);
      ids[vtkLagrangeHexahedron::PointIndexFromIJK(ijk.x, ijk.y, ijk.z, orders)] =
        this->AddNode(map(low + share * (high - low)), field);
    }
    this->Grid->InsertNextCell(
      VTK_LAGRANGE_HEXAHEDRON, static_cast<vtkIdType>(ids.size()), ids.data());
  }
}

void GridBuilder::AddTetrahedron(int order, const glm::dvec3 (&corners)[4], const Field& field)
{
  std::vector<vtkIdType> ids((order + 1) * (order + 2) * (order + 3) / 6);
  for (vtkIdType node = 0; node < static_cast<vtkIdType>(ids.size()); ++node)
  {
    vtkIdType index[4];
    vtkHigherOrderTetra::BarycentricIndex(node, index, order);
    glm::dvec3 place(0.);
    for (int corner = 0; corner < 4; ++corner)
    {
      place += static_cast<double>(index[corner]) / order * corners[(corner + 1) % 4];
    }
    ids[node] = this->AddNode(place, field);
  }
  this->Grid->InsertNextCell(
    VTK_LAGRANGE_TETRAHEDRON, static_cast<vtkIdType>(ids.size()), ids.data());
}

glm::dvec3 Same(const glm::dvec3& x)
{
  return x;
}

void AddTaper(GridBuilder& grid, double width)
{
  const auto map = [=](const glm::dvec3& x)
  { return glm::dvec3(x.x, x.y * width * (1.55 + 1.45 * x.x), x.z); };
  grid.AddBox({ 8, 1, 8 }, 1, { -1., 0., -1. }, { 1., 1., 1. }, map,
    [](const glm::dvec3& x) { return x.z - 0.1; });
}

void AddCube(GridBuilder& grid, int cells, int order, const Field& field)
{
  grid.AddBox(glm::ivec3(cells), order, glm::dvec3(-1.), glm::dvec3(1.), Same, field);
}

// Boxes side by side, with borders of `x` between them and a plane of its own in each: z = height + slope * x.
struct PlaneInBox
{
  double border = 0.; // where the box ends
  double height = 0.;
  double slope = 0.;
};

void AddPlanes(GridBuilder& grid, const std::vector<PlaneInBox>& planes)
{
  double begin = -1.;
  for (const PlaneInBox& plane : planes)
  {
    const int cells = std::max(1, static_cast<int>(4. * (plane.border - begin)));
    grid.AddBox({ cells, 4, 4 }, 1, { begin, -1., -1. }, { plane.border, 1., 1. }, Same,
      [=](const glm::dvec3& x) { return x.z - plane.height - plane.slope * x.x; });
    begin = plane.border;
  }
}

// A roof whose ridge is cut off by a facet between two creases, from a twentieth of a width at one end to all of it.
void AddSliver(GridBuilder& grid, double width)
{
  const auto end = [=](double y) { return width * (0.525 + 0.475 * y); };
  const glm::ivec3 cells(1, 4, 4);
  const glm::dvec3 low(0., -1., -1.);
  const glm::dvec3 high(1., 1., 1.);
  grid.AddBox({ 4, 4, 4 }, 1, glm::dvec3(-1.), { 0., 1., 1. }, Same,
    [](const glm::dvec3& x) { return x.z - 0.1 - 0.4 * x.x; });
  grid.AddBox(
    cells, 1, low, high, [=](const glm::dvec3& x) { return glm::dvec3(x.x * end(x.y), x.y, x.z); },
    [](const glm::dvec3& x) { return x.z - 0.1 + 0.6 * x.x; });
  grid.AddBox(
    cells, 1, low, high,
    [=](const glm::dvec3& x) { return glm::dvec3(glm::mix(end(x.y), 1., x.x), x.y, x.z); },
    [=](const glm::dvec3& x) { return x.z - 0.1 + 0.4 * end(x.y) + 0.2 * x.x; });
}

void AddFan(GridBuilder& grid, int sides, double fold)
{
  const auto onCircle = [=](int side, double z)
  { return glm::dvec3(std::cos(2. * Pi * side / sides), std::sin(2. * Pi * side / sides), z); };
  for (int side = 0; side < sides; ++side)
  {
    // Linear between its two edges, whose slopes are 1 and, where folded, less.
    const glm::dvec3 a = onCircle(side, 0.);
    const glm::dvec3 b = onCircle(side + 1, 0.);
    const double slopeA = side % 2 ? 1. - fold : 1.;
    const double slopeB = side % 2 ? 1. : 1. - fold;
    const double determinant = a.x * b.y - a.y * b.x;
    const glm::dvec2 slope =
      glm::dvec2(slopeA * b.y - slopeB * a.y, slopeB * a.x - slopeA * b.x) / determinant;
    const Field field = [=](const glm::dvec3& x)
    { return x.z - 0.1 + glm::dot(slope, glm::dvec2(x)); };
    // A prism in three tetrahedra.
    const glm::dvec3 low(0., 0., -1.);
    const glm::dvec3 high(0., 0., 1.);
    const glm::dvec3 lowA = onCircle(side, -1.);
    const glm::dvec3 highA = onCircle(side, 1.);
    const glm::dvec3 lowB = onCircle(side + 1, -1.);
    const glm::dvec3 highB = onCircle(side + 1, 1.);
    grid.AddTetrahedron(1, { low, lowA, lowB, high }, field);
    grid.AddTetrahedron(1, { lowA, lowB, high, highA }, field);
    grid.AddTetrahedron(1, { lowB, high, highA, highB }, field);
  }
}

// A box of cells, each of six tetrahedra around its diagonal; their corners are mapped.
void AddTetrahedra(GridBuilder& grid, const glm::ivec3& cells, int order, const glm::dvec3& low,
  const glm::dvec3& high, const Map& map, const Field& field)
{
  const int ways[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 }, { 2, 1, 0 },
    { 1, 0, 2 } };
  const glm::dvec3 size = (high - low) / glm::dvec3(cells);
  for (int cell = 0; cell < cells.x * cells.y * cells.z; ++cell)
  {
    const glm::dvec3 first =
      low + size * glm::dvec3(cell % cells.x, cell / cells.x % cells.y, cell / (cells.x * cells.y));
    for (const auto& way : ways)
    {
      glm::dvec3 corners[4] = { first, first, first, first };
      for (int step = 0; step < 3; ++step)
      {
        for (int corner = step + 1; corner < 4; ++corner)
        {
          corners[corner][way[step]] += size[way[step]];
        }
      }
      for (glm::dvec3& corner : corners)
      {
        corner = map(corner);
      }
      grid.AddTetrahedron(order, corners, field);
    }
  }
}

// How a box is filled with cells: by GridBuilder::AddBox or AddTetrahedra.
using FillBox = std::function<void(GridBuilder&, const glm::ivec3& cells, int order,
  const glm::dvec3& low, const glm::dvec3& high, const Map& map, const Field& field)>;

void AddStrip(GridBuilder& grid, double width, const FillBox& fill)
{
  fill(grid, { 8, 1, 8 }, 1, { -1., 0., -1. }, { 1., width, 1. }, Same,
    [](const glm::dvec3& x) { return x.z - 0.1; });
}

void AddWave(GridBuilder& grid, double width, const FillBox& fill)
{
  const auto map = [](const glm::dvec3& x)
  { return glm::dvec3(x.x, x.y + 0.2 * std::sin(4. * x.x), x.z); };
  fill(grid, { 10, 1, 8 }, 3, { -1., 0., -1. }, { 1., width, 1. }, map,
    [](const glm::dvec3& x) { return x.z - 0.2 * std::cos(3. * x.x) - 0.3 * x.y; });
}

using AddCells = std::function<void(GridBuilder&, double size)>;

const std::map<std::string, AddCells>& Kinds()
{
  static const std::map<std::string, AddCells> kinds = {
    { "strip",
      [](GridBuilder& grid, double size)
      { AddStrip(grid, size * Spacing, std::mem_fn(&GridBuilder::AddBox)); } },
    { "wave",
      [](GridBuilder& grid, double size)
      { AddWave(grid, size * Spacing, std::mem_fn(&GridBuilder::AddBox)); } },
    { "tetstrip",
      [](GridBuilder& grid, double size) { AddStrip(grid, size * Spacing, AddTetrahedra); } },
    { "tetwave",
      [](GridBuilder& grid, double size) { AddWave(grid, size * Spacing, AddTetrahedra); } },
    { "taper", [](GridBuilder& grid, double size) { AddTaper(grid, size * Spacing); } },
    { "shaving",
      [](GridBuilder& grid, double size)
      {
        AddCube(grid, 3, 1,
          [=](const glm::dvec3& x) { return x.x + x.z - 2. + size * Spacing * std::sqrt(0.5); });
      } },
    { "cap",
      [](GridBuilder& grid, double size)
      {
        const double depth = std::sqrt(0.25 - size * size * Spacing * Spacing);
        AddCube(grid, 3, 2,
          [=](const glm::dvec3& x)
          {
            const glm::dvec3 from = x - glm::dvec3(0.1, 0.05, -1. - depth);
            return glm::dot(from, from) - 0.25;
          });
      } },
    { "corner",
      [](GridBuilder& grid, double size)
      {
        AddCube(grid, 3, 1,
          [=](const glm::dvec3& x)
          { return x.x + x.y + x.z + 3. - size * Spacing * std::sqrt(0.5); });
      } },
    { "notch",
      [](GridBuilder& grid, double size)
      {
        const Field field = [=](const glm::dvec3& x)
        { return x.z - 0.1 - 0.2 * size * (x.x + x.y); };
        grid.AddBox({ 2, 4, 4 }, 1, { -1., -1., -1. }, { 0., 1., 1. }, Same, field);
        grid.AddBox({ 2, 2, 4 }, 1, { 0., -1., -1. }, { 1., 0., 1. }, Same, field);
      } },
    { "cone",
      [](GridBuilder& grid, double size)
      {
        AddCube(grid, 4, 2,
          [=](const glm::dvec3& x)
          {
            const glm::dvec3 y = x - glm::dvec3(0.31, 0.17, 0.73) * size * Spacing;
            return y.x * y.x + y.y * y.y - 0.7 * y.z * y.z;
          });
      } },
    { "step",
      [](GridBuilder& grid, double size) {
        AddPlanes(grid, { { 0., 0.1, 0. }, { 1., 0.1 + size * Spacing, 0. } });
      } },
    { "ledge",
      [](GridBuilder& grid, double size)
      {
        const double end = size * Spacing;
        AddPlanes(grid, { { 0., 0.1, 0.4 }, { end, 0.1, -0.6 }, { 1., 0.1 - 0.4 * end, -0.2 } });
      } },
    { "bevel",
      [](GridBuilder& grid, double size)
      {
        const double end = size * Spacing;
        AddPlanes(grid, { { 0., 0.1, 0.4 }, { end, 0.1, -0.1 }, { 1., 0.1 + 0.1 * end, -0.2 } });
      } },
    { "sliver", [](GridBuilder& grid, double size) { AddSliver(grid, size * Spacing); } },
    { "fan", [](GridBuilder& grid, double size) { AddFan(grid, static_cast<int>(size), 0.); } },
    { "pleats", [](GridBuilder& grid, double size) { AddFan(grid, static_cast<int>(size), 0.5); } },
    { "facets",
      [](GridBuilder& grid, double size)
      {
        const int cells = static_cast<int>(std::lround(2. / (size * Spacing)));
        AddTetrahedra(grid, glm::ivec3(cells), 1, glm::dvec3(-1.), glm::dvec3(1.), Same,
          [](const glm::dvec3& x) { return glm::length(x - glm::dvec3(0.02, 0.03, 0.01)) - 0.7; });
      } },
  };
  return kinds;
}
}

SurfaceCase MakeEdgeCase(const std::string& name)
{
  const std::size_t colon = name.find(':');
  const auto kind = Kinds().find(name.substr(0, colon));
  if (colon == std::string::npos || kind == Kinds().end())
  {
    throw std::invalid_argument("no edge case '" + name + "'");
  }
  GridBuilder grid;
  kind->second(grid, std::stod(name.substr(colon + 1)));
  return MakeSurfaceCase(
    name, grid.Finish(), "f", 0., 0.5 * Spacing); // a share of the longest side, 2
}

const std::vector<std::string>& EdgeCaseNames()
{
  static const std::vector<std::string> names = []
  {
    std::vector<std::string> all;
    for (const char* kind : { "strip", "wave", "taper", "shaving", "cap", "corner" })
    {
      for (const char* size : { "0.3", "0.6", "1", "1.4", "2", "3" })
      {
        all.push_back(std::string(kind) + ":" + size);
      }
    }
    for (const char* name : { "notch:0", "notch:1", "cone:0", "cone:0.6", "step:0.3", "step:0.6",
           "ledge:0.1", "ledge:0.5", "sliver:0.3", "sliver:1", "fan:4", "fan:5", "fan:6", "fan:8",
           "fan:12", "pleats:6", "pleats:8", "pleats:12", "facets:8", "facets:14" })
    {
      all.push_back(name);
    }
    return all;
  }();
  return names;
}
