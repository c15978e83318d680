#pragma once

#include "Edges/BoundaryTracer.h"

#include <vector>

namespace hop
{

/// A stretch of a curve between two corners: a part of a boundary curve, or a crease in one face as one side of the face
/// sees it.
struct CurveStretch
{
  /// Number of its trace, and its first and last vertex there.
  std::size_t trace = 0, first = 0, last = 0;
  /// Whether nothing follows its last vertex: the trace is open, and ends there.
  bool withEnd = false;
  /// Whether it is a closed curve with no more than one corner.
  bool isRing = false;
  /// Face of its element if the surface is cut along it, else -1.
  int creaseFace = -1;
};

/// Finds out which stretches are one crease, as its two sides see it. They run along the same face, one of them to and
/// the other fro.
/// \param nearness largest distance of their ends, world units
/// \return for each stretch the number of the one on the other side; -1: there is none
std::vector<int> partnersOf(const ElementMesh& mesh, const std::vector<BoundaryTrace>& traces,
  const std::vector<CurveStretch>& stretches, double nearness);

} // namespace hop
