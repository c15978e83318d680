#pragma once

#include "Common/Monitor.h"
#include "Elements/Bernstein.h"

#include <cstdint>
#include <limits>

namespace hop
{

/// What lies behind a face of an element.
struct FaceNeighbor
{
  /// Index of the neighbour, or -1: the face is a boundary.
  int element = -1;
  /// The neighbour's face.
  std::uint8_t face = 0;
  /// For each corner of this face the neighbour's corner that coincides with it.
  std::array<std::uint8_t, 4> corners{};
};

/// An element in Bernstein form, within an ElementMesh.
struct Element
{
  Domain domain = Domain::Hexahedron;
  Degrees degrees{ 1, 1, 1 };
  std::size_t firstCoefficient = 0;
  bool rational = false;
  /// Cell of the input that it came from.
  std::int64_t cell = -1;
  /// Equal numbers name coincident corners, within the mesh and within the element: the domain of a
  /// pyramid is a hexahedron whose upper corners coincide.
  std::array<std::int64_t, MaximumCorners> corners{};
};

/// Where what belongs to a face stands in arrays of MaximumFaces entries an element.
inline std::size_t faceSlot(int element, int face)
{
  return static_cast<std::size_t>(element) * MaximumFaces + face;
}

/// The elements that can hold surface, and how they join.
struct ElementMesh
{
  std::vector<Element> elements;
  std::vector<Coefficient> coefficients;
  /// As long as `coefficients`, or empty where no element is rational.
  std::vector<double> weights;
  /// MaximumFaces entries an element; empty until findFaceNeighbors has run.
  std::vector<FaceNeighbor> neighbors;

  BernsteinForm form(int element) const
  {
    const Element& e = this->elements[element];
    return { e.domain, e.degrees, this->coefficients.data() + e.firstCoefficient,
      e.rational ? this->weights.data() + e.firstCoefficient : nullptr };
  }

  const Face& face(int element, int face) const
  {
    return facts(this->elements[element].domain).faces[face];
  }

  const FaceNeighbor& neighbor(int element, int face) const
  {
    return this->neighbors[faceSlot(element, face)];
  }
};

/// A place in the mesh.
struct Location
{
  int element = -1;
  ReferencePoint u;
};

/// Diagonal of the bounds of all control points, world units.
/// \pre there are elements
double meshExtent(const ElementMesh& mesh);

/// Fills mesh.neighbors: two faces are joined when their corners carry the same numbers and their
/// middles coincide within a tolerance (two curved faces may share all corners and still be
/// different). A quadrilateral of which two corners coincide joins triangles. Where three
/// or more elements claim one face, none is joined, nor are two faces of one element.
/// \param tolerances one an element, world units; of two the smaller one counts
void findFaceNeighbors(
  ElementMesh& mesh, const std::vector<double>& tolerances, const ParallelFor& parallelFor = {});

/// The same place, seen from the element behind `face`, on which `location` lies.
/// \pre the face has a neighbour
Location crossFace(const ElementMesh& mesh, const Location& location, int face);

} // namespace hop
