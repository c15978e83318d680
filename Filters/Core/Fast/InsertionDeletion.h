#pragma once

#include "Support/Buffer.h"
#include "Support/SpacingGrid.h"
#include "Surface/Patch.h"

#include <optional>
#include <vector>

namespace hop
{

/// What a round does about the number of particles.
/// Derivation: Documentation/algorithm.md, section Fast distribution.
struct Balance
{
  enum Extent
  {
    None,
    /// Delete particles that are far too close to others.
    Crowded,
    /// Delete particles that are far too close to others, and fill holes.
    Defects,
    /// Delete particles that are far too close to others, and insert and delete wherever the number is not right.
    Everywhere
  };
  Extent extent = None;
  /// Number of particles that are missing in all; negative if there are too many. Without it energies tell.
  std::optional<double> missing;
};

/// A new particle.
struct Insertion
{
  /// The particle on whose patch it starts.
  int beside = 0;
  /// Its place there.
  glm::vec2 displacement{ 0.0f };
};

/// Result of a relaxation.
struct Relaxed
{
  /// In the basis of each particle's tangents; zero for fixed particles.
  std::vector<glm::vec2> displacements;
  /// Marks the particles that are not deleted.
  std::vector<char> kept;
  /// In the order of the particles beside which they are.
  std::vector<Insertion> insertions;
};

/// Inserts and deletes particles so that their number is right everywhere. Energies after some sweeps tell where it is
/// not: an energy of 1 + e times the ideal one of hexagonal packing means distances of 1 + eps times the spacing,
/// e = beta E'(beta)/E(beta) eps + ..., and so (1 + eps)^2 - 1 missing particles for each one there. This share is
/// averaged over the neighbourhood of each particle and summed up along the order of the particles. Each time the sum
/// has grown by one a particle is inserted; each time it has fallen by one a particle is deleted. Where the surface
/// bends too fast for its particles energies say nothing.
///
/// Single defects are particles with far too much energy, which are deleted, and holes as wide as a particle, which are
/// filled.
///
/// \param energies of the last sweep; negative for particles that are fixed
/// \param relaxed its displacements are read; its marks, all set before, and its insertions are written
void insertAndDelete(const Buffer<Patch>& patches, const SeenLists& lists,
  const std::vector<float>& energies, const Balance& balance, const ParallelFor& parallelFor,
  Relaxed& relaxed);

} // namespace hop
