#include "Run/PreviousRun.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace hop
{

namespace
{

/// Largest relative change of the spacing at which particles go on: automatic spacings change a little with the bounds
/// of a moving mesh. Larger changes want another number of particles. Chosen by experiment.
constexpr double largestChangeOfSpacing = 0.1;

bool sameRequest(const DistributionParameters& a, const DistributionParameters& b)
{
  return a.sizing.angularDensity == b.sizing.angularDensity &&
    a.sizing.smallestSpacing == b.sizing.smallestSpacing && a.quality == b.quality &&
    a.seed == b.seed && a.particleCount == b.particleCount && a.onCreases == b.onCreases;
}

bool sameSpacing(const RunOrigin& a, const RunOrigin& b)
{
  const double ratio =
    (a.parameters.sizing.spacing / b.parameters.sizing.spacing) * (a.unit / b.unit);
  return std::abs(ratio - 1.0) <= largestChangeOfSpacing;
}

} // namespace

bool RunOrigin::continues(const RunOrigin& before) const
{
  const bool somethingChanged =
    this->isovalue != before.isovalue || this->dataTime != before.dataTime;
  return somethingChanged && this->array == before.array && this->component == before.component &&
    this->quantity == before.quantity && this->averaged == before.averaged &&
    this->cells == before.cells && this->points == before.points &&
    this->nodeSpacing == before.nodeSpacing && sameSpacing(*this, before) &&
    sameRequest(this->parameters, before.parameters);
}

RunOrigin originOf(const InputBlocks& blocks)
{
  RunOrigin origin;
  const char* name = blocks[0].scalars->GetName();
  origin.array = name ? name : "";
  origin.component = blocks.component();
  origin.quantity = blocks.quantity();
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    // The grid itself is a new copy each time that ParaView's pipeline looks at it.
    vtkUnstructuredGrid* grid = blocks[b].grid;
    for (const vtkMTimeType time : { grid->GetPoints() ? grid->GetPoints()->GetMTime() : 0,
           grid->GetCells() ? grid->GetCells()->GetMTime() : 0, blocks[b].scalarsTime })
    {
      origin.dataTime = std::max<std::uint64_t>(origin.dataTime, time);
    }
    origin.cells += grid->GetNumberOfCells();
    origin.points += grid->GetNumberOfPoints();
  }
  return origin;
}

std::vector<Location> PreviousRun::startOf(
  std::size_t index, const RunOrigin& origin, const ElementMesh& mesh) const
{
  if (index >= this->Surfaces.size() || !origin.continues(this->Surfaces[index].origin))
  {
    return {};
  }
  return findPlaces(mesh, this->Surfaces[index].places);
}

void PreviousRun::remember(std::size_t index, const RunOrigin& origin, const ElementMesh& mesh,
  const Distribution& distribution, const ParallelFor& parallelFor)
{
  this->Surfaces.resize(std::max(this->Surfaces.size(), index + 1));
  this->Surfaces[index] = distribution.report.aborted
    ? Surface{}
    : Surface{ origin, cellPlaces(mesh, distribution.particles, parallelFor) };
}

} // namespace hop
