#include "Isolation/MonotoneTest.h"

#include "Elements/LatticeRows.h"

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

} // namespace

MonotoneTest::MonotoneTest(Domain domain, const Degrees& degrees)
{
  this->listDifferences(domain, degrees);
  this->sumMean(latticePoints(domain, degrees).size());
}

void MonotoneTest::listDifferences(Domain domain, const Degrees& degrees)
{
  int start = 0;
  visitLatticeRows(domain, degrees,
    [&](int j, int k, int length)
    {
      Row& row = this->Rows.emplace_back();
      row.start = start;
      row.length = length;
      this->listDifferencesOf(domain, degrees, row, j, k);
      start += length;
    });
}

void MonotoneTest::listDifferencesOf(Domain domain, const Degrees& degrees, Row& row, int j, int k)
{
  const auto index = [&](const LatticePoint& p) { return coefficientIndex(domain, degrees, p); };
  const std::array<int, 3> numbers{ 0, j, k };
  for (int axis = 0; axis < 3; ++axis)
  {
    row.begin[axis] = static_cast<int>(this->Differences.size());
    const SimplexFactor& factor = factorOf(domain, axis);
    int rest = degrees[axis]; // alpha_0, but for i where the row runs in this simplex
    for (int m = factor.axis; m < factor.end(); ++m)
    {
      rest -= numbers[m];
      // alpha_m is i along the row, which begins with zero, else the same in all of it.
      const int first = m == 0 ? 1 : 0;
      const int alpha = m == 0 ? 1 : numbers[m];
      if (alpha > 0 && first < row.length)
      {
        const LatticePoint lower = shifted({ first, j, k }, m, -1);
        this->Differences.push_back({ first, row.length - first, index(shifted(lower, axis, 1)),
          index(lower), double(alpha), m == 0 ? 1.0 : 0.0 });
      }
    }
    const bool isAlongRow = factor.axis == 0;
    const int count = isAlongRow ? row.length - 1 : row.length;
    if (rest > 0 && count > 0)
    {
      this->Differences.push_back({ 0, count, index(shifted({ 0, j, k }, axis, 1)),
        index({ 0, j, k }), double(rest), isAlongRow ? -1.0 : 0.0 });
    }
  }
  row.begin[3] = static_cast<int>(this->Differences.size());
}

void MonotoneTest::sumMean(std::size_t points)
{
  this->Mean.resize(points, glm::dvec3(0.0));
  for (const Row& row : this->Rows)
  {
    for (int i = 0; i < row.length; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        for (int d = row.begin[axis]; d < row.begin[axis + 1]; ++d)
        {
          const Difference& difference = this->Differences[d];
          const int n = i - difference.first;
          if (n >= 0 && n < difference.count)
          {
            const double weight = difference.constant + difference.slope * n;
            this->Mean[difference.plus + n][axis] += weight;
            this->Mean[difference.minus + n][axis] -= weight;
          }
        }
      }
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
  Slopes slopes;
  for (const Row& row : this->Rows)
  {
    this->findSlopes(values, row, slopes);
    for (int i = 0; i < row.length; ++i)
    {
      const double value = values[row.start + i];
      const double rise = glm::dot(slopes.at(i), mean);
      if (rise > rounding)
      {
        rises = true;
        isSlow = isSlow || rise < slow;
        continue;
      }
      standsStillBelow = standsStillBelow || value < 0.0;
      standsStillAbove = standsStillAbove || value > 0.0;
      if (!(rise >= -rounding) || !(std::abs(value) > smallest) ||
        (standsStillBelow && standsStillAbove))
      {
        return Monotony::None;
      }
    }
  }
  const bool isWeak = isSlow || standsStillBelow || standsStillAbove;
  return !rises ? Monotony::None : isWeak ? Monotony::Weak : Monotony::Strict;
}

std::vector<double> MonotoneTest::derivative(
  const std::vector<double>& values, const glm::dvec3& direction) const
{
  std::vector<double> result(values.size());
  Slopes slopes;
  for (const Row& row : this->Rows)
  {
    this->findSlopes(values, row, slopes);
    for (int i = 0; i < row.length; ++i)
    {
      result[row.start + i] = glm::dot(slopes.at(i), direction);
    }
  }
  return result;
}

/// Term by term, so that a row's coefficients are computed side by side.
void MonotoneTest::findSlopes(
  const std::vector<double>& values, const Row& row, Slopes& slopes) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    double* along = slopes.along[axis].data();
    std::fill_n(along, row.length, 0.0);
    for (int d = row.begin[axis]; d < row.begin[axis + 1]; ++d)
    {
      const Difference& difference = this->Differences[d];
      const double* plus = values.data() + difference.plus;
      const double* minus = values.data() + difference.minus;
      double* to = along + difference.first;
      for (int n = 0; n < difference.count; ++n)
      {
        to[n] += (difference.constant + difference.slope * n) * (plus[n] - minus[n]);
      }
    }
  }
}

} // namespace hop
