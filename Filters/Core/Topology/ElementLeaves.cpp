#include "Topology/ElementLeaves.h"

#include <algorithm>

namespace hop
{
namespace
{

/// How long one cell is split.
struct SplitLimits
{
  /// Coefficients of all boxes, over all levels, and between which bounds the number of boxes stays: a third of a
  /// second at most. Chosen by experiment. Larger: more elements in which sheets nearly meet are resolved, and thinner
  /// discs; smaller: elements that are singular along lines take less time.
  static constexpr std::size_t Coefficients = std::size_t{ 1 } << 23;
  static constexpr std::size_t FewestBoxes = 2048;
  static constexpr std::size_t MostBoxes = 65536;
  /// Boxes that each of several elements of a cell has at least. Smaller: derived fields have more meshes that are not
  /// proven; larger: where they are singular all over, a cell of 64 elements takes longer (seed 1075 of grid_fuzz).
  static constexpr std::size_t FewestBoxesOfPart = 256;
  /// Size of a leaf, in units of the smallest one, from which it is not split because the field is the isovalue at
  /// one of its corners, to rounding: where the surface is singular, all leaves at this corner would be like it. Smaller:
  /// fewer components pass unresolved leaves, and elements that are singular along edges or in faces take longer: 2 ms
  /// each at a 32nd, 0.1 s without this limit (topology_benchmark vtkdata_pyramid_quadratic.vtu DistanceToCenter 0.866).
  static constexpr int SizeAtZero = LeafGrid::Size / 32;

  static std::size_t boxes(std::size_t coefficients, int partsOfCell)
  {
    const std::size_t ofCell = std::clamp(Coefficients / coefficients, FewestBoxes, MostBoxes);
    return std::max(ofCell / static_cast<std::size_t>(partsOfCell), FewestBoxesOfPart);
  }
};

/// A box that is not decided yet.
struct Box
{
  Leaf leaf;
  std::vector<double> values;
};

/// Splits a polynomial over the unit cube at a place of one axis, by de Casteljau's algorithm.
/// \param values replaced by those of the lower part
/// \param upper receives those of the upper part
void splitAxis(const Degrees& degrees, int axis, double place, std::vector<double>& values,
  std::vector<double>& upper)
{
  const int stride = axis == 0 ? 1
    : axis == 1                ? degrees[0] + 1
                               : (degrees[0] + 1) * (degrees[1] + 1);
  const int degree = degrees[axis];
  const int count = static_cast<int>(values.size());
  const int block = stride * (degree + 1);
  upper = values;
  for (int start = 0; start < count; start += block)
  {
    double* const line = &upper[start];
    for (int step = 0; step <= degree; ++step)
    {
      std::copy(line, line + stride, &values[start + step * stride]);
      for (int i = 0; i < (degree - step) * stride; ++i)
      {
        line[i] = (1.0 - place) * line[i] + place * line[i + stride];
      }
    }
  }
}

/// Calls use(octant, values) for the eight octants of a box.
template <class Use>
void forOctants(const Degrees& degrees, Box& box, const Use& use)
{
  const bool isFirst = box.leaf.size == LeafGrid::Size;
  std::array<std::vector<double>, 8> values;
  values[0] = std::move(box.values);
  for (int axis = 2; axis >= 0; --axis)
  {
    const double place = isFirst ? LeafGrid::FirstSplit[axis] : 0.5;
    for (int octant = 0; octant < 8; octant += 2 << axis)
    {
      splitAxis(degrees, axis, place, values[octant], values[octant + (1 << axis)]);
    }
  }
  const int half = box.leaf.size / 2;
  for (int octant = 0; octant < 8; ++octant)
  {
    const glm::ivec3 side(octant & 1, octant >> 1 & 1, octant >> 2);
    use(Leaf{ box.leaf.lower + half * side, half, 0 }, std::move(values[octant]));
  }
}

} // namespace

glm::dvec3 LeafGrid::fromCube(const glm::dvec3& t)
{
  glm::dvec3 place;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double split = FirstSplit[axis];
    place[axis] =
      t[axis] < split ? 0.5 * t[axis] / split : 0.5 + 0.5 * (t[axis] - split) / (1.0 - split);
  }
  return static_cast<double>(Size) * place;
}

glm::dvec3 LeafGrid::toCube(const glm::dvec3& place)
{
  glm::dvec3 t = place / static_cast<double>(Size);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double split = FirstSplit[axis];
    t[axis] = t[axis] < 0.5 ? 2.0 * split * t[axis] : split + (2.0 * t[axis] - 1.0) * (1.0 - split);
  }
  return t;
}

ElementLeaves findLeaves(const ElementCube& cube, const LeafTests& tests, int partsOfCell)
{
  ElementLeaves leaves;
  std::vector<Box> level;
  std::size_t examined = 0;
  const std::size_t most = SplitLimits::boxes(cube.values.size(), partsOfCell);
  const auto examine = [&](Leaf leaf, std::vector<double> values, std::vector<Box>& undecided)
  {
    ++examined;
    const LeafSurface surface = tests.examine(values, cube.slack, leaf.signs);
    if (surface == LeafSurface::Disc)
    {
      leaves.discs.push_back(leaf);
    }
    else if (surface == LeafSurface::ZeroAtCorner && leaf.size <= SplitLimits::SizeAtZero)
    {
      leaves.unresolved.push_back(leaf);
    }
    else if (surface != LeafSurface::Empty)
    {
      undecided.push_back({ leaf, std::move(values) });
    }
  };
  examine({ glm::ivec3(0), LeafGrid::Size, 0 }, cube.values, level);
  while (!level.empty() && examined < most && level.front().leaf.size > 1)
  {
    std::vector<Box> next;
    for (Box& box : level)
    {
      forOctants(cube.degrees, box,
        [&](const Leaf& leaf, std::vector<double> values)
        { examine(leaf, std::move(values), next); });
    }
    level = std::move(next);
  }
  for (const Box& box : level)
  {
    leaves.unresolved.push_back(box.leaf);
  }
  return leaves;
}

} // namespace hop
