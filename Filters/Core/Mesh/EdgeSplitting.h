#pragma once

#include "Surface/Particles.h"

#include <array>
#include <vector>

namespace hop
{

/// Splits boundary edges at the particles inside the surface that stand on them, or beyond their chords: a triangle
/// between would have no area, or be turned away. Edges that have an opposite, and sides of creases, stay. An edge goes that
/// leads over a particle by which two other edges lead the same way.
/// \param edges from particle to particle with the surface to the left, sorted, each once; so on return, too
void splitAtParticles(const Distribution& distribution, std::vector<std::array<int, 2>>& edges);

} // namespace hop
