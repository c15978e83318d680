#pragma once

#include "Topology/ElementLeaves.h"

#include <optional>

namespace hop
{

/// Where a curve of the surface in a face of an element ends: on an edge of the element.
struct CurveEnd
{
  /// Corners of the domain that the edge joins, as in CubeShape::corners, the lesser one first.
  std::array<int, 2> edge{};
  /// The how-manieth point of the surface on the edge of the cube it is, counted from the edge's first corner, and of
  /// how many.
  int order = 0;
  int count = 0;
  /// Number among the element's points on edges.
  int point = -1;
  /// A segment of the edge that holds the point and no other one; in the cube.
  std::array<glm::dvec3, 2> segment{};
};

/// A curve in which the surface meets a face of an element's cube.
struct FaceCurve
{
  /// Face of the cube.
  int face = 0;
  int piece = -1;
  /// Whether it has no ends.
  bool isClosed = false;
  /// Whether a part of it is not known.
  bool isBroken = false;
  std::array<CurveEnd, 2> ends;
  /// A segment in the cube that holds a point of the curve and no other one: an edge of one of its leaves.
  std::array<glm::dvec3, 2> segment{};
  /// Indices of the leaves that it passes.
  std::vector<int> leaves;
};

/// A connected piece of the surface in an element.
struct SurfacePiece
{
  int eulerCharacteristic = 0;
  bool proven = true;
};

/// The surface in one element.
struct ElementSurface
{
  CubeShape shape;
  std::vector<SurfacePiece> pieces;
  std::vector<FaceCurve> curves;
  /// Number of points of the surface on edges of the cube.
  int pointCount = 0;
  /// The leaves that hold discs, in the order of leafOrder(), and the pieces that the discs belong to.
  std::vector<Leaf> leaves;
  std::vector<int> pieceOfLeaf;
  /// Whether there are leaves of which nothing is proven.
  bool isResolved = true;
  /// ElementCube::isLifted: the surface in a face may be found in the element behind alone.
  bool isLifted = false;

  /// The leaf at a place or, if there is none, the nearest one; -1 if there is no surface at all.
  /// \param t in the cube
  int leafAt(const glm::dvec3& t) const;
  /// The piece in that leaf, or -1.
  int pieceAt(const glm::dvec3& t) const;
  /// The curve through a point of the surface on a face of the cube; -1 if the leaf there shows none.
  int curveAt(int face, const glm::dvec3& t) const;
};

/// Finds the surface in one element.
/// \param tests kept from one element to the next, as they are the same for the same degrees
ElementSurface findElementSurface(const ElementMesh& mesh, int element, double isovalue,
  std::optional<LeafTests>& tests, const ParallelFor& parallelFor = {});

/// Finds the surfaces in several elements: each thread in some of them, and all threads together in one after the other
/// of those that take long, so that the caller is asked meanwhile.
/// \return one an element
std::vector<ElementSurface> findElementSurfaces(const ElementMesh& mesh,
  const std::vector<int>& elements, double isovalue, const ParallelFor& parallelFor);

/// Joins the discs in the leaves of an element to pieces of the surface:
///   Euler characteristic = discs - arcs in faces of leaves + points on edges of leaves.
/// Of a face between one leaf and several smaller ones the arcs of the smaller ones count, likewise of edges.
/// Derivation: Documentation/algorithm.md, section Topology.
/// \param parallelFor asks the caller where there are many leaves; the work is one thread's
ElementSurface joinLeaves(
  const CubeShape& shape, ElementLeaves leaves, const ParallelFor& parallelFor = {});

} // namespace hop
