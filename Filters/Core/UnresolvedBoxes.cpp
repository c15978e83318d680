#include "UnresolvedBoxes.h"

#include <algorithm>

namespace hop
{

void reportUnresolved(
  const Isosurface& surface, const std::vector<SurfaceBox>& boxes, DistributionReport& report)
{
  const ElementMesh& mesh = *surface.mesh;
  std::vector<CriticalPoint> singular;
  report.boxes = static_cast<std::int64_t>(boxes.size());
  for (const SurfaceBox& box : boxes)
  {
    if (box.certified)
    {
      continue;
    }
    ++report.boxesUnresolved;
    const std::int64_t cell = mesh.elements[box.middle.element].cell;
    if (report.unresolvedCells.empty() || report.unresolvedCells.back() != cell)
    {
      report.unresolvedCells.push_back(cell);
    }
    CriticalPoint point;
    const auto same = [&](const CriticalPoint& other)
    {
      return other.location.element == point.location.element &&
        glm::distance(other.location.u.xyz, point.location.u.xyz) < 1e-6;
    };
    if (findCriticalPoint(mesh, surface.isovalue, box, point) && point.onSurface &&
      std::none_of(singular.begin(), singular.end(), same))
    {
      singular.push_back(point);
    }
  }
  report.singularPoints = static_cast<std::int64_t>(singular.size());
}

} // namespace hop
