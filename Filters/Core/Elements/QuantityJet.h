#pragma once

#include "Elements/Quantity.h"

#include <glm/mat3x3.hpp>

#include <array>

namespace hop
{

/// The gradient of a field of three components, columns du/dx_j, with its derivatives along three coordinates.
struct GradientJet
{
  glm::dmat3 value{ 0.0 };
  std::array<glm::dmat3, 3> first{};
  /// uu, uv, uw, vv, vw, ww
  std::array<glm::dmat3, 6> second{};
};

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

/// A quantity, or its square where that is derived, with its derivatives by the chain rule; where the second ones of the
/// gradient are left zero those of the quantity mean nothing. All are finite for every finite gradient: where two
/// eigenvalues are equal, derivatives of lambda 2 are those of one of the two sides of the crease.
/// \param quantity neither Value nor Expression
ScalarJet quantityJet(Quantity quantity, const GradientJet& gradient);

} // namespace hop
