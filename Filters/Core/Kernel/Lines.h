#pragma once

#include "Kernel/Kernels.h"
#include "Kernel/Simd.h"

// Local to the file that includes it, see Simd.h.
namespace hop::kernel
{
namespace
{

/// See BisectionFunction.
/// \tparam Lanes components in a vector
template <int Lanes>
void bisectLines(const Lines& lines, double* coefficients, double* second)
{
  using Doubles = Vector<double, Lanes>;
  constexpr int parts = 4 / Lanes;
  Doubles line[parts * (MaximumDegree + 1)];
  const auto read = [&](int i, const double* from)
  { std::memcpy(line + parts * i, from, 4 * sizeof(double)); };
  const auto write = [&](int i, double* to)
  { std::memcpy(to, line + parts * i, 4 * sizeof(double)); };
  for (std::ptrdiff_t l = 0; l < lines.count; ++l)
  {
    const std::int32_t* where = lines.index + lines.begin[l];
    const int n = lines.begin[l + 1] - lines.begin[l];
    for (int i = 0; i < n; ++i)
    {
      read(i, coefficients + 4 * where[i]);
    }
    for (int left = n - 1; left >= 0; --left)
    {
      write(0, coefficients + 4 * where[n - 1 - left]);
      for (int k = 0; k < parts * left; ++k)
      {
        line[k] = 0.5 * (line[k] + line[k + parts]);
      }
    }
    for (int i = 0; i < n; ++i)
    {
      write(i, second + 4 * where[i]);
    }
  }
}

/// Bisects up to `Lanes` lines of n numbers, one a lane.
/// \param where the lines, of which all lanes have one: some twice where there are fewer
template <int Lanes>
inline void bisectTogether(
  const std::int32_t* const (&where)[Lanes], int n, double* numbers, double* second)
{
  using Doubles = Vector<double, Lanes>;
  Doubles line[2 * MaximumDegree + 1];
  double lanes[Lanes];
  const auto write = [&](Doubles values, int i, double* to)
  {
    store(values, lanes);
    for (int lane = 0; lane < Lanes; ++lane)
    {
      to[where[lane][i]] = lanes[lane];
    }
  };
  for (int i = 0; i < n; ++i)
  {
    for (int lane = 0; lane < Lanes; ++lane)
    {
      lanes[lane] = numbers[where[lane][i]];
    }
    line[i] = load<Doubles>(lanes);
  }
  for (int left = n - 1; left >= 0; --left)
  {
    write(line[0], n - 1 - left, numbers);
    for (int k = 0; k < left; ++k)
    {
      line[k] = 0.5 * (line[k] + line[k + 1]);
    }
  }
  for (int i = 0; i < n; ++i)
  {
    write(line[i], i, second);
  }
}

/// See NumberBisectionFunction. Lines of the same length go together.
template <int Lanes>
void bisectNumbers(const Lines& lines, double* numbers, double* second)
{
  const auto lengthOf = [&](std::ptrdiff_t l) { return lines.begin[l + 1] - lines.begin[l]; };
  for (std::ptrdiff_t first = 0; first < lines.count;)
  {
    const int n = lengthOf(first);
    const std::int32_t* where[Lanes];
    std::ptrdiff_t next = first;
    for (int lane = 0; lane < Lanes; ++lane)
    {
      const bool isAlike = next < lines.count && lengthOf(next) == n;
      where[lane] = isAlike ? lines.index + lines.begin[next] : where[0];
      next += isAlike ? 1 : 0;
    }
    bisectTogether<Lanes>(where, n, numbers, second);
    first = next;
  }
}

/// See BoundsFunction.
/// \tparam Lanes components in a vector
template <int Lanes>
ComponentBounds boundComponents(const double* coefficients, std::ptrdiff_t count)
{
  using Doubles = Vector<double, Lanes>;
  constexpr int parts = 4 / Lanes;
  // Each least waits for the one before: four in a row that do not.
  constexpr int rows = 4;
  Doubles lower[rows][parts];
  Doubles upper[rows][parts];
  for (auto* both : { lower, upper })
  {
    for (int row = 0; row < rows; ++row)
    {
      std::memcpy(both[row], coefficients, sizeof(lower[row]));
    }
  }
  const auto include = [&](int row, std::ptrdiff_t i)
  {
    for (int part = 0; part < parts; ++part)
    {
      const Doubles x = load<Doubles>(coefficients + 4 * i + part * Lanes);
      lower[row][part] = least(x, lower[row][part]);
      upper[row][part] = greatest(x, upper[row][part]);
    }
  };
  std::ptrdiff_t i = 0;
  for (; i + rows <= count; i += rows)
  {
    for (int row = 0; row < rows; ++row)
    {
      include(row, i + row);
    }
  }
  for (; i < count; ++i)
  {
    include(0, i);
  }
  for (int row = 1; row < rows; ++row)
  {
    for (int part = 0; part < parts; ++part)
    {
      lower[0][part] = least(lower[0][part], lower[row][part]);
      upper[0][part] = greatest(upper[0][part], upper[row][part]);
    }
  }
  ComponentBounds bounds;
  std::memcpy(bounds.lower, lower[0], sizeof(bounds.lower));
  std::memcpy(bounds.upper, upper[0], sizeof(bounds.upper));
  return bounds;
}

} // namespace
} // namespace hop::kernel
