#include "Particles/ParticleLocator.h"

#include "Particles/SplatParticles.h"
#include "vtkIdList.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>

namespace hop
{
namespace
{
// Largest number of the locator's buckets along an axis, chosen by experiment. More take more memory, up to 200^3
// buckets; fewer hold more points each, among which the search is slower.
constexpr double FinestDivisions = 200.;
}

//------------------------------------------------------------------------------
ParticleLocator::ParticleLocator(const float* centreRadius, vtkIdType count)
{
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, centreRadius + 4 * i);
  }
  this->Points->SetPoints(points);
  double bounds[6];
  this->Points->GetBounds(bounds);
  this->Distance = count > 0 ? SplatParticles::EstimateDistance(bounds, count) : 0.;
  if (this->Distance == 0.)
  {
    return;
  }
  // Buckets of two distances each. VTK's own choice is for points that fill a volume; with it each bucket of a surface
  // would hold hundreds.
  int divisions[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double length = bounds[2 * axis + 1] - bounds[2 * axis];
    divisions[axis] =
      static_cast<int>(std::clamp(0.5 * length / this->Distance, 1., FinestDivisions));
  }
  this->Locator->SetDataSet(this->Points);
  this->Locator->AutomaticOff();
  this->Locator->SetDivisions(divisions);
  this->Locator->BuildLocator();
}

ParticleLocator::~ParticleLocator() = default;

//------------------------------------------------------------------------------
void ParticleLocator::FindAround(vtkIdType particle, double radius, vtkIdList* found) const
{
  double place[3];
  this->Points->GetPoint(particle, place);
  this->Locator->FindPointsWithinRadius(radius, place, found);
  std::sort(found->begin(), found->end());
}
}
