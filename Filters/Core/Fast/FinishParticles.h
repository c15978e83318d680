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
  /// One for each particle that moved; with memory for the particles on boundary curves.
  Buffer<Particle> particles;
  /// Marks the particles that lie on the surface to its tolerance. The others are lost.
  std::vector<char> converged;
  std::int64_t evaluations = 0;
};

/// Takes all particles that move to the surface by Newton's method: first a few steps for all of them at once, then one
/// by one the particles that have not converged. Each gets the creases at faces of its element as clip planes
/// (FacePlanes.h).
FinishedParticles finishParticles(MovingParticles& moving, const FaceJumps& jumps,
  const SizingFunction& sizing, const ParallelFor& parallelFor);

} // namespace hop
