#pragma once

#include "Kernel/Kernels.h"
#include "Kernel/Simd.h"

// Local to the file that includes it, see Simd.h.
namespace hop::kernel
{
namespace
{

/// Adds some columns of the products of rows: `Vectors` vectors of `Lanes` from column `first` on.
template <int Lanes, int Vectors>
inline void addColumns(const RowPair* pairs, std::ptrdiff_t count, int first, double* sum)
{
  using Doubles = Vector<double, Lanes>;
  Doubles even[Vectors];
  Doubles odd[Vectors] = {};
  std::memcpy(even, sum + first, sizeof(even));
  const auto add = [&](Doubles(&to)[Vectors], double factor, const double* right)
  {
    for (int v = 0; v < Vectors; ++v)
    {
      to[v] += factor * load<Doubles>(right + v * Lanes);
    }
  };
  for (const RowPair* pair = pairs; pair != pairs + count; ++pair)
  {
    // Each sum waits for its last addition: two sets of them, for numbers of the left row in turns.
    const double* right = pair->right + first;
    int i = 0;
    for (; i + 1 < pair->leftCount; i += 2)
    {
      add(even, pair->left[i], right - i);
      add(odd, pair->left[i + 1], right - i - 1);
    }
    if (i < pair->leftCount)
    {
      add(even, pair->left[i], right - i);
    }
  }
  for (int v = 0; v < Vectors; ++v)
  {
    store(even[v] + odd[v], sum + first + v * Lanes);
  }
}

/// See RowProductsFunction.
template <int Lanes>
void addRowProducts(const RowPair* pairs, std::ptrdiff_t count, int length, double* sum)
{
  // Two sets of sums are then half of the registers.
  constexpr int most = 4;
  int first = 0;
  for (; first + (most - 1) * Lanes < length; first += most * Lanes)
  {
    addColumns<Lanes, most>(pairs, count, first, sum);
  }
  switch ((length - first + Lanes - 1) / Lanes)
  {
    case 1:
      return addColumns<Lanes, 1>(pairs, count, first, sum);
    case 2:
      return addColumns<Lanes, 2>(pairs, count, first, sum);
    case 3:
      return addColumns<Lanes, 3>(pairs, count, first, sum);
    default:
      return;
  }
}

} // namespace
} // namespace hop::kernel
