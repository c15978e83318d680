#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace hop
{

/// The middle one of the three eigenvalues of a symmetric matrix, by the angle of its characteristic cubic (Smith 1961,
/// Eigenvalues of a symmetric 3 x 3 matrix). Finite for every finite matrix; where two eigenvalues are equal its error
/// is 1e-8 of the largest one, else a few roundings.
inline double middleEigenvalue(const glm::dmat3& matrix)
{
  const double mean = (matrix[0][0] + matrix[1][1] + matrix[2][2]) / 3.0;
  const glm::dmat3 rest = matrix - glm::dmat3(mean);
  const double size2 =
    (glm::dot(rest[0], rest[0]) + glm::dot(rest[1], rest[1]) + glm::dot(rest[2], rest[2])) / 6.0;
  const double size = std::sqrt(size2);
  if (!(size > 0.0))
  {
    return mean;
  }
  // The eigenvalues are mean + 2 size cos(angle + 2 pi n / 3), the angle between 0 and pi / 3.
  const double halfDeterminant = 0.5 * glm::determinant(rest / size);
  const double angle = std::acos(std::clamp(halfDeterminant, -1.0, 1.0)) / 3.0;
  constexpr double third = 2.0943951023931953;
  return mean + 2.0 * size * std::cos(angle - third);
}

} // namespace hop
