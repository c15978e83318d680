#pragma once

#include "Mesh/ConstrainedEdges.h"
#include "Mesh/TriangleFans.h"
#include "Surface/SurfaceWalker.h"

#include <vector>

namespace hop
{

/// Marks particles that have another one in their place.
/// \param places for each particle the first one in its place
std::vector<char> marksOfShared(const std::vector<int>& places);

/// Makes one of the particles in one place between which an edge without length would lead, as no triangle has one: of those
/// that follow each other on a boundary curve or crease, as at corners of elements that are as small as rounding, and of
/// those on the two sides of a crease where it ends in the midst of the surface. The other one stays in its place, and on no
/// edge.
void uniteEnds(Distribution& distribution);

/// Splits edges between two places that are joined by another sheet, or by a crease, too: where creases meet within a
/// spacing, several sheets may end in the same two places, and an edge would have more than two triangles. Each sheet but
/// one gets a particle of its own in the middle of the edge. Edges below whose middle no surface is found stay.
/// \param places for each particle the first one in its place
/// \param distribution receives the particles that are added
void splitSharedEdges(const Isosurface& surface, const std::vector<int>& places,
  Distribution& distribution, TriangleFans& fans, const ParallelFor& parallelFor);

} // namespace hop
