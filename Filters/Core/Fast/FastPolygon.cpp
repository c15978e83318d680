#include "Fast/FastSystem.h"

#include "Edges/PolygonEdges.h"

#include <algorithm>

namespace hop
{
namespace
{

/// How far beyond the polygon particles are distributed that are dropped later, in units of the spacing. Those on its
/// edges stay where they are and see neighbours on both sides, so that rows beside them are as even as elsewhere. Larger:
/// more is done in vain; smaller: rows inside notice that nothing is beyond.
constexpr double polygonMargin = 5.0;

} // namespace

/// Whether a box is so far from the polygon that no particles are wanted in it.
bool FastSystem::isFarBeyondPolygon(const SurfaceBox& box) const
{
  const PlanePolygon& polygon = this->Parameters.polygon;
  return !polygon.isEverything() &&
    polygon.beyond(evaluateGradient(this->Mesh.form(box.middle.element), box.middle.u).value) >
    box.size + this->overlap(polygonMargin);
}

void FastSystem::dropFarBeyondPolygon(std::vector<SurfaceBox>& boxes) const
{
  boxes.erase(std::remove_if(boxes.begin(), boxes.end(),
                [this](const SurfaceBox& box) { return this->isFarBeyondPolygon(box); }),
    boxes.end());
}

/// Ends the surface at the edges of the polygon, with particles there that are fixed. Those beyond move on, until the
/// surface is finished.
void FastSystem::placeOnPolygon()
{
  if (this->Parameters.polygon.isEverything())
  {
    return;
  }
  const std::int64_t before = this->Curves.evaluations;
  const std::size_t first = addPolygonEdges(this->Surface, this->Parameters.polygon,
    this->Sizing.spacing, this->Moving->anchors(), this->Moving->patches(), this->Curves);
  this->Evaluations += this->Curves.evaluations - before;
  for (std::size_t n = first; n < this->Curves.particles.size(); ++n)
  {
    this->BoundaryPatches.push_back(this->Curves.particles[n].patch);
  }
  this->Moving->replaceFixed(this->BoundaryPatches);
}

/// Takes the marks of finished particles that lie outside of the polygon.
void FastSystem::dropBeyondPolygon(const Buffer<Particle>& finished, std::vector<char>& kept) const
{
  const PlanePolygon& polygon = this->Parameters.polygon;
  for (std::size_t i = 0; i < kept.size() && !polygon.isEverything(); ++i)
  {
    kept[i] = kept[i] && polygon.beyond(finished[i].position.xyz) < 0.0;
  }
}

} // namespace hop
