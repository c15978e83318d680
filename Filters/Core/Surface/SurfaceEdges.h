#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hop
{

/// What the particles on boundary curves and creases are to each other.
struct SurfaceEdges
{
  /// Pairs of particles that are neighbours on a boundary curve: edges of any mesh of the surface.
  std::vector<std::array<int, 2>> segments;
  /// Pairs of particles that follow each other on one side of a crease, or on a boundary curve between creases, with the
  /// surface of this side to their left as seen from where the normals point to: edges of any mesh as well. The segments
  /// among them are in `segments`, too.
  std::vector<std::array<int, 2>> directed;
  /// Pairs of particles in the same place on the two sides of a crease (more at corners, where each pair joins two of
  /// them): one vertex of any mesh.
  std::vector<std::array<int, 2>> coincident;
  /// Particles on no edge, because another one in the same place is on theirs: no corners of a mesh. See uniteEnds().
  std::vector<int> replaced{};
};

/// For each of the particles the first one in the same place: itself, but for creases.
std::vector<int> firstInPlace(const SurfaceEdges& edges, std::size_t particles);

} // namespace hop
