#pragma once

#include "Common/Monitor.h"
#include "Elements/GatheredMesh.h"
#include "Support/Exchange.h"
#include "Support/Slab.h"
#include "Surface/DistributionParameters.h"
#include "Surface/Particles.h"
#include "Surface/SurfaceWalker.h"

#include <exception>
#include <vector>

namespace hop
{

/// The rank that has the worker of a slab: ranks take turns where there are more slabs, and every so many ranks one has
/// a slab where there are fewer.
inline int rankOfSlab(std::size_t slab, std::size_t slabs, int ranks)
{
  return static_cast<int>(slab * static_cast<std::size_t>(ranks) / slabs);
}

/// What the workers of this rank have distributed.
struct SlabResult
{
  /// One a slab; without particles for slabs of other ranks, and for all where one of the ranks has failed. Empty where
  /// this rank has failed before it began.
  std::vector<Distribution> distributions;
  /// Whether all workers have come to an end; the same on all ranks.
  bool isComplete = false;
  /// What went wrong on this rank, if anything did.
  std::exception_ptr failure;
};

/// Distributes the particles of an isosurface in slabs (SlabDistribution.h). Every rank calls it, and passes on what
/// workers tell each other. The result does not depend on which ranks they are on.
/// \param meshes one a slab, joined; on other ranks than the slab's they are not used
/// \param surface without a mesh
/// \param isSound whether this rank can take part
SlabResult distributeInSlabs(Exchange& exchange, const std::vector<Slab>& slabs,
  const std::vector<GatheredMesh>& meshes, const Isosurface& surface,
  const DistributionParameters& parameters, bool isSound, const Monitor& monitor,
  const ParallelFor& parallelFor);

} // namespace hop
