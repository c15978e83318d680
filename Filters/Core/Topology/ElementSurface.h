#pragma once

#include "Topology/ElementCube.h"
#include "Topology/LeafTests.h"

namespace hop
{

/// Where a curve of the surface in a face of an element ends: on an edge of the element.
struct CurveEnd
{
  /// Corners of the domain that the edge joins, as in ElementCube::corners, the lesser one first.
  std::array<int, 2> edge{};
  /// The how-manieth point of the surface on the edge it is, counted from the edge's first corner, and of how many.
  int order = 0;
  int count = 0;
  /// Number among the element's points.
  int point = -1;
};

/// A curve in which the surface meets a face of an element's cube.
struct FaceCurve
{
  /// Face of the cube.
  int face = 0;
  int piece = -1;
  /// Whether it has no ends.
  bool isClosed = false;
  /// Whether a part of it is missing.
  bool isBroken = false;
  std::array<CurveEnd, 2> ends;
  /// Bounds of a closed curve, and the segment of an edge of one of its leaves in which it has a point; in the cube.
  glm::dvec3 lower{ 0.0 }, upper{ 0.0 };
  std::array<glm::dvec3, 2> segment{};
};

/// A connected piece of the surface in an element.
struct SurfacePiece
{
  int eulerCharacteristic = 0;
  bool proven = true;
};

/// A leaf that holds a disc of the surface.
struct DiscLeaf
{
  /// Lower corner in units of the smallest leaf, and the leaf's size in these.
  glm::ivec3 lower{ 0 };
  int size = 0;
  /// See LeafTests.
  std::uint8_t signs = 0;
  int piece = -1;
};

/// The surface in one element.
struct ElementSurface
{
  std::vector<SurfacePiece> pieces;
  std::vector<FaceCurve> curves;
  /// Points of the surface on the edges of the cube.
  int pointCount = 0;
  /// Sorted for pieceAt().
  std::vector<DiscLeaf> leaves;
  /// Leaves of which nothing is proven.
  int unresolvedLeaves = 0;
  /// Which corner of the domain and face of the domain is behind each of the cube; face -1: the cube has collapsed there.
  std::array<int, 6> domainFaces{};
  ElementCube shape;

  /// The piece in the leaf at a place or, if the leaf holds none, in the nearest one; -1 if there is none at all.
  /// \param t in the cube
  int pieceAt(const glm::dvec3& t) const;
};

} // namespace hop
