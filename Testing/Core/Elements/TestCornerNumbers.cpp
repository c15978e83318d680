#include "Elements/CornerNumbers.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <set>

namespace hop::testing
{
namespace
{

/// The cube [-1,1]^3 in n^3 small cubes, squeezed along an axis and moved, with corners yet to be numbered.
ElementMesh plate(Domain domain, int axis, double thickness, double offset)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.cells = 2;
  recipe.map = [=](glm::dvec3 x)
  {
    x[axis] *= thickness;
    return x + offset;
  };
  ElementMesh mesh = makeMesh(recipe);
  for (Element& element : mesh.elements)
  {
    element.corners.fill(-1);
  }
  return mesh;
}

int distinctNumbers(const ElementMesh& mesh)
{
  std::set<std::int64_t> numbers;
  for (const Element& element : mesh.elements)
  {
    numbers.insert(element.corners.begin(), element.corners.end());
  }
  numbers.erase(-1);
  return static_cast<int>(numbers.size());
}

TEST(CornerNumbers, CellsThinAlongAnyAxisKeepTheirCorners)
{
  for (const Domain domain : allDomains)
  {
    for (const int axis : { 0, 1, 2 })
    {
      ElementMesh mesh = plate(domain, axis, 5e-3, 5e6);
      numberCorners(mesh, cornerTolerances(mesh));
      EXPECT_EQ(distinctNumbers(mesh), 27) << domain << ' ' << axis;
    }
  }
}

TEST(CornerNumbers, TolerancesAreAnElementsOwn)
{
  ElementMesh mesh;
  MeshRecipe recipe;
  appendBox(mesh, recipe, { -1, -1, -1 }, { 1, 1, 0 });
  appendBox(mesh, recipe, { -1, -1, 0 }, { 1, 1, 1e-4 });
  const std::vector<double> tolerances = cornerTolerances(mesh);
  EXPECT_DOUBLE_EQ(tolerances[0], 1e-5);
  EXPECT_NEAR(tolerances[1], 1e-6, 1e-12);
}

TEST(CornerNumbers, RoundingErrorsAreNoEdges)
{
  ElementMesh mesh;
  MeshRecipe recipe;
  std::vector<glm::dvec3> pyramid;
  for (const ReferencePoint& corner : facts(Domain::Hexahedron).corners)
  {
    pyramid.push_back(corner.xyz.z == 0.0 ? corner.xyz : glm::dvec3(0, 0, 1) + 1e-16 * corner.xyz);
  }
  appendElement(mesh, recipe, pyramid, {});
  const std::vector<double> tolerances = cornerTolerances(mesh);
  EXPECT_DOUBLE_EQ(tolerances[0], 1e-5);
  numberCorners(mesh, tolerances);
  EXPECT_EQ(distinctNumbers(mesh), 5);
}

TEST(CornerNumbers, ASheetBetweenSolidsIsNotJumpedOver)
{
  // Corners of the solids may be farther apart than the sheet is thick.
  const double offset = 1e5;
  const double thickness = 1e-3;
  ElementMesh mesh;
  MeshRecipe recipe;
  recipe.map = [=](const glm::dvec3& x) { return x + offset; };
  appendBox(mesh, recipe, { -1, -1, -1 }, { 1, 1, 0 });
  appendBox(mesh, recipe, { -1, -1, 0 }, { 1, 1, thickness });
  appendBox(mesh, recipe, { -1, -1, thickness }, { 1, 1, 1 });
  const std::vector<double> tolerances = cornerTolerances(mesh);
  EXPECT_GT(tolerances[0], thickness);
  numberCorners(mesh, tolerances);
  EXPECT_EQ(distinctNumbers(mesh), 16);
  findFaceNeighbors(mesh, tolerances);
  int joined = 0;
  for (int e = 0; e < 3; ++e)
  {
    for (int f = 0; f < MaximumFaces; ++f)
    {
      joined += mesh.neighbor(e, f).element >= 0;
      EXPECT_NE(mesh.neighbor(e, f).element, e);
    }
  }
  EXPECT_EQ(joined, 4);
}

} // namespace
} // namespace hop::testing
