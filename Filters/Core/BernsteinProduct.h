#pragma once

#include "Bernstein.h"

namespace hop
{

/// The element whose field is the squared magnitude of a vector field: twice the degrees, with the
/// geometry elevated to them.
/// \param width 3 + number of the vector's components
/// \param control coefficientCount x width values: (x, y, z, v...), homogeneous if rational
/// \param weights coefficientCount weights, ones if the element is not rational
/// \param result room for the coefficients of the doubled degrees; homogeneous if rational
/// \return the weights that belong to them: those of w^2
std::vector<double> squareField(Domain domain, const Degrees& degrees, int width,
  const std::vector<double>& control, const std::vector<double>& weights, Coefficient* result);

} // namespace hop
