#pragma once

#include "Surface/Particles.h"

#include <array>
#include <vector>

namespace hop
{

/// Closes chains of directed edges. A boundary curve of a discontinuous field ends where the jump fades: there the
/// surface's boundary goes over to the curve of the other side, or back along its own other side.
///
/// Each end of a chain gets an edge to the beginning of a chain nearby. Where the chain of the other side is shorter or
/// longer, the longer one is followed back to the particle nearest to the end of the shorter one, by edges in the
/// opposite direction: a slit without width. A chain without any other nearby is followed back to its own beginning.
/// Derivation: Documentation/algorithm.md, section Mesh.
/// \param edges from particle to particle with the surface to the left, sorted, each once; so on return, too
void closeChains(const Distribution& distribution, std::vector<std::array<int, 2>>& edges);

} // namespace hop
