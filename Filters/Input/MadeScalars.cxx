#include "Input/MadeScalars.h"

#include "Elements/FieldExpression.h"
#include "Support/CoincidentPoints.h"

#include "vtkCell.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace hop
{

namespace
{

/// Adds the point arrays of a grid, if there are none of their names yet.
void addPointArrays(vtkUnstructuredGrid* grid, std::vector<NamedArray>& arrays)
{
  vtkPointData* data = grid->GetPointData();
  for (int a = 0; a < data->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = data->GetArray(a);
    const bool isUsable =
      array && array->GetName() && array->GetNumberOfTuples() >= grid->GetNumberOfPoints();
    if (isUsable &&
      std::none_of(arrays.begin(), arrays.end(),
        [&](const NamedArray& other) { return other.name == array->GetName(); }))
    {
      arrays.push_back({ array->GetName(), array->GetNumberOfComponents() });
    }
  }
}

/// Whether a grid has arrays, with as many components.
bool hasAll(vtkUnstructuredGrid* grid, const std::vector<NamedArray>& wanted)
{
  std::vector<NamedArray> there;
  addPointArrays(grid, there);
  return std::all_of(wanted.begin(), wanted.end(),
    [&](const NamedArray& one)
    {
      return std::any_of(there.begin(), there.end(),
        [&](const NamedArray& other)
        { return other.name == one.name && other.components == one.components; });
    });
}

/// The components of arrays side by side; zeros where there are no arrays.
vtkSmartPointer<vtkDataArray> sideBySide(
  vtkUnstructuredGrid* grid, const std::vector<NamedArray>& arrays, const std::string& name)
{
  int width = 0;
  for (const NamedArray& array : arrays)
  {
    width += array.components;
  }
  const auto all = vtkSmartPointer<vtkDoubleArray>::New();
  all->SetName(name.c_str());
  all->SetNumberOfComponents(std::max(width, 1));
  all->SetNumberOfTuples(grid->GetNumberOfPoints());
  all->Fill(0.0);
  int first = 0;
  for (const NamedArray& array : arrays)
  {
    vtkDataArray* source = grid->GetPointData()->GetArray(array.name.c_str());
    for (int c = 0; c < array.components; ++c, ++first)
    {
      for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
      {
        all->SetComponent(i, first, source->GetComponent(i, c));
      }
    }
  }
  return all;
}

/// Means of gradients over the cells around the places of points.
class NodalGradients
{
public:
  NodalGradients(
    vtkUnstructuredGrid* grid, vtkDataArray* field, int component, const CellTest& isSound)
    : Grid(grid)
    , Field(field)
    , First(component == InputBlocks::Magnitude ? 0 : component)
    , Components(component == InputBlocks::Magnitude ? field->GetNumberOfComponents() : 1)
    , Sums(static_cast<std::size_t>(grid->GetNumberOfPoints()) * this->Components)
    , Counts(grid->GetNumberOfPoints(), 0)
    , Sizes(grid->GetNumberOfPoints(), std::numeric_limits<double>::infinity())
  {
    vtkNew<vtkGenericCell> cell;
    vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
    {
      if (!isGhostCell(ghosts, c) && isSound(grid, c))
      {
        grid->GetCell(c, cell);
        this->add(cell);
      }
    }
    this->join();
  }

  /// The mean at a point; zero where there is no cell. Not finite where the field is not, so that cells are left out as
  /// those of the field itself are: means over the other cells may be finite there.
  std::vector<glm::dvec3> at(vtkIdType point) const
  {
    const std::size_t place = this->Places[point];
    std::vector<glm::dvec3> result(&this->Sums[place * this->Components],
      &this->Sums[place * this->Components] + this->Components);
    for (int c = 0; c < this->Components; ++c)
    {
      const bool isKnown = std::isfinite(this->Field->GetComponent(point, this->First + c));
      result[c] = isKnown ? result[c] / double(std::max(this->Counts[place], 1))
                          : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    }
    return result;
  }

private:
  void add(vtkCell* cell);
  void join();

  vtkUnstructuredGrid* Grid;
  vtkDataArray* Field;
  int First;
  int Components;
  std::vector<glm::dvec3> Sums;
  std::vector<int> Counts;
  /// Diagonals of the smallest cells around.
  std::vector<double> Sizes;
  /// The first of the points in one place.
  std::vector<int> Places;
};

/// Adds the gradients of a cell at its nodes. They may be infinite, in the apex of a pyramid for instance: these are left
/// out.
void NodalGradients::add(vtkCell* cell)
{
  std::vector<double> nodal;
  const int count = static_cast<int>(cell->GetNumberOfPoints());
  for (int n = 0; n < count; ++n)
  {
    for (int c = this->First; c < this->First + this->Components; ++c)
    {
      nodal.push_back(this->Field->GetComponent(cell->GetPointId(n), c));
    }
  }
  const double size = std::sqrt(cell->GetLength2());
  double* places = cell->GetParametricCoords();
  std::vector<double> gradient(3 * static_cast<std::size_t>(this->Components));
  for (int n = 0; places && n < count; ++n)
  {
    const vtkIdType point = cell->GetPointId(n);
    this->Sizes[point] = std::min(this->Sizes[point], size);
    cell->Derivatives(0, places + 3 * n, nodal.data(), this->Components, gradient.data());
    if (!std::all_of(
          gradient.begin(), gradient.end(), [](double number) { return std::isfinite(number); }))
    {
      continue;
    }
    ++this->Counts[point];
    for (int c = 0; c < this->Components; ++c)
    {
      this->Sums[static_cast<std::size_t>(point) * this->Components + c] +=
        glm::dvec3(gradient[3 * c], gradient[3 * c + 1], gradient[3 * c + 2]);
    }
  }
}

/// Takes the sums of points in one place together.
void NodalGradients::join()
{
  // How far from each other points may stand that mean one place: of the largest coordinate, for rounded files, and of the
  // cells around, for thin ones. As in cornerTolerances(), but nodes stand closer than corners.
  constexpr double ofCoordinates = 1e-5;
  constexpr double ofCells = 1e-3;
  Buffer<RoundedPoint> points(this->Counts.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    glm::dvec3& x = points[i].position;
    this->Grid->GetPoint(static_cast<vtkIdType>(i), &x.x);
    if (!(std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z)))
    {
      x = glm::dvec3(0.0); // no gradient was added there
    }
    largest = std::max({ largest, std::abs(x.x), std::abs(x.y), std::abs(x.z) });
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double reach = std::min(ofCoordinates * largest, ofCells * this->Sizes[i]);
    points[i].reach = std::max(reach, std::numeric_limits<double>::min());
  }
  this->Places = coincidentPoints(points);
  for (std::size_t i = 0; i < this->Places.size(); ++i)
  {
    const std::size_t place = this->Places[i];
    if (place == i)
    {
      continue;
    }
    this->Counts[place] += this->Counts[i];
    for (int c = 0; c < this->Components; ++c)
    {
      this->Sums[place * this->Components + c] += this->Sums[i * this->Components + c];
    }
  }
}

vtkSmartPointer<vtkDataArray> quantityAtNodes(
  const InputBlock& block, Quantity quantity, int component, const CellTest& isSound)
{
  const NodalGradients gradients(block.grid, block.scalars, component, isSound);
  const FieldFunction function = functionOf(quantity);
  const auto values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetName(block.scalars->GetName());
  values->SetNumberOfTuples(block.grid->GetNumberOfPoints());
  for (vtkIdType i = 0; i < block.grid->GetNumberOfPoints(); ++i)
  {
    const double value = function({ {}, {}, gradients.at(i) });
    values->SetValue(i, isSquareRoot(quantity) ? std::sqrt(value) : value);
  }
  return values;
}

/// Values at the nodes of Bezier cells are control values, of which there are no averages.
bool hasBezierCells(vtkUnstructuredGrid* grid)
{
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const int type = grid->GetCellType(c);
    if (type == VTK_BEZIER_HEXAHEDRON || type == VTK_BEZIER_TETRAHEDRON || type == VTK_BEZIER_WEDGE)
    {
      return true;
    }
  }
  return false;
}

} // namespace

CheckedBlocks checkExpression(const GatheredBlocks& gathered, const std::string& text)
{
  CheckedBlocks checked;
  checked.quantity = Quantity::Expression;
  std::vector<InputBlock> blocks;
  std::copy_if(gathered.blocks.begin(), gathered.blocks.end(), std::back_inserter(blocks),
    [](const InputBlock& block) { return block.grid->GetNumberOfCells() > 0; });
  if (blocks.empty())
  {
    return checked;
  }
  // Blocks without some of the arrays take no part.
  std::vector<NamedArray> arrays;
  for (const InputBlock& block : blocks)
  {
    addPointArrays(block.grid, arrays);
  }
  if (text.find_first_not_of(' ') == std::string::npos)
  {
    std::vector<std::string> names(arrays.size());
    std::transform(arrays.begin(), arrays.end(), names.begin(),
      [](const NamedArray& array) { return array.name; });
    checked.messages.push_back({ UserMessage::Error,
      "Quantity is Expression, but Expression is empty: write a formula of the point arrays (" +
        listOf(names) + ") there." });
    return checked;
  }
  try
  {
    checked.expression = std::make_shared<const FieldExpression>(text, arrays);
  }
  catch (const std::invalid_argument& wrong)
  {
    checked.messages.push_back({ UserMessage::Error,
      "The Expression '" + text + "' cannot be contoured: " + wrong.what() + "." });
    return checked;
  }
  std::vector<std::string> others = gathered.others;
  for (InputBlock block : blocks)
  {
    if (!hasAll(block.grid, checked.expression->arrays()))
    {
      others.push_back(block.name);
      continue;
    }
    block.scalars = sideBySide(block.grid, checked.expression->arrays(), text);
    block.scalarsTime = block.grid->GetPointData()->GetMTime();
    checked.sound.push_back(block);
  }
  if (!others.empty())
  {
    checked.messages.push_back({ UserMessage::Warning,
      "Without particles are " + listOf(others) +
        ": no unstructured grid with all point arrays of the Expression." });
  }
  return checked;
}

CheckedBlocks averagedAtNodes(CheckedBlocks checked, int component, const CellTest& isSound)
{
  if (checked.quantity == Quantity::Value)
  {
    return checked;
  }
  if (std::any_of(checked.sound.begin(), checked.sound.end(),
        [](const InputBlock& block) { return hasBezierCells(block.grid); }))
  {
    checked.messages.push_back({ UserMessage::Error,
      "Derivatives cannot be averaged at the nodes of Bezier cells, which hold no values but "
      "control "
      "values; choose In Each Cell." });
    checked.sound.clear();
  }
  for (InputBlock& block : checked.sound)
  {
    block.scalars = quantityAtNodes(block, checked.quantity, component, isSound);
  }
  checked.quantity = Quantity::Value;
  return checked;
}

} // namespace hop
