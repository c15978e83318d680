#include "Isolation/PieceBoxes.h"

#include "Isolation/ProxyPolygons.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

int cornerCount(const Piece& piece)
{
  return static_cast<int>(piece.kind->cornerPlaces.size());
}

/// The power of two that goes into the largest absolute value once, and not twice; 1 if all values are zero.
double powerOfTwoNear(const std::array<double, MaximumCorners>& values)
{
  double largest = 0.0;
  for (const double value : values)
  {
    largest = std::max(largest, std::abs(value));
  }
  return largest > 0.0 ? std::ldexp(1.0, std::ilogb(largest)) : 1.0;
}

/// A box with the place, the size and the corners of a piece.
/// \param values at the corners
SurfaceBox boxAround(const Piece& piece, const std::array<double, MaximumCorners>& values)
{
  SurfaceBox box;
  box.middle = { piece.element, piece.middle() };
  box.size = piece.worldSize();
  box.valueUnit = powerOfTwoNear(values);
  for (int c = 0; c < cornerCount(piece); ++c)
  {
    box.referenceRadius =
      std::max(box.referenceRadius, glm::distance(piece.corner(c), box.middle.u.xyz));
    box.corners[c] = glm::vec3(piece.corner(c));
    box.values[c] = static_cast<float>(values[c] / box.valueUnit);
  }
  return box;
}

/// Puts the ends of the box at the corners with the smallest and the largest value.
void findEnds(const Piece& piece, SurfaceBox& box)
{
  int lowest = 0;
  int highest = 0;
  const auto value = [&](int c) { return piece.coefficients[piece.kind->cornerPlaces[c]].w; };
  for (int c = 1; c < cornerCount(piece); ++c)
  {
    lowest = value(c) < value(lowest) ? c : lowest;
    highest = value(c) > value(highest) ? c : highest;
  }
  box.straddles = value(lowest) < 0.0 && value(highest) > 0.0;
  box.ends = { { { piece.corner(lowest) }, { piece.corner(highest) } } };
}

} // namespace

SurfaceBox boxOf(const Piece& piece, const PieceTests& tests)
{
  SurfaceBox box = boxAround(piece, piece.cornerValues());
  box.certified = piece.certified();
  // Where the field rose weakly in a piece, it may rise strictly in a half of the piece.
  box.risesWeakly = piece.sheet == Monotony::Weak && tests.monotony(piece) != Monotony::Strict;
  box.mayBeThin = piece.sheet == Monotony::Weak;
  findEnds(piece, box);
  return box;
}

void appendBoxesOfPair(const Piece& piece, const SheetPair& pair, std::vector<SurfaceBox>& boxes)
{
  for (const SheetPair::Sheet& sheet : pair.sheets)
  {
    const auto [least, most] =
      std::minmax_element(sheet.values.begin(), sheet.values.begin() + cornerCount(piece));
    if (*least <= 0.0 && *most >= 0.0)
    {
      SurfaceBox& box = boxes.emplace_back(boxAround(piece, sheet.values));
      box.certified = pair.isFlat();
      box.straddles = true;
      box.ends = { piece.inElement(pair.between),
        piece.inElement(2.0 * sheet.place - pair.between) };
      if (pair.outside < 0.0)
      {
        std::swap(box.ends[0], box.ends[1]);
      }
      box.largestOwnValue = static_cast<float>(sheet.reach / box.valueUnit);
      box.middle.u = proxyMiddle(piece.kind->domain, box);
    }
  }
}

SurfaceBox boxOfUndecidedPart(const Piece& part, const PieceTests& tests)
{
  SurfaceBox box = boxOf(part, tests);
  box.straddles = false;
  box.values.fill(1.0f);
  return box;
}

} // namespace hop
