#pragma once

#include "Buffer.h"
#include "Monitor.h"
#include "Patch.h"

#include <functional>
#include <optional>
#include <vector>

namespace hop
{

/// Where patches are and how far apart they are to stand, as SpacingGrid.h wants it.
struct SpacedPoints
{
  SpacedPoints(const Buffer<Patch>& patches, const ParallelFor& parallelFor);

  Buffer<glm::dvec3> positions;
  Buffer<float> spacings;
};

/// What to do about the number of particles (Population.h).
struct Balance
{
  enum Extent
  {
    None,
    /// Remove those that are far too close to others.
    Crowded,
    /// That, and fill holes between them.
    Defects,
    /// Remove those that are far too close, and make the number what it should be everywhere.
    Everywhere
  };
  Extent extent = None;
  /// How many are missing in all, as far as that is known; else energies tell.
  std::optional<double> missing;
};

/// How often particles are moved, and how far at most.
struct Sweeps
{
  int count = 0;
  /// From where a particle started, in units of its spacing.
  float farthest = 0.5f;
};

/// A particle to double, and the place of the new one on its patch.
struct Split
{
  int particle = 0;
  glm::vec2 displacement{ 0.0f };
};

/// Where relaxation takes particles.
struct Relaxed
{
  /// In the basis of each particle's tangents; zero for fixed ones.
  std::vector<glm::vec2> displacements;
  /// Marks the particles that there is room for.
  std::vector<char> kept;
  /// Where there is room for more, in the order of the particles.
  std::vector<Split> splits;
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
