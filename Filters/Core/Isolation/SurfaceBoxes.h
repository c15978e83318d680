#pragma once

#include "Common/Monitor.h"
#include "Isolation/SurfaceBox.h"

#include <functional>
#include <vector>

namespace hop
{

/// Isolates the surface: splits every element until each box provably holds one sheet and is small enough, or stays
/// undecided (ElementSplitter.h). All of the surface lies in the boxes returned. Every component that is larger than
/// 2^-(MaximumBisections/3) of an element, or has no critical point near it, lies in certified boxes. Bounds are
/// widened by the rounding errors of the bisections. Elements with a coefficient that is NaN or infinite give no boxes.
/// Derivation: Documentation/algorithm.md, section Isolation.
/// \param largestSize largest SurfaceBox::size of certified boxes, world units, > 0
/// \return boxes in the order of the elements, the same for any number of threads
std::vector<SurfaceBox> findSurfaceBoxes(
  const ElementMesh& mesh, double isovalue, double largestSize, const ParallelFor& parallelFor);

/// Boxes of a surface that were found before, in the order of the elements.
struct KnownBoxes
{
  /// nullptr: there are none.
  const std::vector<SurfaceBox>* boxes = nullptr;
  /// Whether a box may stay as it is: an element all of whose boxes may keeps them. Called from several threads.
  std::function<bool(const SurfaceBox&)> mayStay;
};

/// The same with a size that depends on the box.
/// \param isFineEnough whether a certified box is small enough; called from several threads
/// \param progress receives the share of the work that is done, 0 to 1; called from several threads
std::vector<SurfaceBox> findSurfaceBoxes(const ElementMesh& mesh, double isovalue,
  const std::function<bool(const SurfaceBox&)>& isFineEnough, const ParallelFor& parallelFor,
  const std::function<void(double)>& progress = {}, const KnownBoxes& known = {});

} // namespace hop
