#pragma once

#include "Elements/ElementMesh.h"

#include <vector>

namespace hop
{

/// A cube around all elements, with and without surface.
struct MeshCube
{
  glm::dvec3 lower{ 0.0 };
  double side = 1.0;
};

/// The elements of a mesh in an order that follows from the elements alone: along the Morton curve of their centroids,
/// those on one place of the curve by their coefficients. It depends neither on the order of the input's cells nor on
/// the ranks that they lie on nor on which other elements there are, and neighbours in it are near each other. Ids of
/// cells would not do: ParaView makes new ones where it redistributes cells.
/// \return indices of elements; elements that are equal to the last bit keep their order
std::vector<int> canonicalOrder(
  const ElementMesh& mesh, const MeshCube& cube, const ParallelFor& parallelFor = {});

} // namespace hop
