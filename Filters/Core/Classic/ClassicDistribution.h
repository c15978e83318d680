#pragma once

#include "Common/Monitor.h"
#include "Surface/DistributionParameters.h"
#include "Surface/Particles.h"

namespace hop
{

/// The distribution of Meyer, Nelson, Kirby and Whitaker (IEEE TVCG 13(5), 2007), sections 3 and 4, with its misprints
/// corrected (see Energy.h):
///  - particles repel each other with the cotangent energy where their normals are less than 90 degrees apart; they
///    move in the tangent plane, one after the other (Gauss-Seidel), each with a step length lambda of its own, which
///    grows where the first try lowers the energy and shrinks with each try that does not or is longer than h;
///  - after each step Newton's method puts the particle back on the surface;
///  - when the whole energy changes by less than 0.15% over five sweeps (the paper says from one to the next, which
///    leaves close pairs), a biased coin splits particles with little energy and deletes particles with much, until
///    fewer than 1% of them change;
///  - lists of neighbours come from spatial bins and are renewed every five sweeps;
///  - all of this happens first at a coarse spacing, which is then halved level by level, each particle becoming four;
///  - with a given number of particles the spacing follows the energy instead.
///
/// Where the paper is silent:
///  - seeds come from boxes that hold all of the surface (SurfaceBoxes.h). A seed is added, at every level and at the
///    end, if no particle of the same orientation is within its spacing. So no component that stands alone is lost; one
///    that is nearer to another than the spacing, and turned the same way, may be;
///  - the biased coin stops with up to an eighth too few particles. Particles are then split or deleted until the mean
///    energy is ideal, and the system settles again;
///  - a particle on a boundary curve misses the neighbours beyond it: its ideal energy counts the neighbours that can
///    exist (4 on a face of the domain, 2 on an edge).
/// Derivation: Documentation/algorithm.md, section Classic distribution.
Distribution distributeClassic(const Isosurface& surface, const DistributionParameters& parameters,
  const Monitor& monitor, const ParallelFor& parallelFor);

} // namespace hop
