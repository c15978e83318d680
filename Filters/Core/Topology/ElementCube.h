#pragma once

#include "Elements/ElementMesh.h"

namespace hop
{

/// How an element lies in the unit cube, whatever its domain: a tetrahedron is a cube of which one face has collapsed
/// to a point and another one to an edge, a wedge is a cube of which one face has collapsed to an edge (Duffy's map).
/// Corner c of the cube is at (c & 1, c >> 1 & 1, c >> 2); face 2 axis + side lies at 0 (side 0) or 1 (side 1) of the
/// axis.
struct CubeShape
{
  Domain domain = Domain::Hexahedron;
  /// The corner of the domain that each corner of the cube stands for, the first of those in one place: corners of the
  /// cube between which it has collapsed have equal entries.
  std::array<int, 8> corners{};
  /// The face of the domain that each face of the cube stands for; -1: it has collapsed to an edge or a point.
  std::array<int, 6> faces{};
  /// Of a tetrahedron, and of a wedge's triangle: which corner is the cube's origin, and which corners its axes lead
  /// to.
  std::array<int, 4> roles{ 0, 1, 2, 3 };

  /// The first corner of the domain in the place of a corner of the domain.
  int distinctCorner(int corner) const;

  /// Takes a place from the element's reference space to the cube. Where the cube has collapsed, to one of the places.
  glm::dvec3 inCube(const ReferencePoint& u) const;
  /// Takes a place from the cube to the element's reference space.
  ReferencePoint inElement(const glm::dvec3& t) const;
};

/// The field of an element over the unit cube. A polynomial of degree p on a simplex is one of degree p along each axis
/// of the cube.
/// Derivation: Documentation/algorithm.md, section Topology.
struct ElementCube
{
  CubeShape shape;
  Degrees degrees{ 1, 1, 1 };
  /// Bernstein coefficients of F - c, or of w (F - c) if the element is rational; the first axis runs fastest. Those
  /// that are zero to rounding are lifted to twice the slack, unless all are.
  std::vector<double> values;
  /// Rounding errors of what bisection makes of the values.
  double slack = 0.0;
  /// Whether values were lifted: the surface, or an end of it, is in a corner, an edge or a face.
  bool isLifted = false;

  bool isFinite() const;
};

/// The cube is laid such that it collapses where the field is far from the isovalue, as leaves become small where the
/// surface passes the collapsed place closely.
ElementCube elementCube(const ElementMesh& mesh, int element, double isovalue);

} // namespace hop
