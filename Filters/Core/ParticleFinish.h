#pragma once

#include "Energy.h"
#include "FaceJumps.h"
#include "MovingParticles.h"
#include "Particles.h"

namespace hop
{

/// Particles taken to the surface.
struct FinishedParticles
{
  /// One for each that moved; with room for those on rims.
  Buffer<Particle> particles;
  /// Which of them lie on the surface to its tolerance. The others are lost.
  std::vector<char> settled;
  std::int64_t evaluations = 0;
};

/// Takes all particles that move to the surface by Newton's method: a few steps for all that need them at
/// once, then one by one. Each is offered the faces of its element at which the surface turns (FacePlanes.h).
FinishedParticles finishParticles(MovingParticles& moving, const FaceJumps& jumps,
  const SpacingLaw& law, const ParallelFor& parallelFor);

} // namespace hop
