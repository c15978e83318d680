#include "Edges/CreaseArcs.h"

#include <algorithm>
#include <limits>
#include <map>

namespace hop
{
namespace
{

/// Largest distance of a closed crease from the chords of its other side, in units of the longest chord. Chords depart
/// from the curve by less than a tenth (TraceAngles). Larger: another closed crease of the same face may be taken.
constexpr double besideChords = 0.1;

/// A crease as one side of a face sees it.
struct Arc
{
  const BoundaryTrace& trace;
  const CurveStretch& stretch;

  const BoundaryVertex& vertex(std::size_t v) const { return this->trace.vertices[v]; }
  glm::dvec3 begin() const { return this->vertex(this->stretch.first).position(); }
  glm::dvec3 end() const { return this->vertex(this->stretch.last).position(); }
};

/// How far two arcs are apart at their ends, in sum. One of them runs to, the other fro.
double endsApart(const Arc& one, const Arc& other)
{
  return glm::distance(one.begin(), other.end()) + glm::distance(one.end(), other.begin());
}

/// How far a closed arc departs from the chords of another one, in units of the longest of them.
double ringsApart(const Arc& one, const Arc& other)
{
  double longest = 0.0;
  double farthest = 0.0;
  for (std::size_t v = one.stretch.first; v < one.stretch.last; ++v)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t w = other.stretch.first; w < other.stretch.last; ++w)
    {
      const glm::dvec3 from = other.vertex(w).position();
      const glm::dvec3 to = other.vertex(w + 1).position();
      longest = std::max(longest, glm::distance(from, to));
      nearest = std::min(nearest, distanceToSegment(one.vertex(v).position(), from, to));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest / longest;
}

} // namespace

std::vector<int> partnersOf(const ElementMesh& mesh, const std::vector<BoundaryTrace>& traces,
  const std::vector<CurveStretch>& stretches, double nearness)
{
  const auto elementOf = [&](const CurveStretch& stretch)
  { return traces[stretch.trace].vertices[stretch.first].leaving.at.location.element; };
  const auto arc = [&](int s) { return Arc{ traces[stretches[s].trace], stretches[s] }; };
  std::vector<int> partners(stretches.size(), -1);
  std::map<std::size_t, std::vector<int>>
    alongFace; // by the slot of the face, as its own side sees it
  for (std::size_t s = 0; s < stretches.size(); ++s)
  {
    if (stretches[s].creaseFace >= 0)
    {
      alongFace[faceSlot(elementOf(stretches[s]), stretches[s].creaseFace)].push_back(
        static_cast<int>(s));
    }
  }
  for (const auto& [slot, here] : alongFace)
  {
    const int first = here.front();
    const FaceNeighbor& behind =
      mesh.neighbor(elementOf(stretches[first]), stretches[first].creaseFace);
    const auto there = alongFace.find(faceSlot(behind.element, behind.face));
    if (there == alongFace.end() || there->first < slot)
    {
      continue;
    }
    for (const int one : here)
    {
      const bool isRing = stretches[one].isRing;
      double least = isRing ? besideChords : 2.0 * nearness;
      int nearest = -1;
      for (const int other : there->second)
      {
        if (partners[other] < 0 && stretches[other].isRing == isRing)
        {
          const double apart =
            isRing ? ringsApart(arc(one), arc(other)) : endsApart(arc(one), arc(other));
          nearest = apart < least ? other : nearest;
          least = std::min(least, apart);
        }
      }
      if (nearest >= 0)
      {
        partners[one] = nearest;
        partners[nearest] = one;
      }
    }
  }
  return partners;
}

} // namespace hop
