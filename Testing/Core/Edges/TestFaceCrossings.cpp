#include "Edges/FaceCrossings.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <vector>

namespace hop::testing
{
namespace
{

/// A linear field whose values at corners single precision holds exactly.
double linear(const glm::dvec3& u)
{
  return u.x + 0.5 * u.y - 2.0 * u.z + 0.25;
}

ElementMesh meshOf(Domain domain)
{
  return referenceMesh(domain, 1, linear);
}

/// The part of an element that is so many times smaller, at the origin: with the factor 1 all of it.
SurfaceBox boxOf(Domain domain, float size = 1.0f)
{
  SurfaceBox box;
  box.middle = { 0, middleOf(facts(domain)) };
  const auto& corners = facts(domain).corners;
  for (std::size_t c = 0; c < corners.size(); ++c)
  {
    box.corners[c] = size * glm::vec3(corners[c].xyz);
    box.values[c] = static_cast<float>(linear(glm::dvec3(box.corners[c])));
  }
  return box;
}

std::vector<FaceCrossing> crossingsOf(const ElementMesh& mesh, const SurfaceBox& box)
{
  std::vector<FaceCrossing> found;
  visitFaceCrossings(
    mesh, box, [](int) { return true; },
    [&](const FaceCrossing& crossing) { found.push_back(crossing); });
  return found;
}

class FaceCrossingsIn : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(FaceCrossings, FaceCrossingsIn, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

/// The plane cuts a polygon out of the element; it comes to each of its faces twice, at two edges.
TEST_P(FaceCrossingsIn, AreWhereALinearFieldIsZero)
{
  const ElementMesh mesh = meshOf(this->GetParam());
  const auto crossings = crossingsOf(mesh, boxOf(this->GetParam()));
  std::array<int, MaximumFaces> ofFace{};
  for (const FaceCrossing& crossing : crossings)
  {
    ++ofFace[crossing.face];
    EXPECT_EQ(crossing.location.element, 0);
    EXPECT_NEAR(linear(crossing.location.u.xyz), 0.0, 1e-12);
    EXPECT_NEAR(faceMargin(mesh.face(0, crossing.face), crossing.location.u), 0.0, 1e-12);
    const auto& [from, to] = crossing.ends;
    EXPECT_NEAR(crossing.rise, std::abs(linear(from) - linear(to)), 1e-12);
    EXPECT_LT(linear(from) * linear(to), 0.0);
    const glm::dvec3& u = crossing.location.u.xyz;
    EXPECT_NEAR(glm::distance(from, u) + glm::distance(u, to), glm::distance(from, to), 1e-12);
  }
  EXPECT_GE(crossings.size(), 6u);
  for (const int count : ofFace)
  {
    EXPECT_TRUE(count == 0 || count == 2) << count;
  }
}

TEST_P(FaceCrossingsIn, AreVisitedOnFacesThatAreWantedOnly)
{
  const ElementMesh mesh = meshOf(this->GetParam());
  const SurfaceBox box = boxOf(this->GetParam());
  for (const FaceCrossing& one : crossingsOf(mesh, box))
  {
    int visited = 0;
    visitFaceCrossings(
      mesh, box, [&](int face) { return face == one.face; },
      [&](const FaceCrossing& crossing)
      {
        ++visited;
        EXPECT_EQ(crossing.face, one.face);
      });
    EXPECT_EQ(visited, 2);
  }
}

/// A smaller part of the element has sides inside of it, which are no faces.
TEST_P(FaceCrossingsIn, AreNotOnSidesOfABoxInsideTheElement)
{
  const ElementMesh mesh = meshOf(this->GetParam());
  const auto crossings = crossingsOf(mesh, boxOf(this->GetParam(), 0.5f));
  EXPECT_GE(crossings.size(), 4u);
  for (const FaceCrossing& crossing : crossings)
  {
    const Face& face = mesh.face(0, crossing.face);
    EXPECT_NEAR(face.offset, 0.0, 1e-12) << "a face that does not hold the origin";
    EXPECT_NEAR(faceMargin(face, crossing.location.u), 0.0, 1e-12);
  }
}

/// Corners are kept in single precision: crossings are taken to the face.
TEST_P(FaceCrossingsIn, LieOnTheFaceThoughCornersMissIt)
{
  const ElementMesh mesh = meshOf(this->GetParam());
  SurfaceBox box = boxOf(this->GetParam());
  for (glm::vec3& corner : box.corners)
  {
    corner += glm::vec3(3e-7f, -2e-7f, 1e-7f);
  }
  const auto crossings = crossingsOf(mesh, box);
  EXPECT_GE(crossings.size(), 6u);
  for (const FaceCrossing& crossing : crossings)
  {
    EXPECT_NEAR(faceMargin(mesh.face(0, crossing.face), crossing.location.u), 0.0, 1e-15);
  }
}

/// Of two sheets close to each other values beyond a limit belong to the other one: ends are nearer.
TEST_P(FaceCrossingsIn, EndWhereValuesBelongToTheOtherSheet)
{
  const ElementMesh mesh = meshOf(this->GetParam());
  SurfaceBox box = boxOf(this->GetParam());
  box.largestOwnValue = 0.125f;
  box.valueUnit = 8.0;
  const auto crossings = crossingsOf(mesh, box);
  EXPECT_GE(crossings.size(), 6u);
  for (const FaceCrossing& crossing : crossings)
  {
    EXPECT_NEAR(std::abs(linear(crossing.ends[0])), 0.125, 1e-12);
    EXPECT_NEAR(std::abs(linear(crossing.ends[1])), 0.125, 1e-12);
    EXPECT_NEAR(crossing.rise, 8.0 * 0.25, 1e-12);
  }
}

} // namespace
} // namespace hop::testing
