#pragma once

#include "Surface/FaceLocator.h"
#include "Surface/Particles.h"
#include "Surface/SurfaceWalker.h"

#include <optional>

namespace hop
{

/// Looks for the surface below points of a mesh, by walks from its particles. Walks pass faces that elements do not share.
class SurfaceBelow
{
public:
  SurfaceBelow(const Isosurface& surface, const ParallelFor& parallelFor);

  /// The place of the field below a point near a particle, if the surface goes on there.
  /// \param spacing at the point
  std::optional<Evaluated> placeBelow(
    const glm::dvec3& point, const Particle& start, double spacing);

  /// A new particle there, on the surface.
  std::optional<Particle> particleBelow(
    const glm::dvec3& point, const Particle& start, double spacing);

private:
  Isosurface Surface;
  std::optional<FaceLocator> Locator;
  std::optional<SurfaceWalker> Walker;
};

} // namespace hop
