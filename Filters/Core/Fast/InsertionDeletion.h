#pragma once

#include "Support/Buffer.h"
#include "Support/SpacingGrid.h"
#include "Surface/Patch.h"

#include <optional>
#include <vector>

namespace hop
{

/// What to do about the number of particles (InsertionDeletion.h).
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

/// Which particles to remove and to double so that everywhere stand as many as wanted, seen by their
/// energies after some sweeps: 1 + e times that of hexagonal packing means spacings 1 + eps times
/// those wanted, e = beta E'(beta)/E(beta) eps + ..., and (1 + eps)^2 - 1 particles missing for each
/// that there is. These are averaged over all that a particle sees and summed up along the order of
/// the particles; each time that sum has grown by one a particle is doubled, each time it has fallen
/// by one one is removed. On surfaces that bend too fast for their particles energies say nothing.
///
/// Single defects are particles with far too much energy, which are removed, and holes as wide as a
/// particle, which are filled.
///
/// \param energies of the last sweep; negative for particles that are fixed
/// \param relaxed its displacements; gets its marks and splits; all are kept where it says nothing else
void insertAndDelete(const Buffer<Patch>& patches, const SeenLists& lists,
  const std::vector<float>& energies, const Balance& balance, const ParallelFor& parallelFor,
  Relaxed& relaxed);

} // namespace hop
