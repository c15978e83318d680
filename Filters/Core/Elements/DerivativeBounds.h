#pragma once

#include "Elements/Quantity.h"
#include "Elements/SourceElement.h"

#include <glm/mat3x3.hpp>

#include <array>
#include <vector>

namespace hop
{

/// Bounds of a quantity, or of its square where that is derived, from bounds of the gradient's entries, three a component.
Range boundsFrom(Quantity quantity, const std::vector<std::array<Range, 3>>& gradient);

/// What the hulls of first derivatives tell of an element's gradient: cheap enough to be asked of every cell.
/// Derivation: Documentation/algorithm.md, section Derived fields, 'Which cells'.
class DerivativeBounds
{
public:
  explicit DerivativeBounds(const SourceElement& source);

  /// Whether the Jacobian is proven to be regular everywhere. If not, bounds of all but constant fields are infinite.
  bool isRegular() const;

  /// Of the gradient with respect to the coordinates, three entries a component.
  std::vector<std::array<Range, 3>> gradient() const;

  /// Of the quantity, or of its square where that is derived.
  /// \param quantity neither Value nor Expression
  Range of(Quantity quantity) const;

  /// Values of the quantity that differ less cannot be told apart: a small multiple of what rounding makes of sums and
  /// products of the largest derivatives, and of differences of coordinates and values that are rounded to doubles
  /// themselves. 0 of Expression: it is not known.
  double rounding(Quantity quantity) const;

private:
  void findRounding(const SourceElement& source);

  /// The inverse of the mean Jacobian M.
  glm::dmat3 Inverse{ 1.0 };
  /// Largest |J^-1 M - 1|; infinite where J may be singular.
  double Deviation = 0.0;
  /// Derivatives of each component along the three coordinates.
  std::vector<std::array<Range, 3>> Field;
  /// Of derivatives with respect to the coordinates: what the rounding of coordinates makes of them, relative to the
  /// largest of them, and what the rounding of the field makes of them.
  double GeometryRounding = 0.0;
  double FieldRounding = 0.0;
};

} // namespace hop
