#pragma once

#include "Common/Monitor.h"
#include "Elements/GatheredMesh.h"
#include "Support/Exchange.h"
#include "Support/Slab.h"

#include <exception>
#include <vector>

namespace hop
{

/// The elements that the workers of slabs need.
struct SlabMeshes
{
  /// One a slab, in canonical order and joined; empty for slabs of other ranks.
  std::vector<GatheredMesh> meshes;
  /// Whether every worker has its elements; the same on all ranks.
  bool isComplete = false;
  /// What went wrong on this rank, if anything did.
  std::exception_ptr failure;
};

/// Sends every worker the elements of all ranks within SlabOverlap::Reach of its slab. Every rank calls it.
/// \param mine this rank's elements, without neighbours
/// \param cells of this rank's input
/// \param spacing on flat surfaces, world units
/// \param isSound whether this rank can take part
SlabMeshes gatherSlabs(Exchange& exchange, const ElementMesh& mine, std::int64_t cells,
  const std::vector<Slab>& slabs, double spacing, bool isSound, const ParallelFor& parallelFor);

} // namespace hop
