#include "SurfaceBoxes.h"

#include "AnalyticFields.h"
#include "ElementCases.h"
#include "SurfaceWalker.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace hop::testing
{
namespace
{

/// A mesh of one straight unit element with random coefficients of f.
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

glm::dvec3 positionAt(const ElementMesh& mesh, const Location& location)
{
  return glm::dvec3(evaluateGradient(mesh.form(location.element), location.u).value);
}

/// Every point of a box lies within its size of its middle.
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

TEST(SurfaceBoxes, LieNearTheSurface)
{
  // The other half of the bargain: the boxes are no more than they have to be.
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

TEST(SurfaceBoxes, TouchingTheIsovalueCounts)
{
  // f = x^2 touches zero in the plane x = 0 without a change of sign.
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
    double looks = 0.0;
    const auto isSmall = [&](const Location&, double size)
    {
      ++looks;
      return size < 0.05;
    };
    findSurfaceBoxes(mesh, 0.0, isSmall, {},
      [&](double share)
      {
        shares.push_back(share);
        work.push_back(looks);
      });
    ASSERT_GT(shares.size(), 50u);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_LT(shares.front(), 0.02);
    EXPECT_EQ(shares.back(), 1.0);
    for (std::size_t n = 1; n < shares.size(); ++n)
    {
      ASSERT_LT(shares[n] - shares[n - 1], 0.1);
      ASSERT_NEAR(shares[n], work[n] / looks, 0.25);
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
    makeMesh(recipe), 0.0, [](const Location&, double) { return true; }, {},
    [&](double share) { shares.push_back(share); });
  ASSERT_FALSE(shares.empty());
  EXPECT_EQ(shares.back(), 1.0);
}

TEST(SurfaceBoxes, ATinySphereInALargeElementIsFound)
{
  MeshRecipe recipe;
  recipe.cells = 1;
  const glm::dvec3 center(0.312, -0.417, 0.233);
  recipe.field = sphere(center, 0.003).field;
  const ElementMesh mesh = makeMesh(recipe);
  const std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, 0.0, 0.5, {});
  EXPECT_TRUE(inSomeBox(mesh, boxes, center + glm::dvec3(0.003, 0, 0)));
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
