#include "Isolation/MonotoneTest.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// How the signs of a derivative are judged.
struct Judgement
{
  /// Rounding errors of differences, as a share of the largest value times the largest degree, which is the largest
  /// factor of a difference: some hundred times the rounding errors of doubles, as bisections add up theirs. A smaller
  /// share takes noise for a slope, a larger one takes gentle slopes for noise.
  static constexpr double Rounding = 1e-13;
  /// |value| at least where the derivative is zero, as a share of the largest value. Chosen by experiment: a smaller
  /// share takes the tangency at a wall for a sheet, a larger one splits boxes beside walls in vain.
  static constexpr double NotZero = 1e-6;
  /// Derivative at least, as a share of its mean, for Monotony::Strict. Larger shares made particles of small
  /// surfaces of a given number stand unevenly; smaller ones let the surface bend much in a box of any size.
  static constexpr double Slow = 1e-3;
};

LatticePoint shifted(const LatticePoint& point, int axis, int by)
{
  return { point.i + (axis == 0 ? by : 0), point.j + (axis == 1 ? by : 0),
    point.k + (axis == 2 ? by : 0) };
}

int along(const LatticePoint& point, int axis)
{
  return axis == 0 ? point.i : axis == 1 ? point.j : point.k;
}

} // namespace

MonotoneTest::MonotoneTest(Domain domain, const Degrees& degrees)
{
  this->listDifferences(domain, degrees);
  this->sumMean(latticePoints(domain, degrees).size());
}

void MonotoneTest::listDifferences(Domain domain, const Degrees& degrees)
{
  const auto index = [&](const LatticePoint& p) { return coefficientIndex(domain, degrees, p); };
  for (const LatticePoint& point : latticePoints(domain, degrees))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Begin.push_back(static_cast<int>(this->Differences.size()));
      int rest = degrees[axis]; // alpha_0
      const SimplexFactor& factor = factorOf(domain, axis);
      for (int m = factor.axis; m < factor.end(); ++m)
      {
        const int alpha = along(point, m);
        rest -= alpha;
        if (alpha > 0)
        {
          const LatticePoint lower = shifted(point, m, -1);
          this->Differences.push_back(
            { index(shifted(lower, axis, 1)), index(lower), static_cast<double>(alpha) });
        }
      }
      if (rest > 0)
      {
        this->Differences.push_back(
          { index(shifted(point, axis, 1)), index(point), static_cast<double>(rest) });
      }
    }
  }
  this->Begin.push_back(static_cast<int>(this->Differences.size()));
}

void MonotoneTest::sumMean(std::size_t points)
{
  this->Mean.resize(points, glm::dvec3(0.0));
  for (std::size_t n = 0; n + 1 < this->Begin.size(); ++n)
  {
    const int axis = static_cast<int>(n % 3);
    for (int d = this->Begin[n]; d < this->Begin[n + 1]; ++d)
    {
      const Difference& difference = this->Differences[d];
      this->Mean[difference.plus][axis] += difference.weight;
      this->Mean[difference.minus][axis] -= difference.weight;
    }
  }
}

Monotony MonotoneTest::monotony(const std::vector<double>& values) const
{
  glm::dvec3 mean(0.0);
  double largest = 0.0;
  for (std::size_t point = 0; point < values.size(); ++point)
  {
    mean += values[point] * this->Mean[point];
    largest = std::max(largest, std::abs(values[point]));
  }
  const double length = glm::length(mean);
  if (!(length > 0.0))
  {
    return Monotony::None;
  }
  const double rounding = Judgement::Rounding * largest * MaximumDegree * length;
  const double smallest = Judgement::NotZero * largest;
  const double slow = Judgement::Slow * length * length / static_cast<double>(values.size());
  bool rises = false;
  bool isSlow = false;
  bool standsStillBelow = false;
  bool standsStillAbove = false;
  for (std::size_t point = 0; point < values.size(); ++point)
  {
    const double rise = glm::dot(this->gradient(values, point), mean);
    if (rise > rounding)
    {
      rises = true;
      isSlow = isSlow || rise < slow;
      continue;
    }
    standsStillBelow = standsStillBelow || values[point] < 0.0;
    standsStillAbove = standsStillAbove || values[point] > 0.0;
    if (!(rise >= -rounding) || !(std::abs(values[point]) > smallest) ||
      (standsStillBelow && standsStillAbove))
    {
      return Monotony::None;
    }
  }
  const bool isWeak = isSlow || standsStillBelow || standsStillAbove;
  return !rises ? Monotony::None : isWeak ? Monotony::Weak : Monotony::Strict;
}

std::vector<double> MonotoneTest::derivative(
  const std::vector<double>& values, const glm::dvec3& direction) const
{
  std::vector<double> result(values.size());
  for (std::size_t point = 0; point < values.size(); ++point)
  {
    result[point] = glm::dot(this->gradient(values, point), direction);
  }
  return result;
}

glm::dvec3 MonotoneTest::gradient(const std::vector<double>& values, std::size_t point) const
{
  glm::dvec3 result(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int d = this->Begin[3 * point + axis]; d < this->Begin[3 * point + axis + 1]; ++d)
    {
      const Difference& difference = this->Differences[d];
      result[axis] += difference.weight * (values[difference.plus] - values[difference.minus]);
    }
  }
  return result;
}

} // namespace hop
