#pragma once

#include "Elements/GatheredMesh.h"

#include <vector>

namespace hop::testing
{

/// Cells of the input of every rank, more than have elements.
constexpr std::int64_t CellsOfRank = 1000;

/// The elements of a mesh, each on a rank by chance, with the number of its cell there. Ranks may have none.
std::vector<ElementMesh> scattered(const ElementMesh& whole, int ranks, unsigned seed);

/// The elements of all ranks at the worker, in canonical order and joined. Every rank calls it.
GatheredMesh gatheredAt(Exchange& exchange, int worker, ElementMesh& mine);

/// The same of the only rank.
GatheredMesh gatheredAlone(ElementMesh mesh);

} // namespace hop::testing
