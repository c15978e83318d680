#include "SurfaceSeeds.h"

#include "Surface/SurfaceWalker.h"

#include <algorithm>

namespace hop::testing
{

std::vector<Location> surfaceSeeds(
  const ElementMesh& mesh, double isovalue, const std::vector<SurfaceBox>& boxes)
{
  constexpr double tolerance = 1e-10;
  SurfaceWalker walker({ &mesh, isovalue, tolerance });
  std::vector<Location> seeds;
  std::int64_t evaluations = 0; // not asked for
  for (const SurfaceBox& box : boxes)
  {
    Evaluated on;
    bool found = walker.project(box.middle, 2.0 * box.size, on);
    if (box.straddles && !(found && isAtBox(box, on.location)))
    {
      found = walker.project(findBetweenEnds(mesh, isovalue, box, evaluations), box.size, on);
    }
    if (found)
    {
      seeds.push_back(on.location);
    }
  }
  return seeds;
}

std::ptrdiff_t uncertifiedCount(const std::vector<SurfaceBox>& boxes)
{
  return std::count_if(
    boxes.begin(), boxes.end(), [](const SurfaceBox& box) { return !box.certified; });
}

glm::dvec3 positionAt(const ElementMesh& mesh, const Location& location)
{
  return glm::dvec3(evaluateGradient(mesh.form(location.element), location.u).value);
}

} // namespace hop::testing
