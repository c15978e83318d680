#pragma once

#include "Common/Monitor.h"
#include "Edges/BoundaryCurves.h"
#include "Edges/CurveSegments.h"

#include <vector>

namespace hop
{

/// Of particles that are too near to each other the first stays; in meshes, one on a corner before others. If the surface
/// ends at both on the two sides of a slit, it goes on there, and the one that stays ends at no face, but for the other face of
/// a corner.
/// \param places what became of the places on all curves
/// \param ranges of places, one a curve
/// \param sampled with creases, for meshes, both sides of slits and strips keep their particles
/// \param curves their particles and places on creases; edges and thinned particles are added
void thinOut(std::vector<CurvePlace> places, const std::vector<CurveRange>& ranges,
  SampledCurves sampled, BoundaryCurves& curves, const ParallelFor& parallelFor);

} // namespace hop
