#include "Elements/ElementMesh.h"

#include "AnalyticFields.h"
#include "ElementCases.h"
#include "Surface/SurfaceWalker.h"
#include "SurfaceSeeds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace hop::testing
{
namespace
{

/// Pyramids are polynomial on the hexahedron's domain; its four upper corners stand in one place. The tests here count
/// corners of solids by their distinct places.
enum class Kind
{
  Hexahedron,
  Tetrahedron,
  Wedge,
  Pyramid
};

constexpr std::array<Kind, 4> allKinds{ Kind::Hexahedron, Kind::Tetrahedron, Kind::Wedge,
  Kind::Pyramid };

const char* nameOf(Kind kind)
{
  constexpr const char* names[] = { "Hexahedron", "Tetrahedron", "Wedge", "Pyramid" };
  return names[static_cast<int>(kind)];
}

Domain domainOf(Kind kind)
{
  return kind == Kind::Tetrahedron ? Domain::Tetrahedron
    : kind == Kind::Wedge          ? Domain::Wedge
                                   : Domain::Hexahedron;
}

/// A straight solid: where its domain's corners stand, and their numbers.
struct Solid
{
  Kind kind = Kind::Hexahedron;
  std::vector<glm::dvec3> corners;
  std::vector<std::int64_t> numbers;
};

Solid unitSolid(Kind kind)
{
  Solid solid{ kind, {}, {} };
  for (const ReferencePoint& corner : facts(domainOf(kind)).corners)
  {
    const auto number = static_cast<std::int64_t>(solid.numbers.size());
    const bool apex = kind == Kind::Pyramid && number >= 4;
    solid.corners.push_back(apex ? glm::dvec3(0.4, 0.6, 1.0) : corner.xyz);
    solid.numbers.push_back(apex ? 4 : number);
  }
  return solid;
}

/// The distinct corners around a face, as corners of the domain; fewer than three: no face.
std::vector<int> ringOf(const Solid& solid, int face)
{
  const Face& f = facts(domainOf(solid.kind)).faces[face];
  std::vector<int> ring;
  for (int c = 0; c < f.cornerCount; ++c)
  {
    const auto same = [&](int other)
    { return solid.numbers[other] == solid.numbers[f.corners[c]]; };
    if (std::none_of(ring.begin(), ring.end(), same))
    {
      ring.push_back(f.corners[c]);
    }
  }
  return ring;
}

glm::dvec3 middleOf(const Solid& solid)
{
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& corner : solid.corners)
  {
    sum += corner;
  }
  return sum / static_cast<double>(solid.corners.size());
}

/// A solid of another kind behind a face: an affine image of its unit solid, whose ring of corners
/// starts at corner `turn` of the first one's, and runs backwards if `reflected`.
Solid solidBehind(const Solid& solid, int face, Kind kind, int otherFace, int turn, bool reflected)
{
  const Solid unit = unitSolid(kind);
  const std::vector<int> here = ringOf(solid, face);
  const std::vector<int> there = ringOf(unit, otherFace);
  const int n = static_cast<int>(here.size());
  const auto partner = [&](int c) { return here[((reflected ? n - c : c) + turn) % n]; };

  const glm::dvec3 origin = unit.corners[there[0]];
  const glm::dvec3 start = solid.corners[partner(0)];
  const glm::dmat3 from(
    unit.corners[there[1]] - origin, unit.corners[there[n - 1]] - origin, middleOf(unit) - origin);
  const glm::dvec3 a = solid.corners[partner(1)] - start;
  const glm::dvec3 b = solid.corners[partner(n - 1)] - start;
  const glm::dvec3 side = glm::cross(a, b);
  const double behind = glm::dot(side, middleOf(solid) - start) > 0.0 ? -0.5 : 0.5;
  const glm::dmat3 map = glm::dmat3(a, b, behind * side) * glm::inverse(from);

  Solid result{ kind, {}, {} };
  for (std::size_t c = 0; c < unit.corners.size(); ++c)
  {
    result.corners.push_back(start + map * (unit.corners[c] - origin));
    result.numbers.push_back(100 + unit.numbers[c]);
  }
  for (int c = 0; c < n; ++c)
  {
    for (std::size_t d = 0; d < unit.numbers.size(); ++d)
    {
      if (unit.numbers[d] == unit.numbers[there[c]])
      {
        result.numbers[d] = solid.numbers[partner(c)];
      }
    }
  }
  return result;
}

/// Quadratic, so that elements of degree 2 and more hold it exactly whatever their shape.
glm::dvec3 bend(const glm::dvec3& x)
{
  return x + 0.1 * glm::dvec3(x.y * x.z - x.x * x.x, x.x * x.z + x.y * x.y, x.x * x.y - x.z * x.x);
}

void append(
  ElementMesh& mesh, const Solid& solid, const Map& map = bend,
  const Field& field = [](const glm::dvec3& x) { return x.x; })
{
  MeshRecipe recipe;
  recipe.domain = domainOf(solid.kind);
  recipe.degrees = { 2, 2, 2 };
  recipe.map = map;
  recipe.field = field;
  appendElement(mesh, recipe, solid.corners, solid.numbers);
}

/// A point on a face of the domain, away from its edges.
ReferencePoint facePoint(Domain domain, int face, Random& random)
{
  const Face& f = facts(domain).faces[face];
  const auto& corners = facts(domain).corners;
  glm::dvec3 point(0.0);
  double sum = 0.0;
  if (f.cornerCount == 3)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double weight = 0.05 + random.uniform();
      point += weight * corners[f.corners[c]].xyz;
      sum += weight;
    }
    return { point / sum };
  }
  const double s = 0.02 + 0.96 * random.uniform(), t = 0.02 + 0.96 * random.uniform();
  const glm::dvec3 origin = corners[f.corners[0]].xyz;
  return { origin + s * (corners[f.corners[1]].xyz - origin) +
    t * (corners[f.corners[3]].xyz - origin) };
}

void expectSamePlaces(const ElementMesh& mesh, int element, int face, int otherFace, Random& random)
{
  const Domain domain = mesh.elements[element].domain;
  for (int n = 0; n < 5; ++n)
  {
    const Location here{ element, facePoint(domain, face, random) };
    const Location there = crossFace(mesh, here, face);
    ASSERT_EQ(there.element, 1 - element);
    EXPECT_GE(insideMargin(mesh.elements[there.element].domain, there.u), -1e-12);
    EXPECT_LE(glm::distance(positionAt(mesh, here), positionAt(mesh, there)), 1e-13);
    const Location back = crossFace(mesh, there, otherFace);
    EXPECT_EQ(back.element, element);
    EXPECT_LE(length(back.u - here.u), 1e-12);
  }
}

class PyramidWith : public ::testing::TestWithParam<Kind>
{
};

INSTANTIATE_TEST_SUITE_P(ElementMesh, PyramidWith, ::testing::ValuesIn(allKinds),
  [](const auto& which) { return nameOf(which.param); });

/// Corners that follow each other around a quadrilateral follow each other in the neighbour's face too, even where two
/// of them stand in one place: edges of a face are joined to edges.
void expectRing(const ElementMesh& mesh, int element, int face)
{
  const FaceNeighbor& neighbor = mesh.neighbor(element, face);
  const auto& corners = facts(mesh.elements[neighbor.element].domain).corners;
  for (int c = 0; c < 4; ++c)
  {
    const glm::dvec3 edge =
      corners[neighbor.corners[c]].xyz - corners[neighbor.corners[(c + 1) % 4]].xyz;
    EXPECT_EQ(glm::length(edge), 1.0) << "corner " << c;
  }
}

TEST_P(PyramidWith, JoinsInEveryOrientation)
{
  const Kind other = this->GetParam();
  const Solid pyramid = unitSolid(Kind::Pyramid);
  const Solid unit = unitSolid(other);
  Random random(1);
  int meetings = 0;
  int sharedApexes = 0;
  for (int face = 0; face < 6; ++face)
  {
    for (int otherFace = 0; otherFace < static_cast<int>(facts(domainOf(other)).faces.size());
         ++otherFace)
    {
      const int corners = static_cast<int>(ringOf(pyramid, face).size());
      if (corners < 3 || corners != static_cast<int>(ringOf(unit, otherFace).size()))
      {
        continue;
      }
      for (int turn = 0; turn < 2 * corners; ++turn)
      {
        SCOPED_TRACE(::testing::Message()
          << "face " << face << " with face " << otherFace << ", turn " << turn);
        const Solid behind =
          solidBehind(pyramid, face, other, otherFace, turn % corners, turn >= corners);
        ElementMesh mesh;
        append(mesh, pyramid);
        append(mesh, behind);
        findFaceNeighbors(mesh, 1e-9);
        for (int f = 0; f < MaximumFaces; ++f)
        {
          EXPECT_EQ(mesh.neighbor(0, f).element, f == face ? 1 : -1);
          EXPECT_EQ(mesh.neighbor(1, f).element, f == otherFace ? 0 : -1);
        }
        if (mesh.neighbor(0, face).element == 1)
        {
          expectSamePlaces(mesh, 0, face, otherFace, random);
          expectSamePlaces(mesh, 1, otherFace, face, random);
          constexpr int apex = 4;
          if (other == Kind::Pyramid && behind.numbers[apex] == pyramid.numbers[apex])
          {
            ++sharedApexes;
            expectRing(mesh, 0, face);
            expectRing(mesh, 1, otherFace);
          }
        }
        ++meetings;
      }
    }
  }
  // Triangles of a pyramid: 4, of a tetrahedron 4, of a wedge 2; squares: 1, 6 of a hexahedron, 3.
  const std::map<Kind, int> expected{ { Kind::Hexahedron, 6 * 8 }, { Kind::Tetrahedron, 4 * 4 * 6 },
    { Kind::Wedge, 4 * 2 * 6 + 3 * 8 }, { Kind::Pyramid, 4 * 4 * 6 + 8 } };
  EXPECT_EQ(meetings, expected.at(other));
  EXPECT_EQ(sharedApexes, other == Kind::Pyramid ? 4 * 4 * 2 : 0);
}

/// The cube [-1,1]^3 around a common apex: five pyramids and, on the sixth side, two tetrahedra; a
/// hexahedron and two wedges on two of the pyramids' bases.
ElementMesh mixedMesh(const Map& map, const Field& field)
{
  const auto number = [](const glm::dvec3& x)
  { return std::llround((x.x + 1.0) + 7.0 * (x.y + 1.0) + 49.0 * (x.z + 1.0)); };
  ElementMesh mesh;
  const auto add = [&](Kind kind, const std::vector<glm::dvec3>& corners)
  {
    Solid solid{ kind, corners, {} };
    for (const glm::dvec3& x : corners)
    {
      solid.numbers.push_back(number(x));
    }
    append(mesh, solid, map, field);
  };
  const glm::dvec3 apex(0.0);
  const auto& cube = facts(Domain::Hexahedron);
  const auto corner = [&](int c) { return 2.0 * cube.corners[c].xyz - 1.0; };
  for (int f = 0; f < 6; ++f)
  {
    const auto& ring = cube.faces[f].corners;
    const glm::dvec3 a = corner(ring[0]), b = corner(ring[1]), c = corner(ring[2]),
                     d = corner(ring[3]);
    if (f == 4)
    {
      add(Kind::Tetrahedron, { a, b, c, apex });
      add(Kind::Tetrahedron, { a, c, d, apex });
    }
    else
    {
      add(Kind::Pyramid, { a, b, c, d, apex, apex, apex, apex });
    }
  }
  std::vector<glm::dvec3> right, beyond;
  for (const ReferencePoint& u : cube.corners)
  {
    right.push_back(2.0 * u.xyz - 1.0 + glm::dvec3(2, 0, 0));
    beyond.push_back(2.0 * u.xyz - 1.0 + glm::dvec3(0, 2, 0));
  }
  add(Kind::Hexahedron, right);
  // Triangles in x and y: the face of the pyramid below is one square of the first wedge.
  add(Kind::Wedge, { beyond[0], beyond[1], beyond[2], beyond[4], beyond[5], beyond[6] });
  add(Kind::Wedge, { beyond[0], beyond[2], beyond[3], beyond[4], beyond[6], beyond[7] });
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

TEST(Pyramids, AllInnerFacesOfAMixedMeshAreJoined)
{
  const ElementMesh mesh = mixedMesh(bend, [](const glm::dvec3& x) { return x.x; });
  int joined = 0;
  for (const FaceNeighbor& neighbor : mesh.neighbors)
  {
    joined += neighbor.element >= 0;
  }
  // 12 triangles under the apex, one between the tetrahedra, two squares to hexahedron and wedge, one
  // between the wedges: from both sides.
  EXPECT_EQ(joined, 2 * (12 + 1 + 2 + 1));
}

TEST(Pyramids, WalkersPassThroughAllKindsOfFaces)
{
  for (const bool bent : { false, true })
  {
    const Map map = bent ? Map(bend) : Map([](const glm::dvec3& x) { return x; });
    int found = 0, tried = 0;
    std::map<std::pair<int, int>, int> crossings;
    for (const glm::dvec3& normal :
      { glm::dvec3(1, 0.2, 0.1), glm::dvec3(0.1, 1, 0.3), glm::dvec3(-0.2, 0.3, 1) })
    {
      const KnownSurface surface = plane(glm::normalize(normal), 0.31);
      const ElementMesh mesh = mixedMesh(map, surface.field);
      SurfaceWalker walker({ &mesh, 0.0, 1e-11 });
      Random random(2);
      for (int n = 0; n < 600; ++n)
      {
        const int element = static_cast<int>(random.uniform() * mesh.elements.size());
        const Location start{ element, randomPoint(mesh.elements[element].domain, random) };
        Evaluated on;
        ++tried;
        if (!walker.project(start, 3.0, on))
        {
          continue;
        }
        ++found;
        EXPECT_GE(insideMargin(mesh.elements[on.location.element].domain, on.location.u), -1e-12);
        const glm::dvec3 x = positionAt(mesh, on.location);
        EXPECT_LE(std::abs(surface.field(x)), 1e-10);
        ++crossings[{ element, on.location.element }];
      }
    }
    EXPECT_GE(found, 0.95 * tried);
    // Pyramids 0 to 3 and 6, tetrahedra 4 and 5, the hexahedron 7, wedges 8 and 9.
    const auto passed = [&](std::initializer_list<int> from, std::initializer_list<int> to)
    {
      int sum = 0;
      for (const auto& [pair, count] : crossings)
      {
        sum += std::count(from.begin(), from.end(), pair.first) > 0 &&
            std::count(to.begin(), to.end(), pair.second) > 0 && pair.first != pair.second
          ? count
          : 0;
      }
      return sum;
    };
    const std::initializer_list<int> pyramids{ 0, 1, 2, 3, 6 };
    EXPECT_GT(passed(pyramids, pyramids), 40);
    EXPECT_GT(passed(pyramids, { 4, 5 }), 5);
    EXPECT_GT(passed({ 4, 5 }, pyramids), 20);
    EXPECT_GT(passed({ 7 }, pyramids), 20);
    EXPECT_GT(passed(pyramids, { 7 }), 2);
    EXPECT_GT(passed({ 8, 9 }, pyramids), 20);
    EXPECT_GT(passed(pyramids, { 8, 9 }), 2);
  }
}

TEST(Pyramids, BoxesSeedTheSameSurfaceAcrossKinds)
{
  const KnownSurface ball = sphere({ 0, 0, 0 }, 0.7);
  const ElementMesh mesh = mixedMesh([](const glm::dvec3& x) { return x; }, ball.field);
  const std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, 0.0, 0.2, {});
  EXPECT_EQ(uncertifiedCount(boxes), 0);
  const std::vector<Location> seeds = surfaceSeeds(mesh, 0.0, boxes);
  EXPECT_GE(seeds.size(), 0.95 * boxes.size());
  for (const Location& seed : seeds)
  {
    EXPECT_NEAR(glm::length(positionAt(mesh, seed)), 0.7, 1e-9);
  }
}

} // namespace
} // namespace hop::testing
