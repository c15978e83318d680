#pragma once

#include "Elements/ElementMesh.h"

namespace hop
{

/// The field of an element over the unit cube, whatever the element's domain: a tetrahedron is a cube of which one face
/// has collapsed to a point and another one to an edge, a wedge is a cube of which one face has collapsed to an edge
/// (Duffy's map). A polynomial of degree p on a simplex is one of degree p along each axis of the cube.
/// Derivation: Documentation/algorithm.md, section Topology.
struct ElementCube
{
  Domain domain = Domain::Hexahedron;
  Degrees degrees{ 1, 1, 1 };
  /// Bernstein coefficients of F - c, or of w (F - c) if the element is rational; the first axis runs fastest.
  std::vector<double> values;
  /// Rounding errors of what bisection makes of the values.
  double slack = 0.0;
  /// The corner of the domain that each corner of the cube stands for, the first of those in one place: corners of the
  /// cube between which it has collapsed have equal entries. Corner c is at (c & 1, c >> 1 & 1, c >> 2).
  std::array<int, 8> corners{};
  /// Which corner of the simplex, or of the wedge's triangle, is the origin of the cube, and which ones its axes lead
  /// to.
  std::array<int, 4> roles{ 0, 1, 2, 3 };

  bool isFinite() const;

  /// Takes a place from the element's reference space to the cube. Where the cube has collapsed, to one of the places.
  glm::dvec3 inCube(const ReferencePoint& u) const;
  /// Takes a place from the cube to the element's reference space.
  ReferencePoint inElement(const glm::dvec3& t) const;
};

/// The cube is laid such that it collapses where the field is far from the isovalue, as leaves become small where the
/// surface passes the collapsed face closely.
ElementCube elementCube(const ElementMesh& mesh, int element, double isovalue);

} // namespace hop
