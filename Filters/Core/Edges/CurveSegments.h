#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hop
{

/// What became of a place on a curve at which a particle was to stand.
struct CurvePlace
{
  /// Index of the particle there; -1 if there is none.
  int particle = -1;
  /// Particle that stands too near for another one here; -1 if there is none, or this place has its own.
  int standIn = -1;
  /// The surface has no edge here.
  bool isGap = false;
  /// The curve is a crease from here to the next place.
  bool beginsCrease = false;
};

/// Places of one curve, in the curve's order.
struct CurveRange
{
  std::size_t first = 0;
  std::size_t count = 0;
  /// The last place is followed by the first.
  bool closed = false;
};

/// Pairs of particles that follow each other on curves but not on creases, each once, the smaller index first, sorted. Where one place
/// between two particles has none, these two are neighbours; where several in a row have none, as on a strip of the
/// surface that has no room for particles on both sides, and at the ends of a curve, their stand-ins take their place.
std::vector<std::array<int, 2>> segmentsOf(
  const std::vector<CurvePlace>& places, const std::vector<CurveRange>& curves);

/// Pairs of particles that follow each other on curves of which a part is a crease, from the second to the first: curves
/// are followed with the surface to their right.
/// \param all pairs on other curves, too
std::vector<std::array<int, 2>> directedEdgesOf(
  const std::vector<CurvePlace>& places, const std::vector<CurveRange>& curves, bool all = false);

/// Pairs of particles after some have been dropped, with the indices of the ones that are left. Where a particle with
/// two neighbours was dropped, these become neighbours.
/// \param kept a mark for each particle
std::vector<std::array<int, 2>> withoutDropped(
  const std::vector<std::array<int, 2>>& pairs, const std::vector<char>& kept);

/// Pairs of particles none of which has been dropped, with the indices of the ones that are left.
/// \param kept a mark for each particle
void renumber(std::vector<std::array<int, 2>>& pairs, const std::vector<char>& kept);

/// Each pair once, the smaller index first, sorted; without pairs of a particle with itself.
void sortPairs(std::vector<std::array<int, 2>>& pairs);

} // namespace hop
