/**
 * @class ParticleLocator
 * @brief finds particles around a place
 */

#pragma once

#include "vtkNew.h"
#include "vtkType.h"

class vtkIdList;
class vtkPolyData;
class vtkStaticPointLocator;

namespace hop
{
class ParticleLocator
{
public:
  /** @param centreRadius as SplatParticles::CentreRadius; it is copied */
  ParticleLocator(const float* centreRadius, vtkIdType count);
  ~ParticleLocator();

  /** Distance of neighbours as SplatParticles::EstimateDistance() gives it; 0 if all particles are in one place. */
  double GetDistance() const { return this->Distance; }

  /**
   * The particles up to a distance from one, which is among them, by number: so sums over them do not depend on the
   * locator's threads.
   * @pre GetDistance() is not 0
   */
  void FindAround(vtkIdType particle, double radius, vtkIdList* found) const;

private:
  vtkNew<vtkPolyData> Points;
  vtkNew<vtkStaticPointLocator> Locator;
  double Distance = 0.;
};
}
