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

/// Classifies elements by the Bernstein coefficients of det J, whose hull holds all its values
/// (Documentation/algorithm.md, section Elements). Prepared once for a domain and degrees.
///
/// First a cheap test that most elements pass: with M the mean of J, every M^-1 J(u) lies in the hull of
/// its Bernstein coefficients; if all matrices of that hull are strictly diagonally dominant with the same positive
/// weights of the columns, det J nowhere vanishes (Gershgorin's circle theorem). For rational elements J is the 4 x 4
/// matrix of the determinant below. Else det J itself is multiplied out: a polynomial of degrees 3p - 1 (less
/// on simplices); for rational elements x = X/w the polynomial of degrees 4p - 1 (less on simplices)
///   w^4 det J = w |X_u X_v X_w| - w_u |X X_v X_w| + w_v |X X_u X_w| - w_w |X X_u X_v|,
/// which is the 4 x 4 determinant of (X, w) and its derivatives. Where its coefficients differ in sign it
/// is bisected, the worst piece first, until no piece has coefficients of the other sign, or a piece's corner,
/// where the coefficient is the value, has the other sign.
///
/// A zero beside values of one sign counts as that sign: a pyramid's apex, collapsed corners and edges. So does an
/// element whose other sign, if it has one, is not found before the pieces hold MaximumCoefficients.
class JacobianTest
{
public:
  JacobianTest(Domain domain, const Degrees& degrees);

  /// \param form of the domain and degrees given; weights > 0
  /// \param rounding errors of the control points that the conversion made (NodalBasis::conversionError), relative
  /// to the element's size; rounding of the coordinates themselves is allowed for anyway
  JacobianSign sign(const BernsteinForm& form, double rounding = 0.0) const;

  /// det J of an element, or w^4 det J of a rational one.
  ScaledPolynomial determinant(const BernsteinForm& form) const;

  /// Coefficients of all pieces, at most: 8 MiB of doubles, chosen by experiment. Larger: elements whose determinant
  /// hardly changes its sign are recognised, but take longer; smaller: they count as valid.
  static constexpr int MaximumCoefficients = 1 << 20;

private:
  struct ControlNet;

  bool isFarFromSingular(const ControlNet& net, double& determinantOfMean) const;
  ScaledPolynomial determinant(const ControlNet& net) const;

  Domain ItsDomain;
  Degrees ItsDegrees;
  /// A derivative along u, v or w: its degrees, and for each of its coefficients, in storage order, the pair of the
  /// element's coefficients whose difference, times the element's degree, it is.
  struct Derivative
  {
    Degrees degrees{};
    std::vector<std::array<int, 2>> pairs;
  };
  std::array<Derivative, 3> Derivatives;
};

} // namespace hop
