#pragma once

#include "Common/Monitor.h"
#include "Isolation/SurfaceBox.h"

namespace hop
{

/// Splits every element until boxes hold one sheet each, provably, and are small enough, or cannot be decided
/// (ElementSplitter.h). All of the surface lies in the boxes returned, and every component of it that is larger than
/// 2^-(MaximumBisections/3) of an element, or has no critical point near, in certified ones. Bounds
/// are widened by the rounding errors of the splitting. Elements with a coefficient that is NaN or
/// infinite give no boxes.
/// \param wantedSize of certified boxes at most; world units, > 0
/// \param isSmall instead: whether a certified box is small enough; called from several threads
/// \param found is told what share of the work is done, 0 to 1; called from several threads
/// \return boxes in the order of the elements, the same for any number of threads
std::vector<SurfaceBox> findSurfaceBoxes(
  const ElementMesh& mesh, double isovalue, double wantedSize, const ParallelFor& parallelFor);
std::vector<SurfaceBox> findSurfaceBoxes(const ElementMesh& mesh, double isovalue,
  const std::function<bool(const SurfaceBox&)>& isSmall, const ParallelFor& parallelFor,
  const std::function<void(double)>& found = {});

} // namespace hop
