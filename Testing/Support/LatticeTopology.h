#pragma once

#include "TestMeshes.h"

#include <utility>
#include <vector>

namespace hop::testing
{

/// Euler characteristic and boundary loops of each component of {field = 0} in the cube [-1,1]^3, sorted, as marching
/// tetrahedra find them from the signs at a lattice of n^3 small cubes. It shares no code with what it is to judge.
std::vector<std::pair<int, int>> latticeTopology(const Field& field, int n);

} // namespace hop::testing
