#pragma once

#include "Elements/ElementMesh.h"

#include <vector>

namespace hop
{

/// The elements of a mesh in an order that follows from the elements alone: along the Morton curve of their centroids,
/// those on one place of the curve by their coefficients. It depends neither on the order of the input's cells nor on
/// the ranks that they lie on, and neighbours in it are near each other. Ids of cells would not do: ParaView makes new
/// ones where it redistributes cells.
/// \return indices of elements; elements that are equal to the last bit keep their order
std::vector<int> canonicalOrder(const ElementMesh& mesh, const ParallelFor& parallelFor = {});

} // namespace hop
