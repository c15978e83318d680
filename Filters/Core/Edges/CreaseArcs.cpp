#include "Edges/CreaseArcs.h"

#include <map>

namespace hop
{
namespace
{

/// Where a crease in a face begins and ends; both are the middle of a ring.
struct ArcEnds
{
  glm::dvec3 begin{ 0.0 }, end{ 0.0 };
};

ArcEnds endsOf(const BoundaryTrace& trace, const CurveStretch& stretch)
{
  if (!stretch.isRing)
  {
    return { trace.vertices[stretch.first].position(), trace.vertices[stretch.last].position() };
  }
  glm::dvec3 sum(0.0);
  for (std::size_t v = stretch.first; v < stretch.last; ++v)
  {
    sum += trace.vertices[v].position();
  }
  sum /= static_cast<double>(stretch.last - stretch.first);
  return { sum, sum };
}

} // namespace

std::vector<int> partnersOf(const ElementMesh& mesh, const std::vector<BoundaryTrace>& traces,
  const std::vector<CurveStretch>& stretches, double nearness)
{
  const auto elementOf = [&](const CurveStretch& stretch)
  { return traces[stretch.trace].vertices[stretch.first].leaving.at.location.element; };
  const auto ends = [&](int s) { return endsOf(traces[stretches[s].trace], stretches[s]); };
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
      const ArcEnds its = ends(one);
      double least = 2.0 * nearness;
      int nearest = -1;
      for (const int other : there->second)
      {
        const ArcEnds others = ends(other);
        const double apart =
          glm::distance(its.begin, others.end) + glm::distance(its.end, others.begin);
        if (partners[other] < 0 && stretches[other].isRing == stretches[one].isRing &&
          apart < least)
        {
          least = apart;
          nearest = other;
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
