#pragma once

#include "Elements/ElementMesh.h"
#include "Surface/Particles.h"

namespace hop
{

/// Tells a particle where its splat leaves its element: the borders of the element on the surface that are within reach
/// of the splat, the nearest ones if there are more than it keeps. Each is known to second order at the particle.
/// Derivation: Documentation/algorithm.md, section Cell borders.
/// \param jet, map at the particle's place; jet with second derivatives
void markCellBorders(
  const ElementMesh& mesh, const Jet& jet, const LocalMap& map, Particle& particle);

} // namespace hop
