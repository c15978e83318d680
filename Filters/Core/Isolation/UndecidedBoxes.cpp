#include "Isolation/UndecidedBoxes.h"

#include "Isolation/CriticalPoint.h"

#include <algorithm>

namespace hop
{
namespace
{

/// Distance below which two critical points of an element are one, reference units: more than the error of a point that
/// several boxes lead to. With a larger distance, points close to each other count once. Chosen by experiment.
constexpr double samePoint = 1e-6;

} // namespace

void reportUndecided(
  const Isosurface& surface, const std::vector<SurfaceBox>& boxes, DistributionReport& report)
{
  const ElementMesh& mesh = *surface.mesh;
  std::vector<CriticalPoint> singular; // of the last element
  report.boxes = static_cast<std::int64_t>(boxes.size());
  for (const SurfaceBox& box : boxes)
  {
    if (box.certified)
    {
      continue;
    }
    ++report.boxesUndecided;
    const std::int64_t cell = mesh.elements[box.middle.element].cell;
    if (report.undecidedCells.empty() || report.undecidedCells.back() != cell)
    {
      report.undecidedCells.push_back(cell);
    }
    CriticalPoint point;
    const auto same = [&](const CriticalPoint& other)
    { return glm::distance(other.location.u.xyz, point.location.u.xyz) < samePoint; };
    if (!singular.empty() && singular.back().location.element != box.middle.element)
    {
      singular.clear();
    }
    if (findCriticalPoint(mesh, surface.isovalue, box, point) && point.onSurface &&
      std::none_of(singular.begin(), singular.end(), same))
    {
      singular.push_back(point);
      ++report.singularPoints;
    }
  }
}

} // namespace hop
