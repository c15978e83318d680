#pragma once

#include "Elements/Bernstein.h"

#include <utility>
#include <vector>

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

/// The same polynomial with higher degrees.
/// \pre no degree is lower than the polynomial's
ScaledPolynomial elevated(ScaledPolynomial polynomial, const Degrees& degrees);

/// A polynomial with the lowest degrees that hold it. Along lines of the domain each step is the best one in the sense of
/// least squares: it takes away the Legendre polynomial of the highest degree. On triangles and tetrahedra steps
/// are taken only where the polynomial is of a lower degree.
/// \param tolerance largest change of a Bernstein coefficient in a step, and so of any value
ScaledPolynomial lowered(ScaledPolynomial polynomial, double tolerance);

/// The derivative along an axis: its degree is one less in the simplex in which the axis runs. Zero, of degree 0 there,
/// if that degree is 0.
/// \param axis 0, 1 or 2
ScaledPolynomial derivative(const ScaledPolynomial& polynomial, int axis);

/// The sum of factors times polynomials, with the lowest degrees that all of them have room in. Polynomials that are
/// zero throughout are left out; of these alone the sum is zero, of degree 0.
/// \pre all live on one domain; there is one term at least
ScaledPolynomial sumOf(const std::vector<std::pair<double, const ScaledPolynomial*>>& terms);

/// Whether all coefficients are exactly zero.
bool isZero(const ScaledPolynomial& polynomial);

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
