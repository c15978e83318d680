#pragma once

#include "Surface/ActiveFaces.h"

#include <cstdint>
#include <vector>

namespace hop
{

/// Number of faces of the element of a place.
int faceCount(const ElementMesh& mesh, const Location& location);

/// Numbers of a face's corners in the mesh, ascending.
std::vector<std::int64_t> cornersOf(const ElementMesh& mesh, const Location& location, int face);

/// Numbers of the corners that two faces of an element share, ascending.
std::vector<std::int64_t> edgeBetween(
  const ElementMesh& mesh, const Location& location, int faceA, int faceB);

/// The face of an element, other than the one by which it was entered, that has the corners of an edge; -1 if there is
/// none.
int faceAtEdge(const ElementMesh& mesh, const Location& location, int entry,
  const std::vector<std::int64_t>& edge);

/// A face of an element, other than a given one, on which a place lies; -1 if there is none.
int otherFaceAt(const ElementMesh& mesh, const Location& location, int one, double accuracy);

/// The foot in reference space of a place on the plane of a face.
Location ontoFace(const ElementMesh& mesh, const Location& location, int face);

} // namespace hop
