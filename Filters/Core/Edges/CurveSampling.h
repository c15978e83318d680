#pragma once

#include "Edges/CurveSegments.h"
#include "Edges/CurveTracing.h"

#include <array>
#include <vector>

namespace hop
{

/// Where particles are to stand on boundary curves and creases.
struct SampledPlaces
{
  std::vector<BoundaryPlace> places;
  /// Marks the places that begin a crease.
  std::vector<char> beginsCrease;
  /// Marks the places on corners.
  std::vector<char> isCorner;
  /// On a surface that is cut along creases: marks the places of closed curves so short that without one of them no
  /// triangle would be left.
  std::vector<char> isNeeded;
  /// Of places, one a curve.
  std::vector<CurveRange> ranges;
  /// Pairs of places that are one: inside creases, as their two sides see them, and at the ends of creases.
  std::vector<std::array<int, 2>> twins, corners;
};

/// Places on all curves: one on each corner, and between corners evenly at the spacing that the surface wants. The two
/// sides of a crease have the same, and each closed curve of a surface that is cut has three at least.
/// \param surface on which the curves were traced
/// \param isCut whether it is cut along creases
SampledPlaces samplePlaces(const Isosurface& surface, bool isCut, const TracedCurves& curves,
  CurveInterpolation& interpolation, const ParallelFor& parallelFor);

} // namespace hop
