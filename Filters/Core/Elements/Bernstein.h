#pragma once

#include "Elements/Domain.h"

#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace hop
{

/// One Bernstein coefficient of an element: the control point (x, y, z) and the field's f.
using Coefficient = glm::dvec4;

/// Value and derivatives of (x, y, z, f) with respect to the reference coordinates at one point.
struct Jet
{
  Coefficient value{ 0.0 };
  /// d/du, d/dv, d/dw
  std::array<Coefficient, 3> first{};
  /// uu, uv, uw, vv, vw, ww
  std::array<Coefficient, 6> second{};
};

/// First derivatives of f.
inline glm::dvec3 gradientOf(const Jet& jet)
{
  return { jet.first[0].w, jet.first[1].w, jet.first[2].w };
}

/// Second derivatives of f, or of another component of (x, y, z, f), as a symmetric matrix.
/// \param second a Jet's
inline glm::dmat3 hessianOf(const std::array<Coefficient, 6>& second, int component = 3)
{
  const auto entry = [&](int i) { return second[i][component]; };
  return { entry(0), entry(1), entry(2), entry(1), entry(3), entry(4), entry(2), entry(4),
    entry(5) };
}

/// A non-owning view of an element in Bernstein form: (x, y, z, f)(u) = sum_i B_i(u) coefficients_i, where B_i is the
/// product of the Bernstein polynomials of the domain's simplices (Documentation/algorithm.md, section Elements).
/// Where `weights` are given the element is rational: its coefficients are homogeneous, w (x, y, z, f), and it stands
/// for sum_i B_i coefficients_i / sum_i B_i w_i.
struct BernsteinForm
{
  Domain domain = Domain::Hexahedron;
  Degrees degrees{ 1, 1, 1 };
  /// coefficientCount(domain, degrees) coefficients, in the order of coefficientIndex.
  const Coefficient* coefficients = nullptr;
  /// One weight > 0 a coefficient; nullptr: the element is polynomial.
  const double* weights = nullptr;
};

/// Control point i: (x, y, z, f), whether the element is rational or not.
inline Coefficient controlPoint(const BernsteinForm& form, int i)
{
  return form.weights ? form.coefficients[i] / form.weights[i] : form.coefficients[i];
}

/// Value and first derivatives; `second` is left zero.
Jet evaluateGradient(const BernsteinForm& form, const ReferencePoint& u);

/// Value, first and second derivatives.
Jet evaluateHessian(const BernsteinForm& form, const ReferencePoint& u);

/// Values of all Bernstein basis functions at u.
/// \param basis room for coefficientCount(domain, degrees) values; they sum to one.
void evaluateBasis(Domain domain, const Degrees& degrees, const ReferencePoint& u, double* basis);

/// An interval of values.
struct Range
{
  double lower = 0.0;
  double upper = 0.0;

  void include(double value)
  {
    this->lower = std::min(this->lower, value);
    this->upper = std::max(this->upper, value);
  }
  /// The largest absolute value.
  double magnitude() const { return std::max(std::abs(this->lower), std::abs(this->upper)); }
};

/// Smallest and largest value that the convex hull property allows f on the element. It holds for rational elements
/// too, because their weights are positive.
Range fieldRange(const BernsteinForm& form);

/// Values of the Bernstein polynomials of degree p on a line at t, by their recurrence over the degree.
/// \param basis room for p + 1 values
void lineBasis(int p, double t, double* basis);

} // namespace hop
