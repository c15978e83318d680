#pragma once

#include "Elements/Bernstein.h"

namespace hop
{

/// How a field comes near to zero where it has one sign at the corners.
enum class Approach
{
  /// It has the other sign somewhere.
  Crosses,
  /// It comes to zero, as far as can be told, and not beyond.
  Tangent,
  /// Neither was found.
  Apart
};

/// Looks for the place around the middle where the field has less of its sign than nearby, by Cauchy's steps
/// along the gradient: one of length |g|^2/(g.Hg) ends there where the field is a square of a distance.
/// What remains there counts as zero if it is less than a millionth of the largest coefficient. Two sheets
/// that are farther apart than a five-hundredth of the domain are not taken for one that touches. Where the
/// field is that small at a corner, and so is its gradient, it touches there.
/// \param sign of the field at the corners, 1 or -1
Approach approachToZero(const BernsteinForm& form, double sign);

} // namespace hop
