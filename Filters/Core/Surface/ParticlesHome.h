#pragma once

#include "Elements/GatheredMesh.h"
#include "Surface/Particles.h"

#include <vector>

namespace hop
{

/// What a rank has of an isosurface that one of the ranks, the worker, has distributed particles on.
struct HomeParticles
{
  /// The particles in this rank's elements, located in this rank's mesh. Of the report, numbers are of the whole
  /// surface; undecidedCells are this rank's own, by the rank's numbers; the error is known to the worker alone.
  Distribution distribution;
  /// Whether every rank has its particles; the same on all ranks.
  bool isComplete = false;
  /// Whether memory of this rank is the reason why they are not.
  bool lacksMemory = false;
};

/// Brings particles home: each to the rank of its element. Every rank calls it.
/// \param distribution on the worker; not used on other ranks. A rank that is alone moves its particles.
/// \param isDone whether this rank can take part: on the worker, whether the distribution is there
/// \param all on the worker, the mesh that the distribution is on
/// \param sizes as gatherMesh() had them
/// \param parallelFor of the worker, is asked at each message whether to end early; then no rank has its particles
/// \param keeps whether the worker needs its distribution afterwards; else the worker's own part is left in its memory
HomeParticles bringHome(Exchange& exchange, int worker, Distribution& distribution, bool isDone,
  const GatheredMesh& all, const std::vector<MeshSize>& sizes, const ParallelFor& parallelFor,
  bool keeps = true);

/// Adds what one of several workers has distributed to what others have: their particles, and the sums of their reports.
void add(Distribution&& part, Distribution& sum);

} // namespace hop
