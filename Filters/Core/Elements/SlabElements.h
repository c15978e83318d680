#pragma once

#include "Elements/ElementMesh.h"
#include "Support/Slab.h"

#include <array>
#include <vector>

namespace hop
{

/// The smallest and the largest place of an element's control points along a direction: the element lies between.
std::array<double, 2> extentAlong(const BernsteinForm& form, const glm::dvec3& direction);

/// Indices of the elements that may reach into a slab, ascending.
std::vector<int> elementsIn(
  const ElementMesh& mesh, const Slab& slab, const ParallelFor& parallelFor);

/// Marks the elements of which a part may lie outside of a slab.
std::vector<char> reachingOutOf(
  const ElementMesh& mesh, const Slab& slab, const ParallelFor& parallelFor);

} // namespace hop
