#include "Isolation/SurfaceBoxes.h"

#include "AnalyticFields.h"
#include "ElementCases.h"
#include "Isolation/ElementSplitter.h"
#include "Surface/Energy.h"
#include "Surface/SurfaceWalker.h"
#include "SurfaceSeeds.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace hop::testing
{
namespace
{

/// A mesh of one straight unit element with random coefficients of the field.
ElementMesh randomField(const ElementCase& which, Random& random)
{
  ElementMesh mesh;
  Element element;
  element.domain = which.domain;
  element.degrees = which.degrees;
  mesh.elements.push_back(element);
  for (const LatticePoint& point : latticePoints(which.domain, which.degrees))
  {
    mesh.coefficients.emplace_back(latticePosition(which.degrees, point).xyz, randomNumber(random));
  }
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

/// Whether a position may be in a box: every point of a box lies within the size of the box from its middle.
bool inSomeBox(
  const ElementMesh& mesh, const std::vector<SurfaceBox>& boxes, const glm::dvec3& position)
{
  return std::any_of(boxes.begin(), boxes.end(),
    [&](const SurfaceBox& box)
    { return glm::distance(positionAt(mesh, box.middle), position) <= box.size; });
}

TEST(SurfaceBoxes, HoldAllOfTheSurface)
{
  Random random(1);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const ElementMesh mesh = randomField(which, random);
    const std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, 0.0, 0.3, {});
    const auto valueAt = [&](const glm::dvec3& u)
    { return evaluateGradient(mesh.form(0), { u }).value.w; };
    for (int n = 0; n < 40; ++n)
    {
      // Between two points of different sign there is a point of the surface: bisect for it.
      glm::dvec3 a = randomPoint(which.domain, random).xyz;
      glm::dvec3 b = randomPoint(which.domain, random).xyz;
      if ((valueAt(a) < 0.0) == (valueAt(b) < 0.0))
      {
        continue;
      }
      for (int step = 0; step < 40; ++step)
      {
        const glm::dvec3 middle = 0.5 * (a + b);
        ((valueAt(a) < 0.0) == (valueAt(middle) < 0.0) ? a : b) = middle;
      }
      EXPECT_TRUE(inSomeBox(mesh, boxes, a));
    }
  }
}

/// Two sheets that cross along a line to the apex of a pyramid are undecided there, however often pieces are halved.
TEST(SurfaceBoxes, AreNotHalvedToNothingInAnApex)
{
  ElementMesh mesh;
  mesh.elements.emplace_back();
  for (const LatticePoint& point : latticePoints(Domain::Hexahedron, { 1, 1, 1 }))
  {
    const glm::dvec3 u = latticePosition({ 1, 1, 1 }, point).xyz;
    mesh.coefficients.emplace_back(
      (1.0 - u.z) * u.x, (1.0 - u.z) * u.y, u.z, (u.x - 0.4) * (u.y - 0.4));
  }
  findFaceNeighbors(mesh, 1e-9);
  const std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, 0.0, 0.3, {});
  double smallest = 1.0;
  for (const SurfaceBox& box : boxes)
  {
    smallest = std::min(smallest, box.certified ? 1.0 : box.size);
  }
  EXPECT_LT(smallest, 0x1p-10);
  EXPECT_GT(smallest, 0x1p-15);
}

TEST(SurfaceBoxes, LieNearTheSurface)
{
  // Boxes that hold all of the surface are no proof: all of the mesh would do.
  for (const Domain domain : allDomains)
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.field = sphere({ 0, 0, 0 }, 0.6).field;
    const ElementMesh mesh = makeMesh(recipe);
    const std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, 0.0, 0.1, {});
    EXPECT_GT(boxes.size(), 400u) << domain;
    for (const SurfaceBox& box : boxes)
    {
      const double distance = std::abs(glm::length(positionAt(mesh, box.middle)) - 0.6);
      EXPECT_LE(distance, 1.5 * box.size) << domain;
    }
  }
}

TEST(SurfaceBoxes, AreNoLargerThanWanted)
{
  for (const Domain domain : allDomains)
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.degrees = { 4, 4, 4 };
    recipe.map = wavyMap(0.15);
    recipe.field = sphere({ 0, 0, 0 }, 0.6).field;
    const ElementMesh mesh = makeMesh(recipe);
    for (const double wanted : { 0.1, 0.5 })
    {
      for (const SurfaceBox& box : findSurfaceBoxes(mesh, 0.0, wanted, {}))
      {
        EXPECT_GT(box.size, 0.0);
        EXPECT_LE(box.size, wanted);
        EXPECT_GE(insideMargin(domain, box.middle.u), 0.0);
      }
    }
  }
}

TEST(SurfaceBoxes, ElementsWithoutSurfaceGiveNone)
{
  for (const Domain domain : allDomains)
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.cells = 3;
    recipe.field = sphere({ 0.6, 0.6, 0.6 }, 0.2).field;
    const ElementMesh mesh = makeMesh(recipe);
    EXPECT_TRUE(findSurfaceBoxes(mesh, 10.0, 0.1, {}).empty());
    const std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, 0.0, 0.1, {});
    EXPECT_FALSE(boxes.empty());
    for (const SurfaceBox& box : boxes)
    {
      // Only elements of the cube around the sphere.
      const glm::dvec3 x = positionAt(mesh, box.middle);
      EXPECT_GT(std::min({ x.x, x.y, x.z }), 1.0 / 3.0) << domain;
    }
  }
}

TEST(SurfaceBoxes, HoldTangenciesToTheIsovalue)
{
  // f = x^2 is zero in the plane x = 0 without a change of sign.
  MeshRecipe recipe;
  recipe.cells = 1;
  recipe.field = [](const glm::dvec3& x) { return x.x * x.x; };
  EXPECT_FALSE(findSurfaceBoxes(makeMesh(recipe), 0.0, 0.2, {}).empty());
}

TEST(SurfaceBoxes, AreTheSameForAnyNumberOfThreads)
{
  MeshRecipe recipe;
  recipe.degrees = { 3, 3, 3 };
  recipe.cells = 4;
  recipe.map = wavyMap(0.15);
  recipe.field = gyroid(0.7);
  const ElementMesh mesh = makeMesh(recipe);
  const std::vector<SurfaceBox> serial = findSurfaceBoxes(mesh, 0.1, 0.1, {});
  const std::vector<SurfaceBox> threaded = findSurfaceBoxes(mesh, 0.1, 0.1, threadedFor(4));
  ASSERT_EQ(threaded.size(), serial.size());
  for (std::size_t i = 0; i < serial.size(); ++i)
  {
    EXPECT_EQ(threaded[i].middle.element, serial[i].middle.element);
    EXPECT_EQ(threaded[i].middle.u.xyz, serial[i].middle.u.xyz);
    EXPECT_EQ(threaded[i].size, serial[i].size);
  }
}

TEST(SurfaceBoxes, AreKeptWhereTheyAreKnownAndMayStay)
{
  MeshRecipe recipe;
  recipe.degrees = { 3, 3, 3 };
  recipe.map = wavyMap(0.15);
  recipe.field = gyroid(0.7);
  for (const int cells : { 2, 4 }) // 64 elements are split in another loop than a few
  {
    SCOPED_TRACE(cells);
    recipe.cells = cells;
    const ElementMesh mesh = makeMesh(recipe);
    std::atomic<int> asked{ 0 };
    // Coarse, but not at one end.
    const auto isFineEnough = [&](const SurfaceBox& box)
    {
      ++asked;
      return box.size < (positionAt(mesh, box.middle).x < 0.0 ? 0.3 : 0.1);
    };
    const std::vector<SurfaceBox> found = findSurfaceBoxes(mesh, 0.1, isFineEnough, {});
    const int askedAtFirst = asked.exchange(0);
    const std::vector<SurfaceBox> coarse = findSurfaceBoxes(mesh, 0.1, 0.3, {});
    const auto refined =
      findSurfaceBoxes(mesh, 0.1, isFineEnough, threadedFor(4), {}, { &coarse, isFineEnough });
    EXPECT_LT(asked, askedAtFirst);
    ASSERT_EQ(refined.size(), found.size());
    for (std::size_t b = 0; b < found.size(); ++b)
    {
      EXPECT_EQ(refined[b].middle.element, found[b].middle.element);
      EXPECT_EQ(refined[b].middle.u.xyz, found[b].middle.u.xyz);
    }
    asked = 0;
    const auto same = findSurfaceBoxes(mesh, 0.1, isFineEnough, {}, {}, { &found, isFineEnough });
    EXPECT_EQ(same.size(), found.size());
    EXPECT_EQ(asked, static_cast<int>(found.size()));
  }
}

TEST(SurfaceBoxes, TellWhatShareOfTheWorkIsDone)
{
  MeshRecipe recipe;
  recipe.degrees = { 8, 8, 8 };
  recipe.field = sphere(glm::dvec3(0.1, -0.05, 0.02), 0.6).field;
  for (const int cells : { 1, 2, 5 }) // 125 elements are split in another loop than a few
  {
    SCOPED_TRACE(cells);
    recipe.cells = cells;
    const ElementMesh mesh = makeMesh(recipe);
    std::vector<double> shares;
    std::vector<double> work;
    double boxesAsked = 0.0;
    const auto isSmall = [&](const SurfaceBox& box)
    {
      ++boxesAsked;
      return box.size < 0.05;
    };
    findSurfaceBoxes(mesh, 0.0, isSmall, {},
      [&](double share)
      {
        shares.push_back(share);
        work.push_back(boxesAsked);
      });
    ASSERT_GT(shares.size(), 50u);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_LT(shares.front(), 0.02);
    EXPECT_EQ(shares.back(), 1.0);
    for (std::size_t n = 1; n < shares.size(); ++n)
    {
      ASSERT_LT(shares[n] - shares[n - 1], 0.1);
      ASSERT_NEAR(shares[n], work[n] / boxesAsked, 0.25);
    }
  }
}

TEST(SurfaceBoxes, WorkOnElementsWithoutSurfaceIsDoneAtOnce)
{
  MeshRecipe recipe;
  recipe.cells = 1;
  recipe.field = [](const glm::dvec3& x) { return 3.0 + x.x; };
  std::vector<double> shares;
  findSurfaceBoxes(
    makeMesh(recipe), 0.0, [](const SurfaceBox&) { return true; }, {},
    [&](double share) { shares.push_back(share); });
  ASSERT_FALSE(shares.empty());
  EXPECT_EQ(shares.back(), 1.0);
}

TEST(SurfaceBoxes, ASphereFarSmallerThanItsElementIsFound)
{
  MeshRecipe recipe;
  recipe.cells = 1;
  const glm::dvec3 center(0.312, -0.417, 0.233);
  recipe.field = sphere(center, 0.003).field;
  const ElementMesh mesh = makeMesh(recipe);
  const std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, 0.0, 0.5, {});
  EXPECT_TRUE(inSomeBox(mesh, boxes, center + glm::dvec3(0.003, 0, 0)));
}

/// A mesh of one cell of the cube.
ElementMesh oneCell(Domain domain, int degree, const Field& field)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { degree, degree, degree };
  recipe.cells = 1;
  recipe.field = field;
  return makeMesh(recipe);
}

/// Fields of degree 4 that come to zero without crossing it.
const std::vector<std::pair<const char*, Field>>& tangentFields()
{
  static const std::vector<std::pair<const char*, Field>> all{
    { "a double plane", [](const glm::dvec3& x) { return (x.x - 0.113) * (x.x - 0.113); } },
    { "the square of a velocity at a wall",
      [](const glm::dvec3& x)
      {
        const double z = x.z + 1.0;
        return z * z * ((1.0 + 0.3 * x.x) * (1.0 + 0.3 * x.x) + 0.04 * x.y * x.y);
      } },
    { "a double sphere",
      [](const glm::dvec3& x)
      {
        const double f = glm::dot(x, x) - 0.49;
        return -f * f;
      } },
    { "the corner between two walls",
      [](const glm::dvec3& x) { return (x.z + 1.0) * (x.z + 1.0) * (x.y + 1.0) * (x.y + 1.0); } },
    { "an edge",
      [](const glm::dvec3& x) { return (x.z + 1.0) * (x.z + 1.0) + (x.y + 1.0) * (x.y + 1.0); } },
    { "nothing but the isovalue", [](const glm::dvec3&) { return 0.0; } },
  };
  return all;
}

TEST(SurfaceBoxes, TangentFieldsAreLeftUndecidedEarlyInFewBoxes)
{
  for (const Domain domain : allDomains)
  {
    for (const auto& [name, field] : tangentFields())
    {
      SCOPED_TRACE(::testing::Message() << domain << ", " << name);
      const ElementMesh mesh = oneCell(domain, 4, field);
      std::size_t pieces = 0;
      const auto isSmall = [](const SurfaceBox&) { return true; };
      const std::vector<SurfaceBox> boxes =
        findSurfaceBoxes(mesh, 0.0, isSmall, {}, [&](double) { ++pieces; });
      EXPECT_GT(uncertifiedCount(boxes), 0);
      EXPECT_LE(boxes.size(), 16 * mesh.elements.size());
      EXPECT_LE(pieces, 1000 * mesh.elements.size());
    }
  }
}

TEST(SurfaceBoxes, WhereTheSurfaceCrossesItselfBoxesAreBounded)
{
  for (const Domain domain : allDomains)
  {
    const ElementMesh mesh =
      oneCell(domain, 2, [](const glm::dvec3& x) { return (x.x - 0.113) * (x.y + 0.207); });
    const auto boxes = findSurfaceBoxes(mesh, 0.0, 10.0, {});
    EXPECT_GT(uncertifiedCount(boxes), 0) << domain;
    EXPECT_LE(boxes.size(), 3 * TooManyPieces::LongCount * mesh.elements.size()) << domain;
  }
}

TEST(SurfaceBoxes, NoThreadIsLeftAloneWithAnElementThatTakesLong)
{
  // The surface crosses itself in three of 27 elements, which are split each by one thread at first.
  MeshRecipe recipe;
  recipe.degrees = { 2, 2, 2 };
  recipe.cells = 3;
  recipe.field = [](const glm::dvec3& x) { return (x.x - 0.113) * (x.y + 0.207); };
  const ElementMesh mesh = makeMesh(recipe);
  int loops = 0;
  const ParallelFor counting = [&](std::ptrdiff_t count, const LoopBody& body)
  {
    ++loops;
    runInThreads({}, count, body);
  };
  const auto boxes = findSurfaceBoxes(mesh, 0.0, 10.0, counting);
  EXPECT_GT(loops, 3 * 10); // one a level
  EXPECT_EQ(boxes.size(), findSurfaceBoxes(mesh, 0.0, 10.0, threadedFor(4)).size());
  EXPECT_TRUE(std::is_sorted(boxes.begin(), boxes.end(),
    [](const SurfaceBox& a, const SurfaceBox& b) { return a.middle.element < b.middle.element; }));
}

TEST(SurfaceBoxes, ASphereIsFoundBesideATangency)
{
  const glm::dvec3 center(0.312, -0.417, 0.233);
  for (const Domain domain : allDomains)
  {
    for (const double radius : { 0.003, 0.02, 0.2 })
    {
      SCOPED_TRACE(::testing::Message() << domain << ", radius " << radius);
      const Field ball = sphere(center, radius).field;
      const ElementMesh mesh = oneCell(
        domain, 4, [&](const glm::dvec3& x) { return (x.x + 0.4) * (x.x + 0.4) * ball(x); });
      std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, 0.0, 0.5, {});
      EXPECT_GT(uncertifiedCount(boxes), 0);
      boxes.erase(std::remove_if(boxes.begin(), boxes.end(),
                    [](const SurfaceBox& box) { return !box.certified; }),
        boxes.end());
      for (const glm::dvec3& axis : { glm::dvec3(1, 0, 0), { 0, 1, 0 }, { 0, 0, -1 } })
      {
        EXPECT_TRUE(inSomeBox(mesh, boxes, center + radius * axis));
      }
    }
  }
}

TEST(SurfaceBoxes, TwoSheetsNearEachOtherAreToldFromATangency)
{
  for (const Domain domain : allDomains)
  {
    const ElementMesh mesh = oneCell(
      domain, 2, [](const glm::dvec3& x) { return (x.x - 0.3337) * (x.x - 0.3337) - 9e-4; });
    const auto boxes = findSurfaceBoxes(mesh, 0.0, 10.0, {});
    EXPECT_EQ(uncertifiedCount(boxes), 0) << domain;
    EXPECT_TRUE(inSomeBox(mesh, boxes, { 0.3637, 0.1, 0.2 })) << domain;
    EXPECT_TRUE(inSomeBox(mesh, boxes, { 0.3037, 0.1, 0.2 })) << domain;
  }
}

TEST(SurfaceBoxes, TwoSheetsInAThousandthOfAnElementShareFewBoxes)
{
  constexpr double gap = 0.001;
  const glm::dvec3 point(0.31, 0.17, -0.2);
  for (const Domain domain : allDomains)
  {
    for (const glm::dvec3& direction : { glm::dvec3(0, 0, 1), { 1, 0, 0 }, { 1, 2, 3 } })
    {
      const glm::dvec3 normal = glm::normalize(direction);
      const auto field = [&](const glm::dvec3& x)
      {
        const double distance = glm::dot(normal, x - point);
        return distance * distance - 0.25 * gap * gap;
      };
      const ElementMesh mesh = oneCell(domain, 2, field);
      const auto boxes = findSurfaceBoxes(mesh, 0.0, 10.0, {});
      EXPECT_EQ(uncertifiedCount(boxes), 0) << domain;
      EXPECT_LT(boxes.size(), 1500u) << domain;
      for (const double side : { -0.5, 0.5 })
      {
        const auto isNear = [&](const SurfaceBox& box)
        {
          const glm::dvec3 middle = positionAt(mesh, box.middle);
          return glm::distance(middle, point) <= box.size &&
            std::abs(glm::dot(normal, middle - point) - side * gap) < 1e-6;
        };
        EXPECT_TRUE(std::any_of(boxes.begin(), boxes.end(), isNear)) << domain << ", " << side;
      }
    }
  }
}

TEST(SurfaceBoxes, ABoxBesideAWallMayBeMuchLargerThanTheDistanceOfTheSurface)
{
  // The square of a speed that grows from the wall at z = -1, less a small constant.
  const auto field = [](const glm::dvec3& x)
  { return (1.0 + x.z) * (1.0 + x.z) * (1.0 + 0.2 * x.x) - 1e-6; };
  for (const Domain domain : allDomains)
  {
    const auto boxes = findSurfaceBoxes(oneCell(domain, 3, field), 0.0, 10.0, {});
    EXPECT_GT(boxes.size(), 0u) << domain;
    EXPECT_LT(boxes.size(), 30u) << domain;
    EXPECT_EQ(uncertifiedCount(boxes), 0) << domain;
    EXPECT_TRUE(std::all_of(
      boxes.begin(), boxes.end(), [](const SurfaceBox& box) { return box.risesWeakly; }))
      << domain;
  }
}

TEST(SurfaceBoxes, AnElementMayCloseOnItself)
{
  MeshRecipe recipe;
  recipe.degrees = { 8, 2, 2 };
  recipe.cells = 1;
  recipe.map = [](const glm::dvec3& x)
  {
    const double r = 2.0 + 0.5 * x.y;
    return glm::dvec3(r * std::cos(Pi * x.x), r * std::sin(Pi * x.x), x.z);
  };
  recipe.field = [](const glm::dvec3& x) { return x.z + 0.05 * x.x; };
  constexpr double wanted = 0.5;
  const auto boxes = findSurfaceBoxes(makeMesh(recipe), 0.0, wanted, {});
  // The ring's area over the area of a box's face, times one to twenty.
  EXPECT_GT(boxes.size(), 50u);
  EXPECT_LT(boxes.size(), 1000u);
}

TEST(SurfaceBoxes, FieldsOfAnySizeGiveTheSameBoxes)
{
  const Field field = gyroid(0.7);
  const auto boxesOf = [&](double unit)
  {
    return findSurfaceBoxes(
      oneCell(Domain::Hexahedron, 6, [&](const glm::dvec3& x) { return unit * field(x); }), 0.0,
      0.3, {});
  };
  const std::vector<SurfaceBox> expected = boxesOf(1.0);
  for (const double unit : { std::ldexp(1.0, -140), std::ldexp(1.0, 140) })
  {
    const std::vector<SurfaceBox> boxes = boxesOf(unit);
    ASSERT_EQ(boxes.size(), expected.size());
    for (std::size_t b = 0; b < boxes.size(); ++b)
    {
      ASSERT_EQ(boxes[b].values, expected[b].values);
      ASSERT_EQ(boxes[b].valueUnit, unit * expected[b].valueUnit);
    }
  }
}

TEST(SurfaceBoxes, EndAtNaN)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Coefficient& poison : { Coefficient(0, 0, 0, nan), Coefficient(nan, 0, 0, 0) })
  {
    for (const std::size_t where : { 0, 13, 26 })
    {
      MeshRecipe recipe;
      recipe.cells = 1;
      ElementMesh mesh = makeMesh(recipe);
      mesh.coefficients[where] += poison;
      EXPECT_LT(findSurfaceBoxes(mesh, 0.0, 0.3, {}).size(), 10000u) << where;
    }
  }
}

TEST(SurfaceBoxes, NoElementsNoBoxes)
{
  EXPECT_TRUE(findSurfaceBoxes({}, 0.0, 1.0, {}).empty());
}

} // namespace
} // namespace hop::testing
