#include "Run/RunScale.h"

#include "Conversion/RunUnits.h"
#include "Run/Ranks.h"

#include "vtkBoundingBox.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hop
{

namespace
{

/// Spacings in units of the longest side of the bounds.
struct SpacingPerSide
{
  /// Where no spacing is given; chosen by experiment. Half of it means up to four times the particles.
  static constexpr double Automatic = 0.01;
  /// The most that is passed on; chosen by experiment. Larger spacings change nothing, as every component of the
  /// surface has its least number of particles long before; squares of much larger ones are not finite.
  static constexpr double Largest = 1e3;
  /// The least that is passed on: smaller ones ask for as many particles as this one, more than any memory holds.
  static constexpr double Least = 1e-300;
};

/// The smallest tolerance, in units of the rounding error of the largest coordinate: coordinates cannot say that a
/// point is nearer to the surface. Where it is smaller Newton's method may not get there; chosen by experiment.
constexpr double leastToleranceInRoundings = 4.0;

vtkBoundingBox boundsOf(const std::vector<InputBlock>& blocks)
{
  vtkBoundingBox box;
  for (const InputBlock& block : blocks)
  {
    if (block.grid->GetNumberOfPoints() > 0)
    {
      box.AddBox(finiteBounds(block.grid));
    }
  }
  return box;
}

/// The diagonal of a box, in a unit in which squares of its sides do not overflow.
double diagonalOf(const vtkBoundingBox& box, double unit)
{
  double sides[3];
  box.GetLengths(sides);
  for (double& side : sides)
  {
    side /= unit;
  }
  return std::sqrt(sides[0] * sides[0] + sides[1] * sides[1] + sides[2] * sides[2]);
}

/// The largest absolute value of a coordinate.
double farthestOf(const vtkBoundingBox& box)
{
  double lower[3], upper[3];
  box.GetMinPoint(lower);
  box.GetMaxPoint(upper);
  const auto farther = [](double a, double b) { return std::max(a, std::abs(b)); };
  return std::accumulate(
    upper, upper + 3, std::accumulate(lower, lower + 3, 0.0, farther), farther);
}

} // namespace

RunScale findScale(const std::vector<InputBlock>& blocks, double spacing, double tolerance)
{
  const vtkBoundingBox box = overAllRanks(boundsOf(blocks));
  RunScale scale;
  if (box.IsValid())
  {
    scale.unit = unitOf(box.GetMaxLength());
    const double side = box.GetMaxLength() / scale.unit;
    scale.spacing = spacing > 0.0
      ? std::clamp(spacing / scale.unit, SpacingPerSide::Least, SpacingPerSide::Largest * side)
      : SpacingPerSide::Automatic * side;
    scale.diagonal = diagonalOf(box, scale.unit);
    scale.tolerance = std::max(tolerance * scale.diagonal,
      leastToleranceInRoundings * std::numeric_limits<double>::epsilon() * farthestOf(box) /
        scale.unit);
  }
  return scale;
}

} // namespace hop
