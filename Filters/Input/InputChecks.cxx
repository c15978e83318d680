#include "Input/InputChecks.h"

#include "Input/ArrayLengths.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace hop
{

namespace
{

/// Which array was asked for.
struct ArrayChoice
{
  /// Empty for the active array of a kind.
  std::string name;
  int kind = vtkDataSetAttributes::SCALARS;

  vtkDataArray* of(vtkDataSetAttributes* data) const
  {
    return this->name.empty() ? data->GetAttribute(this->kind) : data->GetArray(this->name.c_str());
  }

  /// "point array 'F'", or "active point array (Scalars)".
  /// \param association "point" or "cell"
  std::string describe(const std::string& association) const
  {
    const char* nameOfKind = vtkDataSetAttributes::GetAttributeTypeAsString(this->kind);
    return this->name.empty()
      ? "active " + association + " array (" + (nameOfKind ? nameOfKind : "of no kind") + ")"
      : association + " array '" + this->name + "'";
  }
};

ArrayChoice choiceOf(vtkInformation* asked)
{
  ArrayChoice choice;
  const char* name = asked->Get(vtkDataObject::FIELD_NAME());
  choice.name = name ? name : "";
  if (asked->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    choice.kind = asked->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
  }
  return choice;
}

/// "The grid's point arrays: F, G.", with the arrays of all grids.
std::string describePointArrays(const std::vector<InputBlock>& blocks)
{
  std::vector<std::string> names;
  for (const InputBlock& block : blocks)
  {
    vtkPointData* data = block.grid->GetPointData();
    for (int a = 0; a < data->GetNumberOfArrays(); ++a)
    {
      const std::string name = data->GetArrayName(a) ? data->GetArrayName(a) : "(unnamed)";
      if (std::find(names.begin(), names.end(), name) == names.end())
      {
        names.push_back(name);
      }
    }
  }
  return "The grid's point arrays: " + listOf(names) + ".";
}

/// What is wrong with the kind of the input, or of the array that was asked for; empty if nothing is.
UserMessages checkKinds(const GatheredBlocks& gathered, vtkInformation* asked)
{
  if (gathered.blocks.empty() && !gathered.others.empty())
  {
    return { { UserMessage::Error,
      "The input holds no unstructured grid, only " + listOf(gathered.others) + "." } };
  }
  if (asked->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS)
  {
    return { { UserMessage::Error,
      "The " + choiceOf(asked).describe("cell") +
        " is asked for; an isosurface needs a point array. " +
        describePointArrays(gathered.blocks) } };
  }
  return {};
}

/// The blocks with cells that have the chosen point array, with as many components as in the first of these blocks. The
/// names of other blocks with cells are added to `others`. An active array has to have the same name in all blocks.
std::vector<InputBlock> blocksWithScalars(
  const std::vector<InputBlock>& blocks, ArrayChoice choice, std::vector<std::string>& others)
{
  std::vector<InputBlock> found;
  for (InputBlock block : blocks)
  {
    if (block.grid->GetNumberOfCells() == 0)
    {
      continue;
    }
    block.scalars = choice.of(block.grid->GetPointData());
    block.scalarsTime = block.scalars ? block.scalars->GetMTime() : 0;
    if (!block.scalars ||
      (!found.empty() &&
        block.scalars->GetNumberOfComponents() != found[0].scalars->GetNumberOfComponents()))
    {
      others.push_back(block.name);
      continue;
    }
    found.push_back(block);
    choice.name = block.scalars->GetName() ? block.scalars->GetName() : "";
  }
  return found;
}

/// What to do where no block has the array.
UserMessage describeMissing(const std::vector<InputBlock>& blocks, const ArrayChoice& choice)
{
  const bool isCellArray = std::any_of(blocks.begin(), blocks.end(),
    [&](const InputBlock& block) { return choice.of(block.grid->GetCellData()) != nullptr; });
  return { UserMessage::Error,
    "There is no " + choice.describe("point") + (isCellArray ? ", only one of cells" : "") +
      "; choose one with ContourBy. " + describePointArrays(blocks) };
}

/// The blocks that have the array to contour by, which becomes their scalars. An error says what to do where there is
/// no such block, a warning names the blocks that take no part.
std::vector<InputBlock> findScalars(
  const GatheredBlocks& gathered, const ArrayChoice& choice, UserMessages& messages)
{
  std::vector<std::string> others = gathered.others;
  std::vector<InputBlock> found = blocksWithScalars(gathered.blocks, choice, others);
  if (found.empty() && !others.empty())
  {
    messages.push_back(describeMissing(gathered.blocks, choice));
  }
  else if (!others.empty())
  {
    messages.push_back({ UserMessage::Warning,
      "Without particles are " + listOf(others) + ": no unstructured grid with the " +
        choice.describe("point") + " of as many components as in " + found[0].name + "." });
  }
  return found;
}

/// The blocks whose scalars are long enough, without their other arrays that are too short. An error names the short
/// scalars, a warning the other short arrays.
std::vector<InputBlock> checkLengths(const std::vector<InputBlock>& blocks, UserMessages& messages)
{
  std::vector<InputBlock> sound;
  std::vector<std::string> unusable;
  std::vector<std::string> dropped;
  for (InputBlock block : blocks)
  {
    const std::string shortScalars = describeShortScalars(block);
    if (!shortScalars.empty())
    {
      unusable.push_back(shortScalars);
      continue;
    }
    const std::vector<std::string> some = dropShortArrays(block);
    dropped.insert(dropped.end(), some.begin(), some.end());
    sound.push_back(block);
  }
  if (!unusable.empty())
  {
    messages.push_back(
      { UserMessage::Error, "Too short to contour by: " + listOf(unusable) + "." });
  }
  if (!dropped.empty())
  {
    messages.push_back({ UserMessage::Warning,
      "Arrays that are too short are taken as if they were not there: " + listOf(dropped) + "." });
  }
  return sound;
}

} // namespace

UserMessages checkIsovalues(const std::vector<double>& isovalues, const GatheredBlocks& gathered)
{
  if (!isovalues.empty())
  {
    return {};
  }
  const bool isChoice = std::any_of(gathered.blocks.begin(), gathered.blocks.end(),
    [](const InputBlock& block)
    {
      return block.grid->GetNumberOfCells() > 0 &&
        block.grid->GetPointData()->GetNumberOfArrays() > 0;
    });
  const std::string advice = isChoice
    ? "set ContourBy and Isosurfaces. ParaView chooses them where the input was updated before "
      "this filter was made."
    : "the input has no cells with a point array that there could be one of.";
  return { { UserMessage::Warning, "There are no particles, as no isovalue is given; " + advice } };
}

UserMessages checkParameters(const std::vector<double>& isovalues, double spacing,
  double smallestSpacing, double angularDensity, double tolerance)
{
  if (!std::all_of(
        isovalues.begin(), isovalues.end(), [](double value) { return std::isfinite(value); }))
  {
    return { { UserMessage::Error, "An isovalue is NaN or infinite; give finite ones." } };
  }
  if (!std::isfinite(spacing) || !std::isfinite(smallestSpacing))
  {
    const std::string name = std::isfinite(spacing) ? "SmallestSpacing" : "Spacing";
    return { { UserMessage::Error,
      name + " is NaN or infinite; give a length, or 0 for the automatic one." } };
  }
  if (std::isnan(angularDensity) || std::isnan(tolerance))
  {
    return { { UserMessage::Error, "AngularDensity or Tolerance is NaN; give a number." } };
  }
  return {};
}

UserMessages checkDiagonal(double diagonal)
{
  if (std::isfinite(diagonal))
  {
    return {};
  }
  return { { UserMessage::Error,
    "The bounds of the grid are larger than the largest number, too long to compute with. Correct "
    "points that are far off, or scale the grid by Transform." } };
}

CheckedBlocks checkBlocks(const GatheredBlocks& gathered, vtkInformation* asked)
{
  CheckedBlocks checked;
  checked.messages = checkKinds(gathered, asked);
  if (checked.messages.empty())
  {
    checked.sound =
      checkLengths(findScalars(gathered, choiceOf(asked), checked.messages), checked.messages);
  }
  return checked;
}

CheckedBlocks checkQuantity(CheckedBlocks checked, Quantity quantity)
{
  checked.quantity = quantity;
  if (!needsVector(quantity) || checked.sound.empty())
  {
    return checked;
  }
  vtkDataArray* scalars = checked.sound[0].scalars;
  if (scalars->GetNumberOfComponents() != 3)
  {
    const char* name = scalars->GetName();
    checked.messages.push_back({ UserMessage::Error,
      "This Quantity needs a vector of three components; the array '" +
        std::string(name ? name : "(unnamed)") + "' has " +
        std::to_string(scalars->GetNumberOfComponents()) + ". Choose a vector with ContourBy." });
    checked.sound.clear();
  }
  return checked;
}

CheckedBlocks checkBlocks(const GatheredBlocks& gathered,
  const std::function<vtkSmartPointer<vtkDataArray>(vtkUnstructuredGrid*)>& makeScalars,
  vtkMTimeType time)
{
  CheckedBlocks checked;
  if (!gathered.others.empty())
  {
    checked.messages.push_back({ UserMessage::Warning,
      "Without particles are " + listOf(gathered.others) + ": no unstructured grid." });
  }
  std::vector<InputBlock> found;
  for (InputBlock block : gathered.blocks)
  {
    if (block.grid->GetNumberOfCells() > 0)
    {
      block.scalars = makeScalars(block.grid);
      block.scalarsTime = time;
      found.push_back(block);
    }
  }
  checked.sound = checkLengths(found, checked.messages);
  return checked;
}

} // namespace hop
