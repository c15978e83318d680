#pragma once

#include "Elements/Quantity.h"
#include "Elements/SourceElement.h"

#include <array>
#include <vector>

namespace hop
{

/// What the polynomials of a derived element are for.
enum class StandIn
{
  /// Particles stand on them: they are the field to rounding, or the best that is found.
  Surface,
  /// The surface is found with them; particles stand on the field itself. Lower degrees do.
  Proof
};

/// An element with the derived field in the place of f.
struct DerivedElement
{
  enum class State
  {
    Sound,
    /// Its degree would be above MaximumDegree; there are no coefficients.
    DegreeTooHigh,
    /// The determinant is not proven to be positive, so that the field may be infinite; there are no coefficients.
    Singular,
    /// The quantity is not finite somewhere, although the derivatives are; there are no coefficients.
    NotFinite
  };

  State state = State::Singular;
  StandIn standIn = StandIn::Surface;
  Degrees degrees{ 0, 0, 0 };
  /// In the order of coefficientIndex; homogeneous where there are weights.
  std::vector<Coefficient> coefficients;
  /// Empty where the field is a polynomial.
  std::vector<double> weights;
};

/// Derives a field from the field of one element.
///
/// With x = X/w and u = U/w, and the columns X'_k = w dX/du_k - X dw/du_k (dX/du_k where w = 1), the gradient is
/// G = U' adj(X') / det(X'). So every quantity, or its square, is a quotient N/D of polynomials with D = det(X') or
/// its square: a rational field, on the rational element (w D x, w N, w D), which all other rooms take as it is. On
/// affine maps D is constant, and the field a polynomial. Products are taken in Bernstein form, so that no accuracy is
/// lost at high degrees. Derivation: Documentation/algorithm.md, section Derived fields.
class Derivation
{
public:
  /// \param quantity not Value
  /// \pre the mean of the Jacobian is not singular: its determinant is not zero everywhere, nor does it change its sign
  Derivation(const SourceElement& source, Quantity quantity, StandIn standIn = StandIn::Surface);

  /// Bounds on the degrees of element(), from those of its factors.
  Degrees degreesAtMost() const;

  /// Whether the map is affine, so that the field is a polynomial.
  bool isAffine() const;

  /// \return its field is the quantity, or its square. It is for the surface also where the map is affine, as it is a
  /// polynomial then.
  DerivedElement element() const;

private:
  using Columns = std::array<std::vector<ScaledPolynomial>, 3>;

  Columns adjugate() const;
  std::vector<std::array<ScaledPolynomial, 3>> gradientNumerators(
    const Columns& adjugate, double share) const;
  ScaledPolynomial numerator(const std::vector<std::array<ScaledPolynomial, 3>>& gradient) const;
  DerivedElement assemble(
    const ScaledPolynomial& numerator, const ScaledPolynomial& denominator) const;

  SourceElement Source;
  Quantity ItsQuantity;
  StandIn ItsStandIn;
  int Components;
  /// The inverse of the mean Jacobian. Derivatives are taken of y = Inverse x, whose Jacobian is about the identity:
  /// thin and stretched elements lose no accuracy.
  glm::dmat3 Inverse{ 1.0 };
  /// w; the constant 1 where the element is not rational.
  ScaledPolynomial Weight;
  /// Y'_k: three components for each coordinate.
  Columns Map;
  /// U'_k.
  Columns Field;
};

} // namespace hop
