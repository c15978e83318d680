#include "Elements/ElementMesh.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

/// A straight element as the image of its reference domain, with a number for each corner.
struct Block
{
  Domain domain = Domain::Hexahedron;
  std::vector<glm::dvec3> corners;
  std::vector<std::int64_t> numbers;
};

Block referenceBlock(Domain domain)
{
  Block block{ domain, {}, {} };
  for (const ReferencePoint& corner : facts(domain).corners)
  {
    block.corners.push_back(corner.xyz);
    block.numbers.push_back(static_cast<std::int64_t>(block.numbers.size()));
  }
  return block;
}

/// How the corners of two faces meet: around the ring by `turn`, backwards if `reflected`.
struct Meeting
{
  int face = 0;
  int otherFace = 0;
  int turn = 0;
  bool reflected = false;
};

std::ostream& operator<<(std::ostream& out, const Meeting& m)
{
  return out << "face " << m.face << " with face " << m.otherFace << " turned by " << m.turn
             << (m.reflected ? ", reflected" : "");
}

std::vector<Meeting> allMeetings(Domain first, Domain second)
{
  std::vector<Meeting> all;
  const auto& here = facts(first).faces;
  const auto& there = facts(second).faces;
  for (int f = 0; f < static_cast<int>(here.size()); ++f)
  {
    for (int g = 0; g < static_cast<int>(there.size()); ++g)
    {
      for (int turn = 0; here[f].cornerCount == there[g].cornerCount && turn < here[f].cornerCount;
           ++turn)
      {
        all.push_back({ f, g, turn, false });
        all.push_back({ f, g, turn, true });
      }
    }
  }
  return all;
}

/// An element of `domain` behind a face of another element: an affine image of its reference domain in
/// which the corners of its face coincide with the corners of the other face.
Block blockBehind(const Block& block, Domain domain, const Meeting& meeting)
{
  const Face& here = facts(block.domain).faces[meeting.face];
  const Face& there = facts(domain).faces[meeting.otherFace];
  const int n = here.cornerCount;
  const auto partner = [&](int c)
  { return here.corners[((meeting.reflected ? n - c : c) + meeting.turn) % n]; };

  Block behind{ domain, {}, std::vector<std::int64_t>(facts(domain).corners.size(), -1) };
  for (int c = 0; c < n; ++c)
  {
    behind.numbers[there.corners[c]] = block.numbers[partner(c)];
  }
  const auto& u = facts(domain).corners;
  int apex = 0;
  for (std::int64_t fresh = 100; apex < static_cast<int>(u.size()); ++apex, ++fresh)
  {
    behind.numbers[apex] = behind.numbers[apex] < 0 ? fresh : behind.numbers[apex];
  }
  // The third direction is fixed by any corner off the face, which is put straight behind it.
  apex = static_cast<int>(
    std::find_if(behind.numbers.begin(), behind.numbers.end(), [](auto i) { return i >= 100; }) -
    behind.numbers.begin());
  const glm::dvec3 origin = u[there.corners[0]].xyz;
  const glm::dmat3 from(
    u[there.corners[1]].xyz - origin, u[there.corners[n - 1]].xyz - origin, u[apex].xyz - origin);
  const glm::dvec3 start = block.corners[partner(0)];
  const glm::dmat3 to(block.corners[partner(1)] - start, block.corners[partner(n - 1)] - start,
    -glm::normalize(here.inward.xyz));
  for (const ReferencePoint& corner : u)
  {
    behind.corners.push_back(start + to * glm::inverse(from) * (corner.xyz - origin));
  }
  return behind;
}

void append(ElementMesh& mesh, const Block& block, const Map& map)
{
  MeshRecipe recipe;
  recipe.domain = block.domain;
  recipe.degrees = { 3, 3, 3 };
  recipe.map = map;
  appendElement(mesh, recipe, block.corners, block.numbers);
}

WorldPoint positionAt(const ElementMesh& mesh, const Location& location)
{
  return { glm::dvec3(evaluateGradient(mesh.form(location.element), location.u).value) };
}

/// A point of a face, from two numbers in [0,1).
ReferencePoint facePoint(Domain domain, const Face& face, double s, double t)
{
  const auto& corners = facts(domain).corners;
  if (face.cornerCount == 3 && s + t > 1.0)
  {
    s = 1.0 - s;
    t = 1.0 - t;
  }
  const glm::dvec3 origin = corners[face.corners[0]].xyz;
  return { origin + s * (corners[face.corners[1]].xyz - origin) +
    t * (corners[face.corners[face.cornerCount - 1]].xyz - origin) };
}

/// Both sides of a face see the same world points through it.
void expectSamePoints(const ElementMesh& mesh, int element, int face, int otherFace, Random& random)
{
  const Domain domain = mesh.elements[element].domain;
  for (int n = 0; n < 5; ++n)
  {
    const Location here{ element,
      facePoint(domain, facts(domain).faces[face], random.uniform(), random.uniform()) };
    const Location there = crossFace(mesh, here, face);
    ASSERT_EQ(there.element, 1 - element);
    EXPECT_LE(length(positionAt(mesh, here) - positionAt(mesh, there)), 1e-13);
    const Location back = crossFace(mesh, there, otherFace);
    EXPECT_EQ(back.element, element);
    EXPECT_LE(length(back.u - here.u), 1e-14);
  }
}

class FacesOf : public ::testing::TestWithParam<std::pair<Domain, Domain>>
{
};

INSTANTIATE_TEST_SUITE_P(ElementMesh, FacesOf,
  ::testing::Values(std::pair{ Domain::Hexahedron, Domain::Hexahedron },
    std::pair{ Domain::Tetrahedron, Domain::Tetrahedron },
    std::pair{ Domain::Wedge, Domain::Wedge }, std::pair{ Domain::Wedge, Domain::Hexahedron },
    std::pair{ Domain::Wedge, Domain::Tetrahedron }),
  [](const auto& which)
  {
    return ::testing::PrintToString(which.param.first) + "With" +
      ::testing::PrintToString(which.param.second);
  });

TEST_P(FacesOf, JoinInEveryOrientation)
{
  const auto [first, second] = this->GetParam();
  Random random(1);
  for (const Meeting& meeting : allMeetings(first, second))
  {
    SCOPED_TRACE(meeting);
    ElementMesh mesh;
    const Block block = referenceBlock(first);
    append(mesh, block, wavyMap(0.2));
    append(mesh, blockBehind(block, second, meeting), wavyMap(0.2));
    findFaceNeighbors(mesh, 1e-9);
    for (int face = 0; face < MaximumFaces; ++face)
    {
      EXPECT_EQ(mesh.neighbor(0, face).element, face == meeting.face ? 1 : -1);
      EXPECT_EQ(mesh.neighbor(1, face).element, face == meeting.otherFace ? 0 : -1);
    }
    expectSamePoints(mesh, 0, meeting.face, meeting.otherFace, random);
    expectSamePoints(mesh, 1, meeting.otherFace, meeting.face, random);
  }
}

TEST(ElementMesh, ThereAreAsManyOrientationsAsThereShouldBe)
{
  EXPECT_EQ(allMeetings(Domain::Hexahedron, Domain::Hexahedron).size(), 6u * 6u * 8u);
  EXPECT_EQ(allMeetings(Domain::Tetrahedron, Domain::Tetrahedron).size(), 4u * 4u * 6u);
  EXPECT_EQ(allMeetings(Domain::Wedge, Domain::Wedge).size(), 2u * 2u * 6u + 3u * 3u * 8u);
  EXPECT_EQ(allMeetings(Domain::Wedge, Domain::Hexahedron).size(), 3u * 6u * 8u);
  EXPECT_EQ(allMeetings(Domain::Wedge, Domain::Tetrahedron).size(), 2u * 4u * 6u);
}

TEST(ElementMesh, AFaceThatThreeElementsClaimJoinsNone)
{
  for (const Domain domain : allDomains)
  {
    ElementMesh mesh;
    const Block block = referenceBlock(domain);
    append(mesh, block, wavyMap(0.1));
    const Block behind = blockBehind(block, domain, { 0, 0, 0, false });
    append(mesh, behind, wavyMap(0.1));
    append(mesh, behind, wavyMap(0.1));
    findFaceNeighbors(mesh, 1e-9);
    for (int element = 0; element < 3; ++element)
    {
      EXPECT_EQ(mesh.neighbor(element, 0).element, -1) << domain;
    }
  }
}

TEST(ElementMesh, FacesOfOneElementAreNotJoined)
{
  // A plate thinner than the tolerance: its corners were taken for one another.
  ElementMesh mesh;
  Block block = referenceBlock(Domain::Hexahedron);
  block.numbers = { 0, 1, 2, 3, 0, 1, 2, 3 };
  append(mesh, block, [](const glm::dvec3& x) { return x * glm::dvec3(1, 1, 1e-12); });
  findFaceNeighbors(mesh, 1e-9);
  for (int face = 0; face < MaximumFaces; ++face)
  {
    EXPECT_EQ(mesh.neighbor(0, face).element, -1);
  }
}

TEST(ElementMesh, FacesOfTheSameCornersButDifferentMiddlesAreNotJoined)
{
  for (const Domain domain : allDomains)
  {
    for (const double difference : { 0.0, 1e-6, 1e-2 })
    {
      ElementMesh mesh;
      const Block block = referenceBlock(domain);
      append(mesh, block, [](const glm::dvec3& x) { return x; });
      // Moves everything but the corners of the face, which are corners of the unit cube.
      append(mesh, blockBehind(block, domain, { 0, 0, 0, false }),
        [difference](const glm::dvec3& x)
        { return x + difference * glm::length(x * (1.0 - x)) * glm::dvec3(1, 1, 1); });
      findFaceNeighbors(mesh, 1e-9);
      EXPECT_EQ(mesh.neighbor(0, 0).element, difference > 0.0 ? -1 : 1)
        << domain << ' ' << difference;
    }
  }
}

TEST(ElementMesh, ToleranceAllowsForRoundedCoordinates)
{
  ElementMesh mesh;
  const Block block = referenceBlock(Domain::Hexahedron);
  append(mesh, block, wavyMap(0.1));
  append(mesh, blockBehind(block, Domain::Hexahedron, { 1, 0, 0, false }),
    [map = wavyMap(0.1)](const glm::dvec3& x) { return map(x) + 1e-7; });
  findFaceNeighbors(mesh, 1e-6);
  EXPECT_EQ(mesh.neighbor(0, 1).element, 1);
  findFaceNeighbors(mesh, 1e-8);
  EXPECT_EQ(mesh.neighbor(0, 1).element, -1);
}

TEST(ElementMesh, BlocksOfElementsJoinAllInnerFaces)
{
  // n^3 cubes have 6 n^2 outer squares; each of them is one face or two triangles.
  for (const Domain domain : allDomains)
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.cells = 3;
    recipe.map = wavyMap(0.15);
    const ElementMesh mesh = makeMesh(recipe);
    int outer = 0;
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    {
      for (int f = 0; f < static_cast<int>(facts(domain).faces.size()); ++f)
      {
        outer += mesh.neighbor(e, f).element < 0;
      }
    }
    const int expected[] = { 54, 108, 72 };
    EXPECT_EQ(outer, expected[static_cast<int>(domain)]) << domain;
  }
}

TEST(ElementMesh, NeighborsOfNothing)
{
  ElementMesh mesh;
  findFaceNeighbors(mesh, 1e-9);
  EXPECT_TRUE(mesh.neighbors.empty());
}

} // namespace
} // namespace hop::testing
