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
/// Derivation: Documentation/algorithm.md, section Fast distribution.
struct Sweeps
{
  int count = 0;
  /// Largest distance from where a particle starts, in units of its spacing. Chosen by experiment. Larger: patches are
  /// less exact at the end of the way, and more steps are halved; smaller: more rounds are needed.
  float farthest = 0.5f;
};

/// Spreads particles evenly over their patches by Gauss-Seidel sweeps over the energy of Energy.h. A pair has the
/// weight (h_ij/h_i)^2, h_ij the harmonic mean of the two spacings, which makes the pressure even, and with it the area
/// around a particle, where spacings differ. Pairs whose normals are more than 60 degrees apart fade out. Each particle
/// takes over-relaxed Newton steps in its tangent plane. It stays within Sweeps::farthest of where it started, and
/// within half the radius of curvature. The field is not evaluated.
///
/// Particles that interact never move at the same time: a greedy colouring in the order of the particles decides which
/// of them move together. So the result does not depend on threads.
/// \param reached called now and then with the share of the sweeps that is done
Relaxed relaxOnPatches(const Buffer<Patch>& patches, const Sweeps& sweeps, const Balance& balance,
  const ParallelFor& parallelFor, const std::function<void(double share)>& reached = {});

} // namespace hop
