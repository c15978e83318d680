#pragma once

#include "Mesh/ConstrainedEdges.h"

#include <array>
#include <vector>

namespace hop
{

/// Takes triangles without height out of a mesh, as are left where particles have moved onto each other or onto a line.
/// Edges much shorter than the spacing are contracted, edges on which the opposite corner stands are flipped. The topology
/// stays (an edge may be contracted if the links of its ends share no more than its own, Dey, Edelsbrunner, Guha and
/// Nekhayev 1999), and no triangle with a height is turned away from the normal of a corner.
/// \param edges whose particles stay in their places, if one of two does
/// \param vertices for each particle the first one in the same place: the ends of contracted edges get the same
/// \param triangles with particles as corners, counterclockwise
void removeSlivers(const ConstrainedEdges& edges, Buffer<Particle>& particles,
  std::vector<int>& vertices, std::vector<std::array<int, 3>>& triangles);

} // namespace hop
