#pragma once

#include "Edges/FaceJumps.h"
#include "Fast/MovingParticles.h"
#include "Surface/Particles.h"
#include "Surface/SizingFunction.h"

namespace hop
{

/// Particles taken to the surface.
struct FinishedParticles
{
  /// One for each that moved; with room for those on boundary curves.
  Buffer<Particle> particles;
  /// Which of them lie on the surface to its tolerance. The others are lost.
  std::vector<char> settled;
  std::int64_t evaluations = 0;
};

/// Takes all particles that move to the surface by Newton's method: a few steps for all that need them at
/// once, then one by one. Each is offered the faces of its element at which the surface turns (FacePlanes.h).
FinishedParticles finishParticles(MovingParticles& moving, const FaceJumps& jumps,
  const SizingFunction& sizing, const ParallelFor& parallelFor);

} // namespace hop
