#pragma once

#include "Isolation/MonotoneTest.h"

#include <optional>

namespace hop
{

/// Two sheets of the surface close to each other, as the two sides of a film.
/// Derivation: Documentation/algorithm.md, section Isolation.
struct SheetPair
{
  struct Sheet
  {
    /// A zero of the field.
    glm::dvec3 place{ 0.0 };
    /// What F - c would be at the corners of the domain, in the order of facts(domain).corners, without the other
    /// sheet: the slope of the field at `place` along the pair's direction, times the distance from the sheet to the
    /// corner along that direction. The signs are exact, the sizes are exact to second order.
    std::array<double, MaximumCorners> values{};
    /// Values farther from zero belong to the other sheet.
    double reach = 0.0;
    /// Whether the distance between the sheet and its tangent plane at `place`, at corners of the domain, is at most
    /// half the distance between the two sheets.
    bool isFlat = false;
  };

  bool isFlat() const { return this->sheets[0].isFlat && this->sheets[1].isFlat; }

  std::array<Sheet, 2> sheets;
  /// Extremum of the field between the sheets, on the line through the middle of the domain.
  glm::dvec3 between{ 0.0 };
  /// Sign of F - c outside of the two sheets, 1 or -1; it is the opposite between them.
  double outside = 1.0;
};

/// Proves that the zeros of a field in its domain are two sheets. Let n be the direction in which the field bends most.
/// The second derivative along n has coefficients of one sign, so that a line along n meets two zeros at most, one on
/// each side of the place where dF/dn is zero. On the lines through the corners, F - c at that place has the opposite
/// of the sign outside, and the distance of the two zeros is more than half and less than twice the distance on the
/// line through the middle: the two sheets do not seem to meet. The sheets are no farther apart than the domain is
/// thick along n; each one bends by less than a tenth of that thickness, and either passes between the corners or
/// clearly passes them by.
/// \param form its field is the last component of the coefficients; weights are ignored
/// \param test for the form's domain and degrees
/// \param slack |F - c| that counts as zero between the sheets, >= 0
/// \return in the form's reference coordinates; nothing if there is no proof
std::optional<SheetPair> findSheetPair(
  const BernsteinForm& form, const MonotoneTest& test, double slack);

} // namespace hop
