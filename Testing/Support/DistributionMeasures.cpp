#include "DistributionMeasures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop::testing
{

std::vector<double> nearestSpacings(const std::vector<Particle>& particles)
{
  std::vector<double> nearest;
  for (const Particle& p : particles)
  {
    double distance = std::numeric_limits<double>::infinity();
    for (const Particle& q : particles)
    {
      if (&p != &q && dot(p.normal, q.normal) > 0.0)
      {
        distance = std::min(distance, length(p.position - q.position));
      }
    }
    nearest.push_back(distance / p.spacing);
  }
  return nearest;
}

double hexagonalCount(double area, double spacing)
{
  return area / (0.5 * std::sqrt(3.0) * spacing * spacing);
}

} // namespace hop::testing
