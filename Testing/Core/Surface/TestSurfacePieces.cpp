#include "Surface/SurfacePieces.h"

#include "Elements/ElementMesh.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hop::testing
{
namespace
{

/// Eight hexahedra whose surface ends at the faces that `ends` marks.
struct Cut
{
  template <class Ends>
  explicit Cut(const Ends& ends)
  {
    tolerances.assign(MaximumFaces * mesh.elements.size(), std::numeric_limits<float>::infinity());
    for (int element = 0; element < static_cast<int>(mesh.elements.size()); ++element)
    {
      for (int face = 0; face < 6; ++face)
      {
        if (mesh.neighbor(element, face).element >= 0 && ends(element, face))
        {
          tolerances[faceSlot(element, face)] = 0.0f;
        }
      }
    }
    pieces = SurfacePieces(mesh, tolerances);
  }

  /// A place by an element and its coordinates there.
  static Location at(int element, double x, double y, double z)
  {
    return { element, { glm::dvec3(x, y, z) } };
  }

  ElementMesh mesh = makeMesh({ Domain::Hexahedron, { 1, 1, 1 }, 2 });
  std::vector<float> tolerances;
  SurfacePieces pieces;
};

/// The face of an element whose inward normal is a direction of the reference space.
int faceTowards(const ElementMesh& mesh, int element, const glm::dvec3& inward)
{
  for (int face = 0; face < 6; ++face)
  {
    if (glm::dot(mesh.face(element, face).inward.xyz, inward) > 0.5)
    {
      return face;
    }
  }
  return -1;
}

TEST(SurfacePieces, OfAContinuousFieldAreOne)
{
  const SurfacePieces one;
  EXPECT_TRUE(one.areOne());
  EXPECT_TRUE(one.areSame(Cut::at(0, 0, 0, 0), Cut::at(5, 0, 0, 0)));
  EXPECT_TRUE(one.jumpTolerances().empty());
}

TEST(SurfacePieces, EndBetweenLayersOfElements)
{
  // Along all faces between the lower and the upper four elements.
  const ElementMesh whole = Cut([](int, int) { return false; }).mesh;
  const Cut cut(
    [&](int element, int face) { return std::abs(whole.face(element, face).inward.xyz.z) > 0.5; });
  int same = 0;
  for (int element = 0; element < 8; ++element)
  {
    same += cut.pieces.areSame(Cut::at(0, 0, 0, 0), Cut::at(element, 0, 0, 0));
  }
  EXPECT_EQ(same, 4);
  EXPECT_EQ(cut.pieces.jumpTolerances(), cut.tolerances);
}

TEST(SurfacePieces, HoldPlacesOnTheirEnds)
{
  const ElementMesh whole = Cut([](int, int) { return false; }).mesh;
  const int top = faceTowards(whole, 0, { 0.0, 0.0, -1.0 });
  const int above = whole.neighbor(0, top).element;
  ASSERT_GE(above, 0);
  // A slit: the pieces on its two sides are one, around its end.
  const Cut cut(
    [&](int element, int face)
    {
      const int behind = whole.neighbor(element, face).element;
      return (element == 0 && behind == above) || (element == above && behind == 0);
    });
  const auto areOnEnd = [&](const Location& a, const Location& b)
  { return cut.pieces.areOnEnd(cut.mesh, a, b); };
  EXPECT_TRUE(cut.pieces.areSame(Cut::at(0, 0, 0, 0), Cut::at(above, 0, 0, 0)));
  EXPECT_TRUE(cut.pieces.endBetween(cut.mesh, 0, above));
  EXPECT_TRUE(cut.pieces.endBetween(cut.mesh, above, 0));
  EXPECT_FALSE(cut.pieces.endBetween(cut.mesh, 0, 7)) << "no neighbours";
  EXPECT_FALSE(SurfacePieces().endBetween(cut.mesh, 0, above)) << "a continuous field";
  EXPECT_TRUE(areOnEnd(Cut::at(0, 0.2, 0.3, 1.0), Cut::at(0, 0.7, 0.6, 1.0)));
  EXPECT_FALSE(areOnEnd(Cut::at(0, 0.2, 0.3, 1.0), Cut::at(0, 0.7, 0.6, 0.9)));
  // On an edge of the slit, by the number of the element beside it.
  const int side = faceTowards(whole, 0, { -1.0, 0.0, 0.0 });
  const int beside = whole.neighbor(0, side).element;
  ASSERT_GE(beside, 0);
  EXPECT_TRUE(areOnEnd(Cut::at(0, 0.2, 0.3, 1.0), Cut::at(beside, 0.0, 0.6, 1.0)));
  EXPECT_FALSE(areOnEnd(Cut::at(0, 0.2, 0.3, 1.0), Cut::at(beside, 0.1, 0.6, 1.0)));
  // At the end of the mesh, too.
  EXPECT_TRUE(areOnEnd(Cut::at(0, 0.0, 0.3, 0.5), Cut::at(0, 0.0, 0.6, 0.1)));
}

} // namespace
} // namespace hop::testing
