#pragma once

#include "Common/Monitor.h"
#include "Mesh/ConstrainedEdges.h"
#include "Surface/Particles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hop
{

/// A triangle mesh of the surface whose vertices are the particles.
struct SurfaceMesh
{
  /// Corners as indices into the particles, counterclockwise as seen from where the normals point to. Coincident
  /// particles keep their own indices.
  std::vector<std::array<int, 3>> triangles;
  /// What stayed open although it is no boundary curve: number of loops of edges with one triangle, and their length,
  /// world units.
  std::int64_t openLoops = 0;
  double openLength = 0.0;
  /// The longest of them: its length, and a particle on it; -1 if there is none.
  double longestLoop = 0.0;
  int onLongestLoop = -1;
  /// Particles without a triangle; of a discontinuous field, but for one or two of them in the midst of a surface that is
  /// closed without them.
  std::int64_t unusedParticles = 0;
  /// The particles on open loops, and those that are counted as unused, ascending; if there are none, those at turned
  /// triangles.
  std::vector<int> atFaults;
  /// Triangles that are turned away from the normal of a corner.
  std::int64_t turnedTriangles = 0;
  /// Pairs of a particle and one that was added in its place, because boundary curves touch there.
  std::vector<std::array<int, 2>> copies;
};

/// Joins particles to triangles: those that the Delaunay triangulations in the tangent planes of all three corners
/// agree about (ParticleStars.h). No edge has three triangles, and no triangle is turned away from the normal of one of
/// its corners, but for those that close holes which no others can (HoleFilling.h).
/// Derivation: Documentation/algorithm.md, section Mesh.
/// \param edges of the distribution as it is before
/// \param distribution may get particles where a hole is filled with new ones, and where boundary curves touch
/// \throw Interrupted if the monitor asks for an early end
SurfaceMesh meshSurface(const Isosurface& whole, ConstrainedEdges edges, Distribution& distribution,
  const Monitor& monitor, const ParallelFor& parallelFor);

/// Area of the surface around each particle, world units squared: its cell of the Voronoi diagram in its tangent plane,
/// cut off at boundary curves and creases. Needs no mesh.
/// \param edges of the distribution; those of before meshSurface() will do, as no particle that it adds is on one
/// \throw Interrupted if the monitor asks for an early end
std::vector<double> particleAreas(const Distribution& distribution, const ConstrainedEdges& edges,
  const Monitor& monitor, const ParallelFor& parallelFor);

} // namespace hop
