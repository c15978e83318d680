#include "Surface/FaceLocator.h"

#include "AnalyticFields.h"
#include "ElementCases.h"
#include "Surface/SurfaceWalker.h"
#include "SurfaceSeeds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hop::testing
{
namespace
{

Bounds randomBox(Random& random, double size)
{
  const glm::dvec3 lower = randomVector(random);
  return { lower, lower + size * glm::abs(randomVector(random)) };
}

TEST(BoxTree, FindsTheBoxesThatOverlapAndNoOthers)
{
  Random random(1);
  for (const int count : { 0, 1, 4, 5, 300 })
  {
    std::vector<Bounds> boxes;
    for (int n = 0; n < count; ++n)
    {
      // Some of them large, some in the same place.
      boxes.push_back(n % 7 == 3 ? boxes.back() : randomBox(random, n % 5 == 0 ? 1.0 : 0.1));
    }
    const BoxTree tree(boxes);
    std::size_t found = 0;
    for (int n = 0; n < 100; ++n)
    {
      const Bounds wanted = randomBox(random, 0.3);
      std::vector<int> expected;
      for (int b = 0; b < count; ++b)
      {
        if (boxes[b].overlaps(wanted))
        {
          expected.push_back(b);
        }
      }
      EXPECT_EQ(tree.overlapping(wanted), expected);
      found += expected.size();
    }
    EXPECT_TRUE(count < 300 || found > 100u) << found;
  }
}

/// Bends the cube so that elements of degree 2 and more hold it exactly, whichever their boxes are: what
/// is one curved face on the left are four on the right.
glm::dvec3 bend(const glm::dvec3& x)
{
  return x + glm::dvec3(0.15 * x.y * x.z, 0.1 * x.z * x.x, 0.12 * (x.x * x.x - x.y * x.y));
}

struct Meeting
{
  const char* name;
  Domain left;
  Domain right;
  int leftDegree = 2;
  int rightDegree = 2;
  Map map = [](const glm::dvec3& x) { return x; };
};

std::ostream& operator<<(std::ostream& out, const Meeting& meeting)
{
  return out << meeting.name;
}

/// With a field that is zero: the surface is everywhere.
ElementMesh meshOf(const Meeting& meeting)
{
  MeshRecipe left, right;
  left.domain = meeting.left;
  right.domain = meeting.right;
  left.degrees = { meeting.leftDegree, meeting.leftDegree, meeting.leftDegree };
  right.degrees = { meeting.rightDegree, meeting.rightDegree, meeting.rightDegree };
  left.map = right.map = meeting.map;
  left.field = right.field = [](const glm::dvec3&) { return 0.0; };
  return hangingMesh(left, right);
}

class FacesThatDoNotMatch : public ::testing::TestWithParam<Meeting>
{
};

INSTANTIATE_TEST_SUITE_P(FaceLocator, FacesThatDoNotMatch,
  ::testing::Values(Meeting{ "Hexahedra", Domain::Hexahedron, Domain::Hexahedron },
    Meeting{ "HexahedronAndTetrahedra", Domain::Hexahedron, Domain::Tetrahedron },
    Meeting{ "TetrahedraAndWedges", Domain::Tetrahedron, Domain::Wedge, 2, 3 },
    Meeting{ "OrderOneAndFour", Domain::Hexahedron, Domain::Hexahedron, 1, 4 },
    Meeting{ "BentHexahedra", Domain::Hexahedron, Domain::Hexahedron, 2, 4, bend },
    Meeting{ "BentTetrahedraAndHexahedra", Domain::Tetrahedron, Domain::Hexahedron, 3, 2, bend }),
  [](const auto& which) { return std::string(which.param.name); });

bool isAtTheInterface(const Meeting& meeting, const glm::dvec3& x)
{
  // y is not bent away from x = 0, and z by 0.12 y^2.
  const double z = meeting.map({ 0, 1, 0 }).z < 0.0 ? x.z + 0.12 * x.y * x.y : x.z;
  return glm::distance(meeting.map({ 0, x.y, z }), x) < 1e-12;
}

/// A place of an element as the locator wants it.
LocalMap mapAt(const ElementMesh& mesh, int element, const ReferencePoint& u)
{
  return fieldPoint(evaluateGradient(mesh.form(element), u), 0.0).map;
}

/// A place on a face of a straight box.
LocalMap mapOfBox(const glm::dvec3& place)
{
  LocalMap map;
  map.position.xyz = place;
  return map;
}

/// Calls use() with random places on faces behind which an element may lie, and what the locator finds there.
template <class Use>
void visitPlacesAtOpenFaces(
  const ElementMesh& mesh, const FaceLocator& locator, const Use& use, double tolerance = 1e-6)
{
  Random random(2);
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
  {
    const Domain domain = mesh.elements[e].domain;
    const auto& faces = facts(domain).faces;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
      for (int n = 0; locator.mayContinue(e, f) && n < 20; ++n)
      {
        ReferencePoint u = randomPoint(domain, random);
        const double margin = glm::dot(faces[f].inward.xyz, u.xyz) + faces[f].offset;
        u.xyz -= margin / glm::dot(faces[f].inward.xyz, faces[f].inward.xyz) * faces[f].inward.xyz;
        if (insideMargin(domain, u) > -1e-12)
        {
          std::int64_t evaluations = 0;
          const LocalMap map = mapAt(mesh, e, u);
          use(e, map.position, locator.locate(map, e, f, tolerance, evaluations), evaluations);
        }
      }
    }
  }
}

TEST_P(FacesThatDoNotMatch, TheSamePlaceIsFoundBehindThem)
{
  const ElementMesh mesh = meshOf(this->GetParam());
  const FaceLocator locator(mesh, 0.0, {});
  int places = 0;
  std::int64_t cost = 0;
  visitPlacesAtOpenFaces(mesh, locator,
    [&](int element, const WorldPoint& x, const auto& found, std::int64_t evaluations)
    {
      ASSERT_EQ(found.has_value(), isAtTheInterface(this->GetParam(), x.xyz));
      if (!found)
      {
        return;
      }
      EXPECT_NE(found->location.element, element);
      const BernsteinForm form = mesh.form(found->location.element);
      EXPECT_LE(
        glm::distance(glm::dvec3(evaluateGradient(form, found->location.u).value), x.xyz), 1e-11);
      EXPECT_GE(insideMargin(form.domain, found->location.u), -1e-12);
      EXPECT_NEAR(found->gap, 0.0, 1e-11);
      const Face& face = facts(form.domain).faces[found->face];
      EXPECT_NEAR(glm::dot(face.inward.xyz, found->location.u.xyz) + face.offset, 0.0, 1e-11);
      ++places;
      cost += evaluations;
    });
  EXPECT_GT(places, 40);
  EXPECT_LT(cost, 12 * places);
}

TEST_P(FacesThatDoNotMatch, WalksEndWhereTheWorldVectorSays)
{
  const ElementMesh mesh = meshOf(this->GetParam());
  const FaceLocator locator(mesh, 0.0, {});
  SurfaceWalker walker({ &mesh, 0.0, 0.0, &locator });
  SurfaceWalker without({ &mesh, 0.0, 0.0 });
  Random random(3);
  int stopped = 0;
  for (int n = 0; n < 200; ++n)
  {
    const int element = static_cast<int>(random.uniform() * mesh.elements.size());
    const Location start{ element, randomPoint(mesh.elements[element].domain, random) };
    const glm::dvec3 target = this->GetParam().map(0.9 * randomVector(random));
    // Steps are first order in bent elements: each of them takes what the last one left of the way.
    const auto errorOf = [&](SurfaceWalker& which)
    {
      Evaluated at = which.evaluate(start);
      for (int step = 0; step < 40; ++step)
      {
        at = which.evaluate(which.move(at, { target - at.point.map.position.xyz }));
        EXPECT_GE(insideMargin(mesh.elements[at.location.element].domain, at.location.u), -1e-12);
      }
      return glm::distance(at.point.map.position.xyz, target);
    };
    ASSERT_LE(errorOf(walker), 1e-9) << "walk " << n;
    stopped += errorOf(without) > 1e-3;
  }
  EXPECT_GT(stopped, 50) << "without the locator";
}

TEST(FaceLocator, HasNothingToDoWhereAllFacesMatch)
{
  for (const Domain domain : allDomains)
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.field = [](const glm::dvec3&) { return 0.0; };
    const ElementMesh mesh = makeMesh(recipe);
    const FaceLocator locator(mesh, 0.0, {});
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    {
      for (int f = 0; f < MaximumFaces; ++f)
      {
        EXPECT_FALSE(locator.mayContinue(e, f)) << domain;
      }
    }
  }
}

TEST(FaceLocator, FindsNothingBehindSharpEdgesOfTheMesh)
{
  // Outer faces of two elements meet there, whose outward normals are 146 degrees apart.
  for (const Domain domain : allDomains)
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.field = [](const glm::dvec3&) { return 0.0; };
    recipe.map = [](const glm::dvec3& x) { return x + glm::dvec3(1.5 * x.z, 0.0, 0.0); };
    const ElementMesh mesh = makeMesh(recipe);
    const FaceLocator locator(mesh, 0.0, {});
    const DomainFacts& about = facts(domain);
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    {
      for (int f = 0; f < static_cast<int>(about.faces.size()); ++f)
      {
        const Face& face = about.faces[f];
        for (int c = 0; c < face.cornerCount && locator.mayContinue(e, f); ++c)
        {
          const ReferencePoint u{ glm::mix(about.corners[face.corners[c]].xyz,
            about.corners[face.corners[(c + 1) % face.cornerCount]].xyz, 0.3) };
          std::int64_t evaluations = 0;
          EXPECT_FALSE(locator.locate(mapAt(mesh, e, u), e, f, 1e-6, evaluations)) << domain;
        }
      }
    }
  }
}

TEST(FaceLocator, FindsNothingAcrossAReentrantEdgeWithHangingNodes)
{
  // The outer faces of two boxes meet in an edge with 60 degrees of empty space between them. One box is half as long,
  // so that the faces have at most one corner in common.
  MeshRecipe recipe;
  recipe.field = [](const glm::dvec3&) { return 0.0; };
  recipe.map = [](const glm::dvec3& x)
  { return x + glm::dvec3(std::sqrt(1.0 / 3.0) * x.y, 0.0, 0.0); };
  ElementMesh mesh;
  appendBox(mesh, recipe, { 0, -1, -1 }, { 1, 0, 1 });
  appendBox(mesh, recipe, { -1, 0, 0 }, { 0, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  const FaceLocator locator(mesh, 0.0, {});
  ASSERT_TRUE(locator.mayContinueIn(0, 0, 1)) << "the middles of the faces look at each other";
  std::int64_t evaluations = 0;
  for (const double toEdge : { 0.01, 0.05 })
  {
    const ReferencePoint inLonger{ { 0.0, 1.0 - toEdge, 0.75 } };
    const ReferencePoint inShorter{ { 1.0 - toEdge, 0.0, 0.5 } };
    EXPECT_FALSE(locator.locate(mapAt(mesh, 0, inLonger), 0, 0, 0.1, evaluations));
    EXPECT_FALSE(locator.locate(mapAt(mesh, 1, inShorter), 1, 2, 0.1, evaluations));
  }
  EXPECT_GT(evaluations, 0);
}

TEST(FaceLocator, KnowsOnlyFacesThatTheSurfacePasses)
{
  // z = 0.5: on the right in the upper boxes only.
  MeshRecipe recipe;
  recipe.field = plane({ 0, 0, 1 }, 0.5).field;
  const ElementMesh mesh = hangingMesh(recipe, recipe);
  const FaceLocator locator(mesh, 0.0, {});
  EXPECT_TRUE(locator.mayContinue(0, 1));
  for (int e = 1; e < 5; ++e)
  {
    const bool upper = positionAt(mesh, { e, { { 0.5, 0.5, 0.5 } } }).z > 0.0;
    EXPECT_EQ(locator.mayContinue(e, 0), upper);
    EXPECT_EQ(locator.mayContinueIn(0, 1, e), upper);
  }
}

/// One box on the left, and one on the right that faces a quarter of the left one's face, `gap` away from it.
ElementMesh quarterCovered(double gap)
{
  MeshRecipe recipe;
  recipe.field = [](const glm::dvec3&) { return 0.0; };
  ElementMesh mesh;
  appendBox(mesh, recipe, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(mesh, recipe, { gap, 0, 0 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

TEST(FaceLocator, FindsNothingBesideASmallerFace)
{
  const ElementMesh mesh = quarterCovered(0.0);
  const FaceLocator locator(mesh, 0.0, {});
  const auto found = [&](double y, double z)
  {
    std::int64_t evaluations = 0;
    return locator.locate(mapOfBox({ 0, y, z }), 0, 1, 0.05, evaluations).has_value();
  };
  EXPECT_TRUE(found(0.5, 0.5));
  EXPECT_TRUE(found(1e-9, 0.5));
  EXPECT_FALSE(found(-0.01, 0.5));
  EXPECT_FALSE(found(0.5, -0.01));
  EXPECT_FALSE(found(-0.5, -0.5));

  SurfaceWalker walker({ &mesh, 0.0, 0.0, &locator });
  EXPECT_FALSE(walker.endsAt(walker.evaluate({ 0, { { 1, 0.75, 0.75 } } }), 1));
  EXPECT_TRUE(walker.endsAt(walker.evaluate({ 0, { { 1, 0.25, 0.75 } } }), 1));
  EXPECT_EQ(walker.endFaceCount({ 0, { { 1, 0.75, 0.75 } } }), 0);
  EXPECT_EQ(walker.endFaceCount({ 0, { { 1, 0.25, 1.0 } } }), 2);
}

TEST(FaceLocator, PassesNoGapWiderThanTolerated)
{
  constexpr double gap = 0.02;
  const ElementMesh mesh = quarterCovered(gap);
  const FaceLocator locator(mesh, 0.0, {});
  std::int64_t evaluations = 0;
  const auto near = locator.locate(mapOfBox({ 0, 0.3, 0.6 }), 0, 1, 1.01 * gap, evaluations);
  ASSERT_TRUE(near.has_value());
  EXPECT_NEAR(near->gap, gap, 1e-9);
  EXPECT_LE(glm::distance(positionAt(mesh, near->location), glm::dvec3(gap, 0.3, 0.6)), 1e-9);
  EXPECT_FALSE(
    locator.locate(mapOfBox({ 0, 0.3, 0.6 }), 0, 1, 0.99 * gap, evaluations).has_value());
}

/// The two faces of a plate look away from each other, and nothing lies behind either. Between them tetrahedra have faces
/// that are inclined, and nearer.
TEST(FaceLocator, FindsNothingBehindAPlateOfTetrahedra)
{
  constexpr double thickness = 0.02;
  MeshRecipe recipe;
  recipe.domain = Domain::Tetrahedron;
  recipe.field = [](const glm::dvec3&) { return 0.0; };
  ElementMesh mesh;
  appendBox(mesh, recipe, { -1, -1, 0 }, { 1, 1, thickness });
  findFaceNeighbors(mesh, 1e-9);
  const FaceLocator locator(mesh, 0.0, {});
  int places = 0;
  visitPlacesAtOpenFaces(
    mesh, locator,
    [&](int, const WorldPoint& place, const std::optional<LocatedPlace>& found, std::int64_t)
    {
      ++places;
      EXPECT_FALSE(found) << place.xyz.x << " " << place.xyz.y << " " << place.xyz.z;
    },
    2.0 * thickness);
  EXPECT_GT(places, 10);
}

TEST(FaceLocator, SurvivesSingularAndPoisonedElements)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double poison : { nan, std::numeric_limits<double>::infinity(), 0.0 })
  {
    ElementMesh mesh = quarterCovered(0.0);
    for (int i = 0; i < 27; ++i)
    {
      mesh.coefficients[mesh.elements[1].firstCoefficient + i].x = poison;
    }
    const FaceLocator locator(mesh, 0.0, {});
    std::int64_t evaluations = 0;
    EXPECT_FALSE(locator.locate(mapOfBox({ 0, 0.3, 0.6 }), 0, 1, 0.1, evaluations).has_value());
    SurfaceWalker walker({ &mesh, 0.0, 0.0, &locator });
    const Evaluated start = walker.evaluate({ 0, { { 0.9, 0.7, 0.7 } } });
    EXPECT_EQ(walker.move(start, { { 0.5, 0, 0 } }).element, 0);
  }
}

} // namespace
} // namespace hop::testing
