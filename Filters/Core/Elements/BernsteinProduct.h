#pragma once

#include "Elements/Bernstein.h"

namespace hop
{

/// A polynomial over a domain in the *scaled* Bernstein basis: every coefficient times the binomial or
/// multinomial factor of its basis function. In this basis products are plain convolutions (Sanchez-Reyes 2003,
/// Algebraic manipulation in the Bernstein form made simple via convolutions).
/// Derivation: Documentation/algorithm.md, section Elements.
struct ScaledPolynomial
{
  Domain domain = Domain::Hexahedron;
  /// >= 0.
  Degrees degrees{ 0, 0, 0 };
  /// coefficientCount(domain, degrees) values, in the order of coefficientIndex.
  std::vector<double> values;
};

/// From Bernstein coefficients, in the order of coefficientIndex.
ScaledPolynomial scaled(Domain domain, const Degrees& degrees, std::vector<double> coefficients);

/// Back to Bernstein coefficients. The coefficients of a product of two polynomials are averages of products of the
/// polynomials' coefficients, so that rounding errors are of the order of eps times the largest of these products.
std::vector<double> unscaled(ScaledPolynomial polynomial);

/// The product; its degrees are the sums of the factors' degrees.
/// \pre both live on one domain
ScaledPolynomial operator*(const ScaledPolynomial& a, const ScaledPolynomial& b);

/// sum += factor * a * b.
/// \pre `sum` has the degrees of the product
void addProduct(
  double factor, const ScaledPolynomial& a, const ScaledPolynomial& b, ScaledPolynomial& sum);

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
