#pragma once

#include "Elements/ElementMesh.h"

#include <functional>

namespace hop::testing
{

using Map = std::function<glm::dvec3(const glm::dvec3&)>;
using Field = std::function<double(const glm::dvec3&)>;

/// How a test mesh is made: the cube [-1,1]^3 in cells^3 small cubes, each one hexahedron, two
/// wedges or six tetrahedra of the given degrees, bent by `map`.
struct MeshRecipe
{
  Domain domain = Domain::Hexahedron;
  Degrees degrees{ 2, 2, 2 };
  int cells = 2;
  /// World position of a point of the straight cube; the elements interpolate it at their nodes.
  Map map = [](const glm::dvec3& x) { return x; };
  /// Field as a function of world position, interpolated at the nodes too.
  Field field = [](const glm::dvec3& x) { return x.x; };
};

/// The mesh with its face neighbours found.
ElementMesh makeMesh(const MeshRecipe& recipe);

/// findFaceNeighbors() of ElementMesh.h with one tolerance for all elements.
void findFaceNeighbors(ElementMesh& mesh, double tolerance);

/// One element of the given corners (in the order of facts(domain).corners), straight-sided before
/// `map` bends it.
void appendElement(ElementMesh& mesh, const MeshRecipe& recipe,
  const std::vector<glm::dvec3>& corners, const std::vector<std::int64_t>& numbers);

/// The reference domain as one straight element of a degree, with a field over it.
ElementMesh referenceMesh(Domain domain, int degree, const Field& field);

/// The box between two corners, straight-sided before `map` bends it, as one hexahedron, two wedges or
/// six tetrahedra. Corners in one place have one number, whichever box they belong to.
void appendBox(
  ElementMesh& mesh, const MeshRecipe& recipe, const glm::dvec3& lower, const glm::dvec3& upper);

/// The cube [-1,1]^3 in two halves whose faces at x = 0 do not match: the left half is one box of the recipe `left`,
/// the right half 2 x 2 boxes of the recipe `right`. Face neighbours are found.
ElementMesh hangingMesh(const MeshRecipe& left, const MeshRecipe& right);

/// The surface x^4 (x + 1) / 2 = y^2 + z^2 in a box of 2 x 2 x 2 elements that a quadratic B-spline map bends. It ends
/// in a needle, whose thickness vanishes at x = 0.
ElementMesh needleMesh();

/// The paper's teardrop: a sphere in reference space, which a quadratic B-spline map of 2 x 2 x 2 spans carries to a
/// body that tapers to one end. The paper gives no control points; these are our own.
ElementMesh teardropMesh();

/// A mesh as large as the paper's flow around a cylinder: 5,040 hexahedra and 696 wedges of degree 3. Thirty sectors
/// and 28 rings of hexahedra, six layers, around a cylinder along the z axis; two outer rings of wedges, but for one
/// sector. The field is the pressure of a vortex street: low in the middle of vortices of alternating sides, at x > 0,
/// which waver along z.
ElementMesh vortexStreetMesh();

/// A smooth bend of the cube, invertible, that moves points by up to `amount`.
Map wavyMap(double amount);

/// All domains, for tests that go through every one of them.
inline const std::array<Domain, 3> allDomains{ Domain::Hexahedron, Domain::Tetrahedron,
  Domain::Wedge };

/// Number of faces without neighbour on which a place lies.
int boundaryFaceCount(const ElementMesh& mesh, const Location& location);

/// A point inside the domain from three numbers in [0,1).
ReferencePoint insidePoint(Domain domain, glm::dvec3 t);

} // namespace hop::testing
