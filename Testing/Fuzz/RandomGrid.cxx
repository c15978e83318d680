#include "RandomGrid.h"

#include "Support/Random.h"

#include <glm/glm.hpp>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypeSource.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace hop::testing
{
namespace
{

struct Cell
{
  int type;
  std::vector<vtkIdType> nodes;
};

/// A straight mesh on its way to become a grid: nodes and cells in a box of unit cubes, then bent.
struct Mesh
{
  std::vector<glm::dvec3> nodes;
  std::vector<Cell> cells;
};

double normal(Random& dice)
{
  const double u = 1.0 - dice.uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * dice.uniform());
}

std::size_t below(Random& dice, std::size_t count)
{
  return static_cast<std::size_t>(dice.uniform() * static_cast<double>(count));
}

template <class Choice>
Choice pick(Random& dice, const std::vector<Choice>& choices)
{
  return choices[below(dice, choices.size())];
}

/// Of the types that VTK's source knows.
Mesh meshOfSource(const GridRecipe& recipe)
{
  const vtkNew<vtkCellTypeSource> source;
  source->SetCellType(recipe.count("cell"));
  const int blocks = recipe.count("blocks");
  source->SetBlocksDimensions(blocks, blocks, blocks);
  source->SetCellOrder(recipe.count("order"));
  source->Update();
  vtkUnstructuredGrid* made = source->GetOutput();
  Mesh mesh;
  for (vtkIdType n = 0; n < made->GetNumberOfPoints(); ++n)
  {
    const double* x = made->GetPoint(n);
    mesh.nodes.emplace_back(x[0], x[1], x[2]);
  }
  const vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < made->GetNumberOfCells(); ++cell)
  {
    made->GetCellPoints(cell, ids);
    mesh.cells.push_back({ made->GetCellType(cell), { ids->begin(), ids->end() } });
  }
  return mesh;
}

/// A row of cells, each with points of its own, where VTK's shape tables have them.
Mesh meshByHand(const GridRecipe& recipe)
{
  Mesh mesh;
  const vtkNew<vtkGenericCell> cell;
  cell->SetCellType(recipe.count("cell"));
  const double* nodes = cell->GetParametricCoords();
  for (int block = 0; block < recipe.count("blocks"); ++block)
  {
    mesh.cells.push_back({ recipe.count("cell"), {} });
    for (vtkIdType n = 0; n < cell->GetNumberOfPoints(); ++n)
    {
      mesh.cells.back().nodes.push_back(static_cast<vtkIdType>(mesh.nodes.size()));
      mesh.nodes.emplace_back(nodes[3 * n] + block, nodes[3 * n + 1], nodes[3 * n + 2]);
    }
  }
  return mesh;
}

Mesh straightMesh(const GridRecipe& recipe)
{
  switch (recipe.count("cell"))
  {
    case VTK_VOXEL:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
    case VTK_QUADRATIC_LINEAR_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
      return meshByHand(recipe);
    default:
      return meshOfSource(recipe);
  }
}

/// The first cells, and the nodes that these have.
Mesh firstCells(const Mesh& mesh, std::size_t count)
{
  Mesh kept;
  std::map<vtkIdType, vtkIdType> newIds;
  for (std::size_t c = 0; c < std::min(count, mesh.cells.size()); ++c)
  {
    Cell& cell = kept.cells.emplace_back(mesh.cells[c]);
    for (vtkIdType& id : cell.nodes)
    {
      const auto [known, isNew] = newIds.emplace(id, static_cast<vtkIdType>(kept.nodes.size()));
      if (isNew)
      {
        kept.nodes.push_back(mesh.nodes[id]);
      }
      id = known->second;
    }
  }
  return kept;
}

/// A value at a point of the box [0, 1]^3, about one in size.
double fieldAt(int kind, const glm::dvec3& x, bool isSpike, Random& dice)
{
  switch (kind)
  {
    case 0: // linear
      return glm::dot(x, glm::dvec3(1.0, 0.5, 0.25));
    case 1: // sphere
      return glm::dot(x - 0.5, x - 0.5);
    case 2: // gyroid
      return glm::dot(glm::sin(7.0 * x), glm::cos(7.0 * glm::dvec3(x.y, x.z, x.x)));
    case 3: // noise
      return normal(dice);
    case 4: // steps
      return std::floor(3.0 * x.x) + (dice.uniform() < 0.2 ? 1.0 : 0.0);
    case 5: // constant
      return 1.0;
    case 6: // product
      return (x.x - 0.5) * (x.y - 0.5) * (x.z - 0.5);
    default:
      return isSpike ? 1.0 : 0.0;
  }
}

double weightAt(int kind, Random& dice)
{
  const double weight = dice.uniform() + 0.5;
  const double weights[] = { 1.0, weight, std::pow(weight, 4), 0.0, 1e-200 * weight };
  return weights[kind];
}

std::vector<glm::dvec3> bentNodes(const GridRecipe& recipe, const Mesh& straight, Random& dice)
{
  const glm::dvec3 phase(dice.uniform(), dice.uniform(), dice.uniform());
  const double unit = std::pow(10.0, recipe["length"]);
  std::vector<glm::dvec3> bent;
  for (const glm::dvec3& x : straight.nodes)
  {
    glm::dvec3 y = x + recipe["warp"] * glm::sin(2.0 * glm::dvec3(x.y, x.z, x.x) + phase);
    const glm::dvec3 random(normal(dice), normal(dice), normal(dice));
    y += recipe["scatter"] / std::max(2.0, recipe["order"]) * random;
    y.z *= recipe["flat"];
    bent.push_back((y + recipe["offset"]) * unit);
  }
  return bent;
}

/// Row by row, as many numbers a row as the array has components.
std::vector<double> values(const GridRecipe& recipe, const Mesh& straight, Random& dice)
{
  const std::size_t spike = below(dice, straight.nodes.size());
  const double unit = std::pow(10.0, recipe["value"]);
  std::vector<double> all;
  for (std::size_t n = 0; n < straight.nodes.size(); ++n)
  {
    for (int component = 0; component < recipe.count("components"); ++component)
    {
      const double value =
        fieldAt(recipe.count("field"), straight.nodes[n] / recipe["blocks"], n == spike, dice);
      all.push_back((value + recipe["shift"]) * unit);
    }
  }
  return all;
}

/// Numbers and cells that files should not hold, where bad is 1 to 5, 8 and 9; 6 and 7 are of arrays.
void spoil(int bad, Mesh& mesh, std::vector<double>& numbers, Random& dice)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  double& coordinate = mesh.nodes[below(dice, mesh.nodes.size())].x;
  const std::size_t components = numbers.size() / mesh.nodes.size();
  const auto row = numbers.begin() + components * below(dice, mesh.nodes.size());
  const auto set = [&](double value) { std::fill(row, row + components, value); };
  Cell& last = mesh.cells.back();
  vtkIdType& id = last.nodes[below(dice, last.nodes.size())];
  switch (bad)
  {
    case 1:
      coordinate = pick<double>(dice, { nan, infinity, -infinity });
      break;
    case 2:
      set(pick<double>(dice, { nan, infinity, -infinity }));
      break;
    case 3:
      id = pick<vtkIdType>(dice, { -1, static_cast<vtkIdType>(mesh.nodes.size()), 1000000000 });
      break;
    case 4:
      set(pick<double>(dice, { 1e30, 1e80, 1e300 }));
      break;
    case 5:
      coordinate = pick<double>(dice, { 1e20, 1e100, 1e300 });
      break;
    case 8:
      last.type = pick(dice, ingredients().front().choices);
      break;
    case 9:
      last.nodes.pop_back();
      break;
    default:
      break;
  }
}

vtkSmartPointer<vtkDataArray> arrayOf(int number)
{
  if (number == 1)
  {
    return vtkSmartPointer<vtkFloatArray>::New();
  }
  if (number == 2)
  {
    return vtkSmartPointer<vtkIntArray>::New();
  }
  return vtkSmartPointer<vtkDoubleArray>::New();
}

/// What an array of that type can hold of a number.
double within(int number, double value)
{
  if (number == 1)
  {
    constexpr double most = std::numeric_limits<float>::max();
    return std::isfinite(value) ? std::clamp(value, -most, most) : value;
  }
  return number != 2 ? value : std::isnan(value) ? 0.0 : std::clamp(1000.0 * value, -2e9, 2e9);
}

void addArray(vtkDataSetAttributes& data, const char* name, int number, int components,
  const std::vector<double>& numbers)
{
  const vtkSmartPointer<vtkDataArray> array = arrayOf(number);
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(numbers.size()) / components);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    const auto row = static_cast<vtkIdType>(i) / components;
    array->SetComponent(row, static_cast<int>(i % components), within(number, numbers[i]));
  }
  data.AddArray(array);
}

vtkSmartPointer<vtkUnstructuredGrid> gridOf(const Mesh& mesh, int number)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const vtkNew<vtkPoints> points;
  points->SetDataType(number == 1 ? VTK_FLOAT : VTK_DOUBLE);
  for (const glm::dvec3& x : mesh.nodes)
  {
    points->InsertNextPoint(number == 1 ? within(1, x.x) : x.x, number == 1 ? within(1, x.y) : x.y,
      number == 1 ? within(1, x.z) : x.z);
  }
  grid->SetPoints(points);
  for (const Cell& cell : mesh.cells)
  {
    grid->InsertNextCell(cell.type, static_cast<vtkIdType>(cell.nodes.size()), cell.nodes.data());
  }
  return grid;
}

/// Arrays that tell more about points and cells.
void decorate(const GridRecipe& recipe, vtkUnstructuredGrid& grid, Random& dice)
{
  std::vector<double> other, weights, marks, degrees, materials;
  for (vtkIdType n = 0; n < grid.GetNumberOfPoints(); ++n)
  {
    other.insert(other.end(), { normal(dice), normal(dice) });
    weights.push_back(weightAt(recipe.count("weights"), dice));
  }
  const double order = recipe["order"];
  for (vtkIdType n = 0; n < grid.GetNumberOfCells(); ++n)
  {
    const double mark = pick<double>(dice, { 1, 8, 32 });
    marks.push_back(dice.uniform() < recipe["ghosts"] ? mark : 0.0);
    degrees.insert(degrees.end(), { order + 1, order, order });
    materials.push_back(static_cast<double>(n % 3));
  }
  vtkPointData& points = *grid.GetPointData();
  addArray(points, "other", 0, 2, other);
  if (recipe.count("weights"))
  {
    addArray(points, "RationalWeights", 0, 1, weights);
    points.SetRationalWeights(points.GetArray("RationalWeights"));
  }
  addArray(*grid.GetCellData(), "material", 2, 1, materials);
  if (recipe.count("bad") == 7)
  {
    addArray(*grid.GetCellData(), "degrees", 0, 3, degrees);
    grid.GetCellData()->SetHigherOrderDegrees(grid.GetCellData()->GetArray("degrees"));
  }
  if (recipe["ghosts"] > 0)
  {
    const vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName("vtkGhostType");
    for (const double mark : marks)
    {
      ghosts->InsertNextValue(static_cast<unsigned char>(mark));
    }
    grid.GetCellData()->AddArray(ghosts);
  }
}

} // namespace

vtkSmartPointer<vtkUnstructuredGrid> makeGrid(const GridRecipe& recipe, int change)
{
  Random dice(2 * recipe.seed() + 1 + 1000003ULL * static_cast<std::uint64_t>(change));
  Mesh mesh = straightMesh(recipe);
  if (const int most = recipe.count("cells"))
  {
    mesh = firstCells(mesh, static_cast<std::size_t>(most));
  }
  std::vector<double> numbers = values(recipe, mesh, dice);
  mesh.nodes = bentNodes(recipe, mesh, dice);
  spoil(recipe.count("bad"), mesh, numbers, dice);
  const int number = recipe.count("number");
  const int components = recipe.count("components");
  vtkSmartPointer<vtkUnstructuredGrid> grid = gridOf(mesh, number);
  if (recipe.count("bad") == 6) // fewer rows than points
  {
    numbers.resize(numbers.size() - static_cast<std::size_t>(components));
  }
  addArray(*grid->GetPointData(), "f", number, components, numbers);
  decorate(recipe, *grid, dice);
  return grid;
}

std::vector<vtkSmartPointer<vtkUnstructuredGrid>> cutIntoPieces(
  vtkUnstructuredGrid& grid, int count)
{
  std::vector<vtkSmartPointer<vtkUnstructuredGrid>> pieces;
  const vtkNew<vtkIdList> ids;
  const vtkIdType cells = grid.GetNumberOfCells();
  for (int n = 0; n < count; ++n)
  {
    pieces.push_back(vtkSmartPointer<vtkUnstructuredGrid>::New());
    vtkUnstructuredGrid& piece = *pieces.back();
    piece.SetPoints(grid.GetPoints());
    piece.GetPointData()->ShallowCopy(grid.GetPointData());
    piece.GetCellData()->CopyAllOn();
    piece.GetCellData()->CopyAllocate(grid.GetCellData());
    for (vtkIdType cell = n * cells / count; cell < (n + 1) * cells / count; ++cell)
    {
      grid.GetCellPoints(cell, ids);
      const vtkIdType row = piece.InsertNextCell(grid.GetCellType(cell), ids);
      piece.GetCellData()->CopyData(grid.GetCellData(), cell, row);
    }
  }
  return pieces;
}

} // namespace hop::testing
