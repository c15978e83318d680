#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace hop
{

/// Eigenvalues in ascending order, with the eigenvectors in the columns of a rotation or reflection.
struct Eigensystem
{
  glm::dvec3 values{ 0.0 };
  glm::dmat3 vectors{ 1.0 };
};

/// Of a symmetric matrix, by Jacobi's rotations: to a few roundings of the largest eigenvalue, also of equal ones. Finite
/// for every finite matrix.
inline Eigensystem eigensystemOf(const glm::dmat3& matrix)
{
  // Each sweep squares what is left beside the diagonal: five are enough for doubles.
  constexpr int sweeps = 8;
  // Of the largest entry: a hundredth of what rounding makes of an eigenvalue. Smaller: sweeps that change nothing.
  constexpr double nothing = 1e-18;
  glm::dvec3 diagonal(matrix[0][0], matrix[1][1], matrix[2][2]);
  // Each entry beside the diagonal stands where neither of its indices points to.
  glm::dvec3 beside(matrix[1][2], matrix[2][0], matrix[0][1]);
  double largest = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    largest = std::max({ largest, std::abs(diagonal[i]), std::abs(beside[i]) });
  }
  Eigensystem result;
  for (int n = 0; n < 3 * sweeps; ++n)
  {
    const int i = n % 3;
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    if (!(std::abs(beside[k]) > nothing * largest))
    {
      continue;
    }
    const double slope = (diagonal[j] - diagonal[i]) / (2.0 * beside[k]);
    const double t = std::copysign(1.0, slope) / (std::abs(slope) + std::sqrt(slope * slope + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0);
    const double s = t * c;
    diagonal[i] -= t * beside[k];
    diagonal[j] += t * beside[k];
    beside[k] = 0.0;
    const double ofI = beside[j];
    beside[j] = c * ofI - s * beside[i];
    beside[i] = s * ofI + c * beside[i];
    const glm::dvec3 axis = result.vectors[i];
    result.vectors[i] = c * axis - s * result.vectors[j];
    result.vectors[j] = s * axis + c * result.vectors[j];
  }
  std::array<int, 3> order{ 0, 1, 2 };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return diagonal[a] < diagonal[b]; });
  const glm::dmat3 vectors = result.vectors;
  for (int n = 0; n < 3; ++n)
  {
    result.values[n] = diagonal[order[n]];
    result.vectors[n] = vectors[order[n]];
  }
  return result;
}

} // namespace hop
