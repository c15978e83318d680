#pragma once

#include "FaceJumps.h"
#include "ParticleGrid.h"

namespace hop
{

/// Tells particles near an edge of the surface where it ends, by planes that touch the edge where it is nearest:
/// near a rim normal to the surface's way out of the domain there, as the nearest particle on the rim knows it to
/// second order; near a kink (a face at which the normal turns by more than KinkAngle) the face, to second order
/// as the particle itself sees it, but only if there are particles behind to cover what is cut off; near a face
/// at which the normal turns by less, that face to first order. A splat that reaches beyond a plane is to be cut off there, or, where the surface is almost
/// smooth, to count only where no other does. In corners two planes meet; where kinks do, some planes are moved
/// outwards, see KinkCorners.h.
/// \param all of these particles
/// \param particles those that are not on rims; particles on rims are marked with them
/// \param anchors where these particles lie, one for each
/// \return the number of evaluations
std::int64_t markClipPlanes(const Isosurface& surface, const FaceJumps& jumps,
  const ParticleGrid& all, Buffer<RimParticle>& rims, Buffer<Particle>& particles,
  const Buffer<Anchor>& anchors, const ParallelFor& parallelFor);

/// How far from a particle, in units of its spacing, an edge is of interest: splats overlap that far.
constexpr double ClipReach = 1.5;

} // namespace hop
