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
inline Eigensystem eigensystemOf(glm::dmat3 matrix)
{
  // Each sweep squares what is left beside the diagonal: five are enough for doubles.
  constexpr int sweeps = 8;
  // Of the largest entry: a hundredth of what rounding makes of an eigenvalue. Smaller: sweeps that change nothing.
  constexpr double nothing = 1e-18;
  double largest = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      largest = std::max(largest, std::abs(matrix[i][j]));
    }
  }
  Eigensystem result;
  for (int n = 0; n < 3 * sweeps; ++n)
  {
    const int i = n % 3;
    const int j = (i + 1) % 3;
    if (!(std::abs(matrix[i][j]) > nothing * largest))
    {
      continue;
    }
    const double slope = (matrix[j][j] - matrix[i][i]) / (2.0 * matrix[i][j]);
    const double t = std::copysign(1.0, slope) / (std::abs(slope) + std::sqrt(slope * slope + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0);
    glm::dmat3 rotation(1.0);
    rotation[i][i] = rotation[j][j] = c;
    rotation[j][i] = t * c;
    rotation[i][j] = -t * c;
    matrix = glm::transpose(rotation) * matrix * rotation;
    result.vectors = result.vectors * rotation;
  }
  std::array<int, 3> order{ 0, 1, 2 };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return matrix[a][a] < matrix[b][b]; });
  const glm::dmat3 vectors = result.vectors;
  for (int n = 0; n < 3; ++n)
  {
    result.values[n] = matrix[order[n]][order[n]];
    result.vectors[n] = vectors[order[n]];
  }
  return result;
}

} // namespace hop
