#pragma once

#include "Elements/BernsteinProduct.h"

namespace hop
{

/// What the Jacobian determinant of an element does.
enum class JacobianSign
{
  Positive,
  /// Left-handed everywhere: harmless, and common.
  Negative,
  /// Partly inverted: both signs occur.
  Mixed,
  /// No volume: zero everywhere, to rounding.
  Zero,
  /// A coefficient is NaN or infinite.
  NotFinite
};

/// Classifies elements by the Bernstein coefficients of det J, whose hull holds all its values.
/// Prepared once for a domain and degrees.
///
/// First a cheap test that most elements pass: with M the mean of J, every M^-1 J(u) lies in the hull of
/// its Bernstein coefficients; if all matrices of that hull are diagonally dominant, det J nowhere
/// vanishes (Gershgorin). Else det J itself is multiplied out: a polynomial of degrees 3p - 1 (less on
/// simplices); for rational elements x = X/w the polynomial of degrees 4p - 1 (likewise)
///   w^4 det J = w |X_u X_v X_w| - w_u |X X_v X_w| + w_v |X X_u X_w| - w_w |X X_u X_v|,
/// which is the 4 x 4 determinant of (X, w) and its derivatives. Where its coefficients differ in sign it
/// is halved, the worst piece first, until no piece has coefficients of the other sign, or a corner of
/// one, where the coefficient is the value, has the other sign.
///
/// A zero beside values of one sign counts as that sign: a pyramid's apex, collapsed corners and edges.
/// So does what cannot be told apart from zero before the pieces hold MaximumCoefficients.
class JacobianTest
{
public:
  JacobianTest(Domain domain, const Degrees& degrees);

  /// \param form of the domain and degrees given; weights > 0
  /// \param rounding errors of the control points beside those of coordinates as such, relative to the
  /// element's size
  JacobianSign sign(const BernsteinForm& form, double rounding = 0.0) const;

  /// det J of an element, or w^4 det J of a rational one.
  ScaledPolynomial determinant(const BernsteinForm& form) const;

  static constexpr int MaximumCoefficients = 1 << 20;

private:
  struct ControlNet;

  bool isFarFromSingular(const ControlNet& net, double& determinantOfMean) const;
  ScaledPolynomial determinant(const ControlNet& net) const;

  Domain ItsDomain;
  Degrees ItsDegrees;
  /// A derivative along u, v, w: its degrees, and the pairs of coefficients of which the differences,
  /// times the element's degree, are its own, in storage order.
  struct Derivative
  {
    Degrees degrees{};
    std::vector<std::array<int, 2>> pairs;
  };
  std::array<Derivative, 3> Derivatives;
};

} // namespace hop
