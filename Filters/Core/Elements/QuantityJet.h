#pragma once

#include "Elements/Quantity.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <array>

namespace hop
{

/// A number that depends on the place: its value and derivatives to second order.
struct ScalarJet
{
  double value = 0.0;
  glm::dvec3 gradient{ 0.0 };
  glm::dmat3 hessian{ 0.0 };
};

/// The coordinates along which the six second derivatives are taken.
constexpr std::array<std::array<int, 2>, 6> SecondDerivatives{ { { 0, 0 }, { 0, 1 }, { 0, 2 },
  { 1, 1 }, { 1, 2 }, { 2, 2 } } };

/// The sum of a_ij b_ij.
inline double sumOfProducts(const glm::dmat3& a, const glm::dmat3& b)
{
  return glm::dot(a[0], b[0]) + glm::dot(a[1], b[1]) + glm::dot(a[2], b[2]);
}

/// A quantity q of the gradient G of a field of three components, columns du/dx_j, or the quantity's square where that is
/// derived.
struct QuantityJet
{
  double value = 0.0;
  /// dq/dG_ij: q changes by the sum of slope_ij dG_ij.
  glm::dmat3 slope{ 0.0 };
  /// d2q/dG2 of the changes of G along two of three coordinates.
  glm::dmat3 bend{ 0.0 };
};

/// All is finite for every finite gradient: where two eigenvalues are equal, derivatives of lambda 2 are those of one of
/// the two sides of the crease.
/// \param quantity neither Value nor Expression
/// \param changes of the gradient along three coordinates; where they are zero, so is `bend`
QuantityJet quantityJet(
  Quantity quantity, const glm::dmat3& gradient, const std::array<glm::dmat3, 3>& changes);

} // namespace hop
