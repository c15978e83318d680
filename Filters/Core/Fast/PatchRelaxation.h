#pragma once

#include "Common/Monitor.h"
#include "Fast/InsertionDeletion.h"
#include "Support/Buffer.h"
#include "Surface/Patch.h"

#include <functional>
#include <vector>

namespace hop
{

/// How often particles are moved, and how far at most.
struct Sweeps
{
  int count = 0;
  /// From where a particle started, in units of its spacing.
  float farthest = 0.5f;
};

/// Spreads particles evenly over their patches: Gauss-Seidel sweeps over the energy of
/// Energy.h with the weight (h_ij/h_i)^2 of a pair, h_ij the harmonic mean of the two spacings (it
/// makes the pressure, and with it the area around a particle, even where spacings differ). Pairs
/// whose normals are more than 60 degrees apart fade out. Each particle takes over-relaxed Newton
/// steps in its tangent plane and goes no farther than it may, and no farther than half the radius to which
/// the surface bends, from where it started. No function of the mesh is evaluated.
///
/// Particles that see each other never move at the same time: a greedy colouring in the order of the
/// particles decides who moves together. So the result does not depend on threads.
/// \param reached told now and then which share of the sweeps is done
Relaxed relaxOnPatches(const Buffer<Patch>& patches, const Sweeps& sweeps, const Balance& balance,
  const ParallelFor& parallelFor, const std::function<void(double share)>& reached = {});

} // namespace hop
