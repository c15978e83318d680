#pragma once

#include "Elements/ScaledPolynomial.h"

namespace hop
{

/// A polynomial with the lowest degrees that hold it. Along lines of the domain each step is the best one in the sense of
/// least squares: it takes away the Legendre polynomial of the highest degree. On triangles and tetrahedra steps
/// are taken only where the polynomial is of a lower degree.
/// \param tolerance largest change of a Bernstein coefficient in a step, and so of any value
ScaledPolynomial lowered(ScaledPolynomial polynomial, double tolerance);

/// The derivative along an axis: its degree is one less in the simplex in which the axis runs. Zero, of degree 0 there,
/// if that degree is 0.
/// \param axis 0, 1 or 2
ScaledPolynomial derivative(const ScaledPolynomial& polynomial, int axis);

} // namespace hop
