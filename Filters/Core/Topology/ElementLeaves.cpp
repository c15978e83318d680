#include "Topology/ElementLeaves.h"

#include <algorithm>
#include <iterator>

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

  /// The share of the boxes that findFewLeaves() looks at: a fiftieth of a second. Larger: the caller waits longer for one
  /// element; smaller: more elements are begun twice.
  static constexpr std::size_t ShareOfFew = 16;

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

/// What examining boxes has given, in their order.
struct ExaminedBoxes
{
  ElementLeaves leaves;
  std::vector<Box> undecided;
};

/// Moves the elements of a list to the end of another one.
template <class Item>
void moveToEnd(std::vector<Item>& from, std::vector<Item>& to)
{
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// Splits an element's cube, one level of the octree after the other.
class LeafSearch
{
public:
  LeafSearch(const ElementCube& cube, const LeafTests& tests)
    : Cube(cube)
    , Tests(tests)
  {
    this->examine({ glm::ivec3(0), LeafGrid::Size, 0 }, cube.values, this->Found);
    this->Examined = 1;
  }

  /// Whether no box is undecided, or all that are so are of the smallest size.
  bool isDone() const
  {
    return this->Found.undecided.empty() || this->Found.undecided.front().leaf.size == 1;
  }

  /// How many boxes have been looked at.
  std::size_t examined() const { return this->Examined; }

  /// Splits all boxes that are undecided. Finds the same for any number of threads.
  void splitAll(const ParallelFor& parallelFor)
  {
    std::vector<Box> level = std::move(this->Found.undecided);
    this->Found.undecided.clear();
    std::vector<ExaminedBoxes> parts(level.size()); // each where its first box is
    runParallel(parallelFor, static_cast<std::ptrdiff_t>(level.size()),
      [&](std::ptrdiff_t begin, std::ptrdiff_t end)
      {
        for (std::ptrdiff_t n = begin; n < end; ++n)
        {
          forOctants(this->Cube.degrees, level[n],
            [&](const Leaf& leaf, std::vector<double> values)
            { this->examine(leaf, std::move(values), parts[begin]); });
        }
      });
    for (ExaminedBoxes& part : parts)
    {
      moveToEnd(part.leaves.discs, this->Found.leaves.discs);
      moveToEnd(part.leaves.unresolved, this->Found.leaves.unresolved);
      moveToEnd(part.undecided, this->Found.undecided);
    }
    this->Examined += 8 * level.size();
  }

  /// What has been found; nothing is proven of boxes that are still undecided. To be called once.
  ElementLeaves leaves()
  {
    for (const Box& box : this->Found.undecided)
    {
      this->Found.leaves.unresolved.push_back(box.leaf);
    }
    return std::move(this->Found.leaves);
  }

private:
  void examine(Leaf leaf, std::vector<double> values, ExaminedBoxes& boxes) const
  {
    const LeafSurface surface = this->Tests.examine(values, this->Cube.slack, leaf.signs);
    if (surface == LeafSurface::Disc)
    {
      boxes.leaves.discs.push_back(leaf);
    }
    else if (surface == LeafSurface::ZeroAtCorner && leaf.size <= SplitLimits::SizeAtZero)
    {
      boxes.leaves.unresolved.push_back(leaf);
    }
    else if (surface != LeafSurface::Empty)
    {
      boxes.undecided.push_back({ leaf, std::move(values) });
    }
  }

  const ElementCube& Cube;
  const LeafTests& Tests;
  ExaminedBoxes Found;
  std::size_t Examined = 0;
};

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

ElementLeaves findLeaves(
  const ElementCube& cube, const LeafTests& tests, int partsOfCell, const ParallelFor& parallelFor)
{
  const std::size_t most = SplitLimits::boxes(cube.values.size(), partsOfCell);
  LeafSearch search(cube, tests);
  while (!search.isDone() && search.examined() < most)
  {
    search.splitAll(parallelFor);
  }
  return search.leaves();
}

std::optional<ElementLeaves> findFewLeaves(
  const ElementCube& cube, const LeafTests& tests, int partsOfCell)
{
  const std::size_t most =
    SplitLimits::boxes(cube.values.size(), partsOfCell) / SplitLimits::ShareOfFew;
  LeafSearch search(cube, tests);
  while (!search.isDone())
  {
    if (search.examined() >= most)
    {
      return std::nullopt;
    }
    search.splitAll({});
  }
  return search.leaves();
}

} // namespace hop
