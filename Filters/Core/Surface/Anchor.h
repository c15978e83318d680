#pragma once

#include "Elements/BatchEvaluator.h"
#include "Support/Buffer.h"
#include "Surface/Patch.h"
#include "Surface/SurfaceWalker.h"

#include <algorithm>
#include <vector>

namespace hop
{

/// Ties a patch of the surface to the mesh: the place at which the field was evaluated.
struct Anchor
{
  Location place;
  /// K = J^-1 at the place. Single precision is enough: K turns steps of the size of a spacing into reference
  /// coordinates, and the next evaluation sees its errors.
  glm::mat3 pull{ 0.0f };
  /// Distance from the place to the surface along the patch's normal, to second order in the field.
  float offset = 0.0f;
};

/// The patch and the anchor that belong to an evaluation. The patch's spacing is left as it is. From the place the
/// surface is sought along the field's gradient, to second order (Documentation/algorithm.md, section Geometry in world
/// space).
/// \return false, and nothing changed, where the element is singular, the gradient vanishes or
///   anything is not finite
bool anchorPatch(
  const Location& place, const Jet& jet, double isovalue, Anchor& anchor, Patch& patch);
/// The same from an evaluation with its Hessian; the offset is of second order along the straight line in world space,
/// not along the one in reference space.
bool anchorPatch(const Evaluated& at, Anchor& anchor, Patch& patch);

/// The patch and the anchor at another place of the element, extrapolated: the map to first order, the surface to
/// second order around the known patch. Costs no evaluation.
void continuePatch(const Anchor& knownAnchor, const Patch& known, const Location& place,
  Anchor& anchor, Patch& patch);

/// Indices of places, or of anchors, sorted by element; the sort is stable.
std::vector<int> orderByElement(
  const std::vector<Location>& places, std::size_t elementCount, const ParallelFor& parallelFor);
std::vector<int> orderByElement(
  const Buffer<Anchor>& anchors, std::size_t elementCount, const ParallelFor& parallelFor);

/// Calls use(i, jet) with the value and derivatives to second order at places[i], i = order[n] for n
/// in [begin, end). Places next to each other in the order that share an element are evaluated
/// together.
template <class Use>
void evaluateInOrder(const ElementMesh& mesh, const std::vector<Location>& places,
  const std::vector<int>& order, std::ptrdiff_t begin, std::ptrdiff_t end, const Use& use)
{
  // Points evaluated together: enough to fill the kernels' vectors, few enough for the first-level cache (20 KiB of
  // jets).
  constexpr std::ptrdiff_t batchSize = 64;
  std::array<ReferencePoint, batchSize> points;
  JetBatch jets;
  for (std::ptrdiff_t first = begin; first < end;)
  {
    const int element = places[order[first]].element;
    if (mesh.elements[element].exactField >= 0)
    {
      use(order[first], exactHessian(mesh, places[order[first]]));
      ++first;
      continue;
    }
    std::ptrdiff_t last = first;
    for (; last < std::min(end, first + batchSize) && places[order[last]].element == element;
         ++last)
    {
      points[last - first] = places[order[last]].u;
    }
    evaluateHessians(mesh.form(element), points.data(), static_cast<int>(last - first), jets);
    for (std::ptrdiff_t n = first; n < last; ++n)
    {
      use(order[n], jets.jet(static_cast<int>(n - first)));
    }
    first = last;
  }
}

} // namespace hop
