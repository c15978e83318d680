#pragma once

#include "Elements/SourceElement.h"

#include <array>
#include <vector>

namespace hop
{

/// Takes out what the derivatives along a coordinate have in common where a face of a cube, or a triangle of a wedge, is
/// collapsed: powers of t or 1 - t, t the coordinate across the face, as of the derivatives along a pyramid's base, which
/// vanish in its apex. A gradient U' X'^-1 stays the same, as columns of X' and U' are divided by one number, and its
/// determinant does not vanish in the face any more.
/// \param derivatives of the components (x, y, z, u...) along each coordinate; those along one lose the same powers
void divideByCommonFactors(
  const SourceElement& source, std::array<std::vector<ScaledPolynomial>, 3>& derivatives);

/// Whether the corners at the ends of an edge are in one place: else no face is collapsed.
bool hasCollapsedEdge(const SourceElement& source);

} // namespace hop
