#pragma once

#include "Common/Monitor.h"
#include "Surface/DistributionParameters.h"
#include "Surface/Particles.h"

namespace hop
{

/// The distribution of Meyer, Nelson, Kirby and Whitaker (IEEE TVCG 13(5), 2007), sections 3 and 4,
/// with its misprints corrected (see Energy.h):
///  - particles repel each other with the cotangent energy, where their normals are less than 90
///    degrees apart, and move in the tangent plane, one after the other (Gauss-Seidel), each with a
///    step length lambda of its own that follows whether its energy fell, no farther than h;
///  - after each step Newton's method puts the particle back on the surface;
///  - when the whole energy changes by less than 0.15% over five sweeps (the paper says from one to the
///    next, which leaves close pairs), crowded particles are deleted and lonely ones split, by a biased
///    coin, until fewer than 1% want to;
///  - lists of neighbours come from spatial bins and are renewed every five sweeps;
///  - all of this happens first at a coarse spacing, which is then halved level by level, each
///    particle becoming four;
///  - with a fixed number of particles, the spacing follows the energy instead.
///
/// Where the paper is silent: seeds come from boxes that hold all of the surface (SurfaceBoxes.h);
/// those without a particle of the same orientation within their spacing are added at every level and
/// at the end. So no component that stands alone is lost; one nearer to another than the spacing, and
/// turned the same way, may be. The biased coin is content with up to an eighth too few particles; once it is,
/// the population is taken to where the mean energy is ideal and settles again.
/// Particles on the boundary curve of the domain miss the neighbours beyond it; their ideal energy is that of the
/// neighbours that can exist (4 on a face, 2 on an edge).
Distribution distributeClassic(const Isosurface& surface, const DistributionParameters& parameters,
  const Monitor& monitor, const ParallelFor& parallelFor);

} // namespace hop
