#pragma once

#include "Elements/ScaledPolynomial.h"

#include <utility>
#include <vector>

namespace hop
{

/// The product; its degrees are the sums of the factors' degrees.
/// \pre both live on one domain
ScaledPolynomial operator*(const ScaledPolynomial& a, const ScaledPolynomial& b);

/// sum += factor * a * b.
/// \pre `sum` has the degrees of the product
void addProduct(
  double factor, const ScaledPolynomial& a, const ScaledPolynomial& b, ScaledPolynomial& sum);

/// The same polynomial with higher degrees.
/// \pre no degree is lower than the polynomial's
ScaledPolynomial elevated(ScaledPolynomial polynomial, const Degrees& degrees);

/// The sum of factors times polynomials, with the lowest degrees that all of them have room in. Polynomials that are
/// zero throughout are left out; of these alone the sum is zero, of degree 0.
/// \pre all live on one domain; there is one term at least
ScaledPolynomial sumOf(const std::vector<std::pair<double, const ScaledPolynomial*>>& terms);

/// The element whose field is the squared magnitude of a vector field: twice the degrees, with the
/// geometry elevated to them.
/// \param width 3 + number of the vector's components
/// \param control coefficientCount x width values: (x, y, z, v...), homogeneous if rational
/// \param weights coefficientCount weights, ones if the element is not rational
/// \param result room for the coefficients of the doubled degrees; homogeneous if rational
/// \return the weights of the result: the coefficients of w^2
std::vector<double> squareField(Domain domain, const Degrees& degrees, int width,
  const std::vector<double>& control, const std::vector<double>& weights, Coefficient* result);

} // namespace hop
