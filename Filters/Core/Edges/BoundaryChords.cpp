#include "Edges/BoundaryChords.h"

#include <algorithm>

namespace hop
{
namespace
{

/// Whether two lines in a plane cross or touch, to what single precision leaves.
bool linesMeet(const std::array<glm::dvec3, 2>& a, const std::array<glm::dvec3, 2>& b)
{
  constexpr double rounding = 1e-6; // of places in reference space, which are of order one
  const auto lieApart =
    [](const std::array<glm::dvec3, 2>& before, const std::array<glm::dvec3, 2>& behind)
  {
    const glm::dvec3 gap = glm::min(behind[0], behind[1]) - glm::max(before[0], before[1]);
    return glm::any(glm::greaterThan(gap, glm::dvec3(10.0 * rounding)));
  };
  if (lieApart(a, b) || lieApart(b, a))
  {
    return false; // boxes around them are apart, as most are
  }
  const glm::dvec3 along = b[1] - b[0];
  const double length = glm::length(along);
  const glm::dvec3 normal = glm::cross(along, a[1] - a[0]);
  const double size = glm::length(normal);
  if (!(size > rounding * rounding))
  {
    return false; // one of them is a point, or they are parallel
  }
  const glm::dvec3 aside = glm::cross(normal, along) / (size * length);
  const double first = glm::dot(aside, a[0] - b[0]);
  const double last = glm::dot(aside, a[1] - b[0]);
  const double t = std::clamp(first / (first - last), 0.0, 1.0);
  const glm::dvec3 nearest = glm::mix(a[0], a[1], t);
  const double reached = glm::dot(nearest - b[0], along) / length;
  return std::abs(glm::dot(aside, nearest - b[0])) <= rounding && reached >= -rounding &&
    reached <= length + rounding;
}

/// The share of the way from a to b that is nearest to a place.
double nearestShare(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b)
{
  const glm::dvec3 d = b - a;
  const double length2 = glm::dot(d, d);
  return length2 > 0.0 ? std::clamp(glm::dot(x - a, d) / length2, 0.0, 1.0) : 0.0;
}

} // namespace

double distanceToSegment(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b)
{
  return glm::distance(x, a + nearestShare(x, a, b) * (b - a));
}

BoundaryChords::Chord::Chord(
  const BoundaryPoint& from, const BoundaryPoint& to, const WorldVector& tangent)
  : face(faceSlot(from.at.location.element, from.face))
  , positions{ from.at.point.map.position.xyz, to.at.point.map.position.xyz }
  , along(tangent)
{
  const Location& first = from.at.location;
  const Location& last = to.at.location;
  // Of a chord that leaves its element only the first place lies in the element's reference space.
  this->places = { first.u.xyz, (last.element == first.element ? last : first).u.xyz };
}

/// Whether a chord passes a place of which test(chord, its length) is true.
template <class Test>
bool BoundaryChords::anyPasses(const Tip& tip, const Test& test) const
{
  const BoundaryPoint& point = tip.point;
  const auto found = this->Chords.find(faceSlot(point.at.location.element, point.face));
  const glm::dvec3& x = point.at.point.map.position.xyz;
  return found != this->Chords.end() &&
    std::any_of(found->second.begin(), found->second.end(),
      [&](const Chord& chord)
      {
        const auto& [a, b] = chord.positions;
        const double length = glm::distance(a, b);
        const double t = nearestShare(x, a, b);
        const bool isBeyond = (t == 0.0 && chord.isLast[0]) || (t == 1.0 && chord.isLast[1]);
        const double farthest = (isBeyond ? PassShareBeyond : PassShare) * length;
        return glm::distance(x, a + t * (b - a)) <= farthest &&
          dot(chord.along, tip.along) >= 0.0 && test(chord, length);
      });
}

bool BoundaryChords::pass(const Tip& tip) const
{
  return this->anyPasses(tip, [](const Chord&, double) { return true; });
}

bool BoundaryChords::meet(const Tip& tip) const
{
  return this->anyPasses(tip,
    [&](const Chord& chord, double length)
    {
      const auto [first, last] = std::minmax(chord.way[0], chord.way[1]);
      const double left = std::max(tip.way - last, first - tip.way);
      const bool isLeft = chord.trace == tip.trace && left <= LeftBehind * PassShare * length;
      return !isLeft;
    });
}

bool BoundaryChords::cross(int element, int face, const std::array<glm::dvec3, 2>& ends) const
{
  const auto found = this->Chords.find(faceSlot(element, face));
  return found != this->Chords.end() &&
    std::any_of(found->second.begin(), found->second.end(),
      [&ends](const Chord& chord) { return linesMeet(chord.places, ends); });
}

} // namespace hop
