#pragma once

#include "Elements/Bernstein.h"

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

/// The constant 1.
ScaledPolynomial one(Domain domain, const Degrees& degrees);

/// Whether all coefficients are exactly zero.
bool isZero(const ScaledPolynomial& polynomial);

/// Whether some Bernstein coefficients of two polynomials of the same degrees differ by more than a tolerance.
bool differ(const ScaledPolynomial& a, const ScaledPolynomial& b, double tolerance);

/// Distance of coefficients that are neighbours on a line along an axis that is a factor of its own.
int stepAlong(const ScaledPolynomial& polynomial, int axis);

/// n over k.
/// \pre 0 <= k <= n <= 2 MaximumPolynomialDegree
double binomial(int n, int k);

} // namespace hop
