#pragma once

#include "Kernel/Kernels.h"
#include "Kernel/Simd.h"

// Local to the file that includes it, see Simd.h.
namespace hop::kernel
{
namespace
{

/// `Rows` rows of a matrix times some neighbouring columns of values: vectors, or single numbers. So many sums at a time
/// that none waits for its last addition.
template <class Number, int Rows>
inline void multiplyColumns(
  const double* matrix, int columns, const double* values, std::ptrdiff_t width, double* result)
{
  Number sum[Rows] = {};
  for (int column = 0; column < columns; ++column)
  {
    const auto value = load<Number>(values + column * width);
    for (int row = 0; row < Rows; ++row)
    {
      sum[row] += matrix[row * columns + column] * value;
    }
  }
  for (int row = 0; row < Rows; ++row)
  {
    store(sum[row], result + row * width);
  }
}

/// \tparam Lanes columns of values at a time; of those that are left fewer
template <int Lanes, int Rows>
inline void multiplyRows(const double* matrix, int columns, const double* values,
  std::ptrdiff_t width, double* result, std::ptrdiff_t first = 0)
{
  for (; first + Lanes <= width; first += Lanes)
  {
    multiplyColumns<Vector<double, Lanes>, Rows>(
      matrix, columns, values + first, width, result + first);
  }
  if constexpr (Lanes > 1)
  {
    multiplyRows<Lanes / 2, Rows>(matrix, columns, values, width, result, first);
  }
}

/// See MatrixFunction.
template <int Lanes>
void multiplyMatrix(const double* matrix, int rows, int columns, const double* values,
  std::ptrdiff_t width, double* result)
{
  constexpr int together = 8;
  int row = 0;
  for (; row + together <= rows; row += together)
  {
    multiplyRows<Lanes, together>(
      matrix + row * columns, columns, values, width, result + row * width);
  }
  for (; row + 2 <= rows; row += 2)
  {
    multiplyRows<Lanes, 2>(matrix + row * columns, columns, values, width, result + row * width);
  }
  if (row < rows)
  {
    multiplyRows<Lanes, 1>(matrix + row * columns, columns, values, width, result + row * width);
  }
}

} // namespace
} // namespace hop::kernel
