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
