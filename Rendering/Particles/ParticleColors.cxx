#include "Particles/ParticleColors.h"

#include "vtkFloatArray.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{
// Second lookup coordinate from which on vtkMapper means a value that is no number: the table is in the lower half of
// VTK's texture of two rows, at 0.25, the colour of values that are no numbers in the upper one, at 0.75 or more.
constexpr float NoNumber = 0.75f;
}

//------------------------------------------------------------------------------
std::vector<unsigned char> GatherColors(
  vtkUnsignedCharArray* colors, const std::vector<vtkIdType>& ids, vtkIdType count)
{
  if (!colors || colors->GetNumberOfComponents() != 4 || colors->GetNumberOfTuples() == 0 ||
    static_cast<vtkIdType>(ids.size()) < count)
  {
    return {};
  }
  const vtkIdType last = colors->GetNumberOfTuples() - 1;
  std::vector<unsigned char> rgba(4 * count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    colors->GetTypedTuple(std::min(ids[i], last), &rgba[4 * i]);
  }
  return rgba;
}

//------------------------------------------------------------------------------
void ReplaceColors(std::vector<unsigned char>& rgba, vtkDataArray* cellColors,
  const std::vector<vtkIdType>& cellIds, vtkIdType count, vtkProperty* property)
{
  const auto byte = [](double value)
  { return static_cast<unsigned char>(std::lround(255. * std::clamp(value, 0., 1.))); };
  const bool mapped = !rgba.empty();
  rgba.resize(4 * count, 255);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double own[4];
    cellColors->GetTuple(cellIds[i], own);
    const double* color = own[0] <= 1. ? own : property->GetDiffuseColor();
    if (own[0] <= 1. || !mapped)
    {
      std::transform(color, color + 3, &rgba[4 * i], byte);
    }
    const double opacity = own[3] <= 1. ? own[3] : property->GetOpacity();
    rgba[4 * i + 3] = byte(opacity * rgba[4 * i + 3] / 255.);
  }
}

//------------------------------------------------------------------------------
std::vector<float> LookupTexels(
  vtkFloatArray* coordinates, const std::vector<vtkIdType>& pointIds, vtkIdType count)
{
  const vtkIdType last = coordinates->GetNumberOfTuples() - 1;
  std::vector<float> texels(4 * count, 0.f);
  for (vtkIdType i = 0; i < count; ++i)
  {
    float coordinate[2] = { 0.f, 0.f };
    coordinates->GetTypedTuple(std::min(pointIds[i], last), coordinate);
    if (coordinate[1] < NoNumber)
    {
      texels[4 * i] = coordinate[0];
      texels[4 * i + 1] = 1.f;
    }
  }
  return texels;
}

//------------------------------------------------------------------------------
std::vector<float> BrightnessOf(const std::vector<unsigned char>& rgba)
{
  std::vector<float> brightness(rgba.size() / 4);
  for (std::size_t i = 0; i < brightness.size(); ++i)
  {
    // The weights of ITU-R BT.601: colours that differ have, as a rule, another brightness.
    brightness[i] =
      (0.299f * rgba[4 * i] + 0.587f * rgba[4 * i + 1] + 0.114f * rgba[4 * i + 2]) / 255.f;
  }
  return brightness;
}

std::vector<float> PositionsOf(const std::vector<float>& lookupTexels)
{
  std::vector<float> positions(lookupTexels.size() / 4);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    positions[i] = lookupTexels[4 * i + 1] == 1.f ? lookupTexels[4 * i]
                                                  : std::numeric_limits<float>::quiet_NaN();
  }
  return positions;
}
}
