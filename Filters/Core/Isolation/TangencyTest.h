#pragma once

#include "Elements/Bernstein.h"

namespace hop
{

/// How a field that has one sign at the corners approaches zero.
/// Derivation: Documentation/algorithm.md, section Isolation.
enum class Approach
{
  /// The field has the other sign somewhere.
  Crosses,
  /// The field comes to zero, up to the accuracy of the test, and not beyond.
  Tangent,
  /// The field was found neither to cross zero nor to be tangent to it.
  Apart
};

/// Searches for the minimum of |F - c| near the middle of the domain, by Cauchy steps of length |g|^2/(g.Hg) along the
/// gradient g, H being the Hessian: where the field is the square of a distance, one step ends at the minimum. The
/// minimum counts as zero if it is less than a millionth of the largest coefficient: two sheets farther apart than a
/// five-hundredth of the domain are not taken for a tangency. A field that is that small at a corner, together with its
/// gradient, is tangent to zero there.
/// \param form of F - c
/// \param sign of the field at the corners, 1 or -1
Approach approachToZero(const BernsteinForm& form, double sign);

} // namespace hop
