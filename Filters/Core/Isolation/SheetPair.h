#pragma once

#include "Isolation/MonotoneTest.h"

#include <optional>

namespace hop
{

/// Two sheets of the zeros of a field close to each other, as on the two sides of a film.
struct SheetPair
{
  struct Sheet
  {
    /// A zero of the field.
    glm::dvec3 place{ 0.0 };
    /// How the field would change from there on at the corners of the domain if there were no other sheet, in the
    /// order of facts(domain).corners: what it rises by, per length along the pair's direction at `place`, times
    /// the distance of the corner along it. Its sign is right, to second order its size.
    std::array<double, MaximumCorners> values{};
    /// Values farther from zero belong to the other sheet.
    double reach = 0.0;
    /// At corners it is no farther from its plane at `place` than from the middle between the two.
    bool isFlat = false;
  };

  bool isFlat() const { return this->sheets[0].isFlat && this->sheets[1].isFlat; }

  std::array<Sheet, 2> sheets;
  /// Where the field is farthest from zero on a line between them, with the other sign than outside.
  glm::dvec3 between{ 0.0 };
  /// The field's sign outside of the two, 1 or -1.
  double outside = 1.0;
};

/// Whether zeros of a field are two sheets, provably: along the direction n in which it bends most its second
/// derivative has coefficients of one sign, so that lines along n meet at most two zeros, one on each side of where
/// dF/dn is zero; and there the field has the other sign than outside on the lines through the corners, where they
/// are not twice as near to each other as in the middle, nor half: the two are not seen to meet. They are no
/// farther apart than the domain is thick; each is to bend by less than a tenth of that, and to part the corners or
/// to be seen to pass by.
/// \param form whose last coefficients are the field; weights do not count
/// \param test for its domain and degrees
/// \param slack what counts as zero between them, >= 0
/// \return in the form's reference coordinates
std::optional<SheetPair> findSheetPair(
  const BernsteinForm& form, const MonotoneTest& test, double slack);

} // namespace hop
