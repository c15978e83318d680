#pragma once

#include "Elements/ElementMesh.h"
#include "Support/Exchange.h"
#include "Support/Slab.h"
#include "Surface/SizingFunction.h"

#include <exception>
#include <vector>

namespace hop
{

/// How many workers a surface has, and which part of it each has.
struct SlabPlan
{
  /// In their order along canonicalOrder()'s sweep; the same on all ranks. Empty where one of them has failed.
  std::vector<Slab> slabs;
  /// What went wrong on this rank, if anything did.
  std::exception_ptr failure;
};

/// Cuts isosurfaces of one mesh into slabs of about equal work, one a worker. The number of slabs follows from the
/// surface that takes most particles, and from the thickness that slabs must have: not from the number of ranks, nor
/// from how elements lie on them. Surfaces that take less than twice as many particles as a worker is worth are one
/// slab.
///
/// The work is estimated at the middles of elements, or of pieces of large ones. By the coarea formula the mean area of
/// the surfaces of all values in a piece is the integral of |grad F| over the piece, divided by the range of the
/// values. It is off by a factor of two for single pieces, but hardly for many.
/// \param mine this rank's elements, without neighbours; every rank calls it
/// \param particles that a worker is worth
SlabPlan planSlabs(Exchange& exchange, const ElementMesh& mine,
  const std::vector<double>& isovalues, const SizingFunction& sizing, double particles,
  const ParallelFor& parallelFor);

} // namespace hop
