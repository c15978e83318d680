#pragma once

#include "Mesh/TangentView.h"

#include <algorithm>
#include <vector>

namespace hop
{

/// Finds the particles of which the mesh around a particle may consist. On a ridge that is narrower than their spacings,
/// which do not tell of it, a particle alone has a smaller one, and does not see them (SpacingGrid).
class ParticlesAround
{
public:
  /// \pre the points outlive it, and are not empty
  explicit ParticlesAround(const SpacedPoints& points)
    : Points(points)
    , Grid(points.positions, points.spacings, ParticleNeighbors::Reach)
    , Largest(*std::max_element(points.spacings.begin(), points.spacings.end()))
  {
  }

  /// Those within ParticleNeighbors::Reach of the larger one of their spacing and the particle's, ascending.
  std::vector<int> of(int particle) const
  {
    const glm::dvec3& place = this->Points.positions[particle];
    const float own = this->Points.spacings[particle];
    std::vector<int> found;
    for (float spacing = own; spacing < 2.0f * this->Largest; spacing *= 2.0f)
    {
      this->Grid.visit(place, spacing,
        [&](int j)
        {
          const double reach = ParticleNeighbors::Reach * std::max(own, this->Points.spacings[j]);
          if (j != particle && glm::distance(this->Points.positions[j], place) <= reach)
          {
            found.push_back(j);
          }
        });
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

private:
  const SpacedPoints& Points;
  SpacingGrid Grid;
  float Largest;
};

} // namespace hop
