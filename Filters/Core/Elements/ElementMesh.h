#pragma once

#include "Common/Monitor.h"
#include "Elements/Bernstein.h"
#include "Elements/ExactField.h"

#include <cstdint>
#include <limits>

namespace hop
{

/// What lies behind a face of an element.
struct FaceNeighbor
{
  /// Index of the neighbour, or -1: nothing is joined to the face.
  int element = -1;
  /// The face of the neighbour that is joined to this one.
  std::uint8_t face = 0;
  /// For each corner of this face, in its ring, the neighbour's corner that coincides with it.
  std::array<std::uint8_t, 4> corners{};
};

/// An element in Bernstein form, within an ElementMesh.
struct Element
{
  Domain domain = Domain::Hexahedron;
  Degrees degrees{ 1, 1, 1 };
  /// Index of its first coefficient (and weight) in the mesh.
  std::size_t firstCoefficient = 0;
  bool rational = false;
  /// Elements that share the limits of a cell (UndecidedPieces.h), at least 1: the parts of the cell that hold surface.
  std::uint16_t partsOfCell = 1;
  /// Index in the mesh's exactFields, or -1: the polynomial is the field.
  int exactField = -1;
  /// Cell of the input that the element was made of.
  std::int64_t cell = -1;
  /// A number for each corner. Corners with equal numbers coincide, within the mesh and within the element: a
  /// pyramid is a hexahedron whose four upper corners coincide.
  std::array<std::int64_t, MaximumCorners> corners{};
};

/// Index of a face in arrays that hold MaximumFaces entries an element.
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
  /// Fields that stand in for those of polynomials wherever particles are; proofs are of the polynomials.
  std::vector<ExactField> exactFields;
  /// The coefficients of exactFields.
  std::vector<Coefficient> exactCoefficients;
  /// MaximumFaces entries an element; empty until findFaceNeighbors has run.
  std::vector<FaceNeighbor> neighbors;

  BernsteinForm form(int element) const
  {
    const Element& e = this->elements[element];
    return { e.domain, e.degrees, this->coefficients.data() + e.firstCoefficient,
      e.rational ? this->weights.data() + e.firstCoefficient : nullptr };
  }

  /// \pre the element has an exact field
  const ExactField& exactField(int element) const
  {
    return this->exactFields[this->elements[element].exactField];
  }

  /// Leaves the elements without their fields.
  void releaseFields()
  {
    this->coefficients = {};
    this->weights = {};
    this->exactFields = {};
    this->exactCoefficients = {};
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

/// What particles stand on at a place: value and derivatives to first order, or to second, of the exact field if the
/// element has one.
Jet exactGradient(const ElementMesh& mesh, const Location& at);
Jet exactHessian(const ElementMesh& mesh, const Location& at);

/// Diagonal of the bounds of all control points, world units.
/// \pre there are elements
double meshExtent(const ElementMesh& mesh);

/// Fills mesh.neighbors: two faces are joined when their corners carry the same numbers and their
/// middles coincide within a tolerance (two curved faces may share all corners and still be
/// different). A quadrilateral with two coincident corners is a triangle and is joined to triangles. Where three or
/// more faces have the same corners, none of them is joined; nor are two faces of one element.
/// \param tolerances one an element, world units; between two elements the smaller one counts
void findFaceNeighbors(
  ElementMesh& mesh, const std::vector<double>& tolerances, const ParallelFor& parallelFor = {});

/// The same place in the element behind a face.
/// \pre the place lies on the face, and the face has a neighbour
Location crossFace(const ElementMesh& mesh, const Location& location, int face);

} // namespace hop
