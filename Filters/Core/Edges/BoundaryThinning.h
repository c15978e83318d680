#pragma once

#include "Common/Monitor.h"
#include "Edges/BoundaryCurves.h"
#include "Edges/CurveSegments.h"

#include <vector>

namespace hop
{

/// Which particles are too near to each other.
enum class ThinnedCurves
{
  /// On two sides of a slit, too: splats close it.
  OfSplats,
  /// Not on two sides of a slit or a strip: each has boundary edges of a mesh.
  OfMesh,
  /// Nor in two elements at a jump, or on two sides of a face at which the surface ends: pieces of a mesh of a discontinuous
  /// field.
  OfPieces
};

/// Of particles that are too near to each other the first stays; in meshes, one on a corner before others. If the surface
/// ends at both on the two sides of a slit, it goes on there, and the one that stays ends at no face, but for the other face of
/// a corner.
/// \param mesh that the particles are on
/// \param places what became of the places on all curves
/// \param ranges of places, one a curve
/// \param curves their particles and places on creases; edges and thinned particles are added
void thinOut(const ElementMesh& mesh, std::vector<CurvePlace> places,
  const std::vector<CurveRange>& ranges, ThinnedCurves wanted, BoundaryCurves& curves,
  const ParallelFor& parallelFor);

} // namespace hop
