#pragma once

namespace hop
{

/// What is contoured of a point array: itself, or a field made of its derivatives in world space. With the gradient
/// G_ij = du_i/dx_j of a vector u:
enum class Quantity
{
  /// A component, or the magnitude of a vector.
  Value,
  /// The length of the gradient of a component; of all components the square root of the sum of all G_ij^2.
  GradientMagnitude,
  /// The trace of G.
  Divergence,
  /// |curl u|.
  VorticityMagnitude,
  /// -tr(G G)/2: positive where rotation outweighs strain (Hunt, Wray and Moin 1988).
  QCriterion,
  /// The middle eigenvalue of S^2 + W^2, S and W the symmetric and the antisymmetric part of G: negative in the cores of
  /// vortices (Jeong and Hussain 1995).
  Lambda2,
  /// A formula of arrays and their derivatives, see FieldExpression.
  Expression
};

/// Whether a quantity is made of all three components of a vector.
constexpr bool needsVector(Quantity quantity)
{
  return quantity == Quantity::Divergence || quantity == Quantity::VorticityMagnitude ||
    quantity == Quantity::QCriterion || quantity == Quantity::Lambda2;
}

/// Whether the quantity is no quotient of polynomials, so that it is interpolated.
constexpr bool isAlwaysSampled(Quantity quantity)
{
  return quantity == Quantity::Lambda2 || quantity == Quantity::Expression;
}

/// Whether the square of the quantity is a quotient of polynomials, but not the quantity itself.
constexpr bool isSquareRoot(Quantity quantity)
{
  return quantity == Quantity::GradientMagnitude || quantity == Quantity::VorticityMagnitude;
}

/// How often lengths divide the quantity, or its square where that is derived. 0 also where that is not known.
constexpr int orderOf(Quantity quantity)
{
  const bool isNone = quantity == Quantity::Value || quantity == Quantity::Expression;
  return isNone ? 0 : quantity == Quantity::Divergence ? 1 : 2;
}

} // namespace hop
