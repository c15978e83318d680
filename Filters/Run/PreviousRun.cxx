#include "Run/PreviousRun.h"

#include <algorithm>
#include <cmath>

namespace
{

/// Spacings that follow from the bounds of a moving mesh change a little.
constexpr double largestChangeOfSpacing = 0.1;

bool sameRequest(const hop::DistributionParameters& a, const hop::DistributionParameters& b)
{
  return std::abs(a.sizing.spacing / b.sizing.spacing - 1.0) <= largestChangeOfSpacing &&
    a.sizing.angularDensity == b.sizing.angularDensity && a.quality == b.quality &&
    a.seed == b.seed && a.particleCount == b.particleCount;
}

} // namespace

bool RunOrigin::continues(const RunOrigin& before) const
{
  const bool somethingChanged =
    this->isovalue != before.isovalue || this->dataTime != before.dataTime;
  return somethingChanged && this->array == before.array && this->component == before.component &&
    this->cells == before.cells && this->points == before.points &&
    this->nodeSpacing == before.nodeSpacing && sameRequest(this->parameters, before.parameters);
}

std::vector<hop::Location> PreviousRun::startOf(
  std::size_t index, const RunOrigin& origin, const hop::ElementMesh& mesh) const
{
  if (index >= this->Surfaces.size() || !origin.continues(this->Surfaces[index].origin))
  {
    return {};
  }
  return hop::findPlaces(mesh, this->Surfaces[index].places);
}

void PreviousRun::remember(std::size_t index, const RunOrigin& origin, const hop::ElementMesh& mesh,
  const hop::Distribution& distribution, const hop::ParallelFor& parallelFor)
{
  this->Surfaces.resize(std::max(this->Surfaces.size(), index + 1));
  this->Surfaces[index] = distribution.report.aborted
    ? Surface{}
    : Surface{ origin, hop::cellPlaces(mesh, distribution.particles, parallelFor) };
}
