#include "Surface/ActiveFaces.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <vector>

namespace hop::testing
{
namespace
{

/// A map with a random Jacobian that is not nearly singular.
LocalMap randomMap(Random& random)
{
  LocalMap map;
  map.jacobian = glm::dmat3(1.0);
  for (int column = 0; column < 3; ++column)
  {
    map.jacobian[column] += 0.3 * randomVector(random);
  }
  map.inverse = glm::inverse(map.jacobian);
  return map;
}

ActiveFaces activeFaces(const std::vector<int>& faces)
{
  ActiveFaces active;
  for (const int f : faces)
  {
    active.add(f);
  }
  return active;
}

/// No face, every face, and every pair of faces that are not parallel.
std::vector<std::vector<int>> sidesOf(Domain domain)
{
  const auto& faces = facts(domain).faces;
  const int count = static_cast<int>(faces.size());
  std::vector<std::vector<int>> sides{ {} };
  for (int a = 0; a < count; ++a)
  {
    sides.push_back({ a });
    for (int b = 0; b < a; ++b)
    {
      if (glm::length(glm::cross(faces[a].inward.xyz, faces[b].inward.xyz)) > 1e-6)
      {
        sides.push_back({ a, b });
      }
    }
  }
  return sides;
}

TEST(ActiveFaces, HoldsTheFacesThatWereAdded)
{
  ActiveFaces active;
  EXPECT_FALSE(active.holds(0));
  active.add(3);
  EXPECT_TRUE(active.holds(3));
  EXPECT_FALSE(active.holds(0));
  active.add(5);
  EXPECT_TRUE(active.holds(3));
  EXPECT_TRUE(active.holds(5));
  EXPECT_FALSE(active.holds(4));
}

TEST(ActiveFaces, VectorsArePulledAlongThemByLeastSquares)
{
  Random random(1);
  for (const Domain domain : allDomains)
  {
    SCOPED_TRACE(::testing::PrintToString(domain));
    for (const std::vector<int>& side : sidesOf(domain))
    {
      const LocalMap map = randomMap(random);
      const WorldVector v{ randomVector(random) };
      const ReferenceVector du = pullAlong(domain, activeFaces(side), map, v);
      for (const int f : side)
      {
        EXPECT_NEAR(dot(facts(domain).faces[f].inward, du), 0.0, 1e-12);
      }
      // Whatever other vector runs along the faces: its image is no nearer to v.
      const double distance = length(map.push(du) - v);
      for (int n = 0; n < 20; ++n)
      {
        const ReferenceVector other =
          pullAlong(domain, activeFaces(side), map, { randomVector(random) });
        EXPECT_GE(length(map.push(du + 0.1 * other) - v), distance - 1e-12);
      }
      if (side.empty())
      {
        EXPECT_LE(distance, 1e-12);
      }
    }
  }
}

TEST(ActiveFaces, VectorsAlongThemStayWhatTheyAre)
{
  Random random(2);
  const LocalMap map = randomMap(random);
  // The hexahedron's faces 0 and 4: u = 0 and w = 0.
  const ReferenceVector alongFace{ { 0.0, 0.7, -0.4 } };
  EXPECT_LE(
    length(pullAlong(Domain::Hexahedron, activeFaces({ 0 }), map, map.push(alongFace)) - alongFace),
    1e-12);
  const ReferenceVector alongEdge{ { 0.0, -0.3, 0.0 } };
  EXPECT_LE(length(pullAlong(Domain::Hexahedron, activeFaces({ 4, 0 }), map, map.push(alongEdge)) -
              alongEdge),
    1e-12);
}

TEST(FindExit, KnownExitsOfAHexahedron)
{
  const ReferencePoint middle{ { 0.5, 0.5, 0.5 } };
  const auto exitOf = [&](const glm::dvec3& step, const ActiveFaces& active = {})
  { return findExit(Domain::Hexahedron, middle, { step }, active); };
  EXPECT_EQ(exitOf({ 0.4, 0.0, 0.0 }).face, -1);
  EXPECT_EQ(exitOf({ 0.4, 0.0, 0.0 }).fraction, 1.0);
  EXPECT_EQ(exitOf({ 1.0, 0.0, 0.0 }).face, 1);
  EXPECT_DOUBLE_EQ(exitOf({ 1.0, 0.0, 0.0 }).fraction, 0.5);
  EXPECT_EQ(exitOf({ 1.0, -2.0, 0.0 }).face, 2) << "the first of two";
  EXPECT_DOUBLE_EQ(exitOf({ 1.0, -2.0, 0.0 }).fraction, 0.25);
  EXPECT_EQ(exitOf({ 1.0, -2.0, 0.0 }, activeFaces({ 2 })).face, 1) << "an active face is none";
}

TEST(FindExit, EndsOnTheFaceByWhichTheStepLeaves)
{
  Random random(3);
  for (const Domain domain : allDomains)
  {
    SCOPED_TRACE(::testing::PrintToString(domain));
    const auto& faces = facts(domain).faces;
    int exits = 0;
    for (int n = 0; n < 500; ++n)
    {
      const ReferencePoint u = randomPoint(domain, random);
      const ReferenceVector du{ randomVector(random) };
      const Exit exit = findExit(domain, u, du, {});
      EXPECT_EQ(exit.face < 0, insideMargin(domain, u + du) >= 0.0);
      EXPECT_GE(insideMargin(domain, u + exit.fraction * du), -1e-12);
      if (exit.face >= 0)
      {
        EXPECT_NEAR(faceMargin(faces[exit.face], u + exit.fraction * du), 0.0, 1e-12);
        ++exits;
      }
    }
    EXPECT_GT(exits, 100);
    EXPECT_LT(exits, 500);
  }
}

TEST(FindExit, IsAtOnceFromAFaceToRounding)
{
  for (const double u : { 0.0, 0.5 * OnFace, -0.5 * OnFace })
  {
    const Exit exit = findExit(Domain::Hexahedron, { { u, 0.5, 0.5 } }, { { -0.3, 0.1, 0.0 } }, {});
    EXPECT_EQ(exit.face, 0) << u;
    EXPECT_EQ(exit.fraction, 0.0) << u;
    // Away from the face nothing holds the step back.
    EXPECT_EQ(
      findExit(Domain::Hexahedron, { { u, 0.5, 0.5 } }, { { 0.3, 0.1, 0.0 } }, {}).face, -1);
  }
}

TEST(IsOnFace, ToTheAccuracyAskedFor)
{
  const ElementMesh mesh = makeMesh(MeshRecipe{});
  EXPECT_TRUE(isOnFace(mesh, { 0, { { 0.0, 0.5, 0.5 } } }, 0));
  EXPECT_TRUE(isOnFace(mesh, { 0, { { 0.9 * OnFace, 0.5, 0.5 } } }, 0));
  EXPECT_FALSE(isOnFace(mesh, { 0, { { 1.1 * OnFace, 0.5, 0.5 } } }, 0));
  EXPECT_TRUE(isOnFace(mesh, { 0, { { 0.01, 0.5, 0.5 } } }, 0, 0.02));
  EXPECT_FALSE(isOnFace(mesh, { 0, { { 0.0, 0.5, 0.5 } } }, 1));
}

} // namespace
} // namespace hop::testing
