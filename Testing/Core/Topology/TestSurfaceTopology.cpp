#include "Topology/SurfaceTopology.h"

#include "AnalyticFields.h"
#include "ElementCases.h"
#include "LatticeTopology.h"
#include "Support/Interruptible.h"
#include "Surface/FaceLocator.h"
#include "TestMeshes.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

/// Euler characteristic and boundary loops of each component, sorted; not proven ones as -1000.
using Numbers = std::vector<std::pair<int, int>>;

Numbers numbersOf(const SurfaceTopology& topology)
{
  Numbers numbers;
  for (const SurfaceComponent& component : topology.components)
  {
    numbers.emplace_back(component.proven ? static_cast<int>(component.eulerCharacteristic) : -1000,
      static_cast<int>(component.boundaryLoops));
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

SurfaceTopology topologyOf(const MeshRecipe& recipe, double isovalue = 0.0)
{
  return findTopology(makeMesh(recipe), isovalue, nullptr, {});
}

MeshRecipe recipeFor(Domain domain, int degree, int cells, const Field& field, const Map& map = {})
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { degree, degree, degree };
  recipe.cells = cells;
  recipe.field = field;
  if (map)
  {
    recipe.map = map;
  }
  return recipe;
}

const glm::dvec3 aside{ 0.0713, -0.0391, 0.0527 };

/// A field in all domains, in straight and in bent elements.
void expectEverywhere(const Field& field, int degree, int cells, const Numbers& wanted)
{
  for (const Domain domain : allDomains)
  {
    for (const bool isBent : { false, true })
    {
      SCOPED_TRACE(::testing::Message() << domain << (isBent ? " bent" : " straight"));
      const SurfaceTopology topology =
        topologyOf(recipeFor(domain, degree, cells, field, isBent ? wavyMap(0.03) : Map{}));
      EXPECT_EQ(numbersOf(topology), wanted);
      EXPECT_TRUE(topology.unresolvedCells.empty());
    }
  }
}

} // namespace

TEST(SurfaceTopology, Sphere)
{
  for (const int cells : { 1, 2, 3 })
  {
    expectEverywhere(sphere(aside, 0.61).field, 3, cells, { { 2, 0 } });
  }
}

TEST(SurfaceTopology, SphereThatTheDomainCuts)
{
  expectEverywhere(sphere(glm::dvec3(0.9, 0.0, 0.0) + aside, 0.61).field, 3, 2, { { 1, 1 } });
  expectEverywhere(sphere(aside, 1.08).field, 2, 2, { { -4, 6 } });
}

TEST(SurfaceTopology, Torus)
{
  const KnownSurface known = torus(0.57, 0.21);
  expectEverywhere([&](const glm::dvec3& x) { return known.field(x - aside); }, 5, 2, { { 0, 0 } });
}

TEST(SurfaceTopology, Cylinder)
{
  const KnownSurface known = cylinder(0.43);
  expectEverywhere([&](const glm::dvec3& x) { return known.field(x - aside); }, 3, 2, { { 0, 2 } });
}

TEST(SurfaceTopology, GenusTwo)
{
  // A figure of eight, y^2 = (1 - x^2) x^2, thickened.
  const Field field = [](const glm::dvec3& at)
  {
    const glm::dvec3 x = (at - glm::dvec3(0.0103, 0.0071, -0.0057)) / 0.87;
    const double curve = x.y * x.y - (1.0 - x.x * x.x) * x.x * x.x;
    return 0.01 - x.z * x.z - curve * curve;
  };
  ASSERT_EQ(latticeTopology(field, 60), Numbers({ { -2, 0 } }));
  for (const Domain domain : allDomains)
  {
    EXPECT_EQ(numbersOf(topologyOf(recipeFor(domain, 8, 1, field))), Numbers({ { -2, 0 } }))
      << domain;
  }
}

TEST(SurfaceTopology, GenusFive)
{
  // The tangle cube.
  const Field field = [](const glm::dvec3& at)
  {
    const glm::dvec3 x = 2.7 * (at - glm::dvec3(0.0103, 0.0071, -0.0057));
    const glm::dvec3 square = x * x;
    return 5.0 * (square.x + square.y + square.z) - glm::dot(square, square) - 11.8;
  };
  expectEverywhere(field, 4, 1, { { -8, 0 } });
  expectEverywhere(field, 4, 3, { { -8, 0 } });
}

TEST(SurfaceTopology, SpheresThatNearlyTouch)
{
  // In one element of size 2 they are 3e-3 of its size apart.
  const auto both = bothOf(sphere({ -0.413, 0.02, 0.01 }, 0.4), sphere({ 0.393, 0.02, 0.01 }, 0.4));
  EXPECT_EQ(numbersOf(topologyOf(recipeFor(Domain::Hexahedron, 4, 1, both.field))),
    Numbers({ { 2, 0 }, { 2, 0 } }));
  EXPECT_EQ(numbersOf(topologyOf(recipeFor(Domain::Wedge, 4, 1, both.field))),
    Numbers({ { 2, 0 }, { 2, 0 } }));
  EXPECT_EQ(numbersOf(topologyOf(recipeFor(Domain::Tetrahedron, 4, 2, both.field))),
    Numbers({ { 2, 0 }, { 2, 0 } }));
}

TEST(SurfaceTopology, SurfacesThroughCornersOfElements)
{
  const glm::dvec3 middle(0.131, 0.072, 0.213);
  for (const glm::dvec3 corner : { glm::dvec3(0.5, 0.5, 0.0), glm::dvec3(0.0, -0.5, 0.5) })
  {
    expectEverywhere(sphere(middle, glm::length(corner - middle)).field, 2, 4, { { 2, 0 } });
  }
  // Through corners, through edges, and in faces.
  expectEverywhere([](const glm::dvec3& x) { return x.x + x.y + x.z; }, 2, 2, { { 1, 1 } });
  expectEverywhere([](const glm::dvec3& x) { return x.x - x.y; }, 2, 2, { { 1, 1 } });
  expectEverywhere([](const glm::dvec3& x) { return -x.z; }, 2, 2, { { 1, 1 } });
}

TEST(SurfaceTopology, SingularPlacesInCornersEdgesAndFacesAreNotProven)
{
  const Field cone = [](const glm::dvec3& x) { return x.z * x.z - x.x * x.x - 0.7 * x.y * x.y; };
  const Field point = [](const glm::dvec3& x) { return -glm::dot(x, x); };
  // Two sheets that cross in a face, and in an edge of elements.
  const Field inFace = [](const glm::dvec3& x) { return x.x * (x.y - 0.3); };
  const Field inEdge = [](const glm::dvec3& x) { return x.x * x.y; };
  for (const Domain domain : allDomains)
  {
    EXPECT_FALSE(topologyOf(recipeFor(domain, 2, 2, cone)).isProven()) << domain;
    EXPECT_FALSE(topologyOf(recipeFor(domain, 2, 2, point)).isProven()) << domain;
    EXPECT_FALSE(topologyOf(recipeFor(domain, 2, 2, inFace)).isProven()) << domain;
    EXPECT_FALSE(topologyOf(recipeFor(domain, 2, 2, inEdge)).isProven()) << domain;
  }
}

TEST(SurfaceTopology, SingularPlacesAreNotProven)
{
  const Field cone = [](const glm::dvec3& at)
  {
    const glm::dvec3 x = at - aside;
    return x.z * x.z - x.x * x.x - x.y * x.y;
  };
  for (const Domain domain : allDomains)
  {
    const SurfaceTopology topology = topologyOf(recipeFor(domain, 2, 2, cone));
    EXPECT_FALSE(topology.isProven()) << domain;
    EXPECT_EQ(topology.unresolvedCells.size(), 1u) << domain;
    for (const SurfaceComponent& component : topology.components)
    {
      EXPECT_FALSE(component.proven) << domain;
    }
  }
}

TEST(SurfaceTopology, ComponentsAwayFromSingularPlacesAreProven)
{
  // A sphere in one corner of the cube, a point where the field only touches the isovalue in another one.
  const Field field = [](const glm::dvec3& x)
  {
    const double toPoint = glm::dot(x + glm::dvec3(0.51), x + glm::dvec3(0.51));
    const double toSphere = glm::dot(x - glm::dvec3(0.47), x - glm::dvec3(0.47)) - 0.09;
    return toPoint * toSphere;
  };
  const SurfaceTopology topology = topologyOf(recipeFor(Domain::Hexahedron, 4, 2, field));
  EXPECT_EQ(numbersOf(topology), Numbers({ { 2, 0 } }));
  EXPECT_EQ(topology.unresolvedCells.size(), 1u);
  EXPECT_FALSE(topology.isProven());
}

TEST(SurfaceTopology, PlateausAreNotProven)
{
  const SurfaceTopology topology =
    topologyOf(recipeFor(Domain::Hexahedron, 2, 2, [](const glm::dvec3&) { return 0.0; }));
  EXPECT_TRUE(topology.components.empty());
  EXPECT_EQ(topology.unresolvedCells.size(), 8u);
  EXPECT_FALSE(topology.isProven());
}

TEST(SurfaceTopology, FieldsThatAreNotFiniteAreNotProven)
{
  ElementMesh mesh = makeMesh(recipeFor(Domain::Tetrahedron, 3, 1, sphere(aside, 0.61).field));
  mesh.coefficients[7].w = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(findTopology(mesh, 0.0, nullptr, {}).isProven());
}

TEST(SurfaceTopology, RandomPolynomialsAgreeWithALattice)
{
  Random random(11);
  int wrong = 0, cases = 0;
  for (int n = 0; n < 12; ++n)
  {
    std::array<double, 20> factors{};
    std::generate(factors.begin(), factors.end(), [&]() { return randomNumber(random); });
    const Field field = [=](const glm::dvec3& at)
    {
      // Products of Chebyshev polynomials: as many waves as the degree allows.
      const glm::dvec3 x = glm::clamp(at, -1.0, 1.0);
      double sum = 0.0;
      for (int i = 0, term = 0; i <= 3; ++i)
      {
        for (int j = 0; i + j <= 3; ++j)
        {
          for (int k = 0; i + j + k <= 3; ++k)
          {
            sum += factors[term++] * std::cos(i * std::acos(x.x)) * std::cos(j * std::acos(x.y)) *
              std::cos(k * std::acos(x.z));
          }
        }
      }
      return sum;
    };
    Numbers seen = latticeTopology(field, 24);
    for (const Domain domain : allDomains)
    {
      const SurfaceTopology topology = topologyOf(recipeFor(domain, 3, 1 + n % 3, field));
      EXPECT_TRUE(topology.isProven()) << domain << " " << n;
      const Numbers found = numbersOf(topology);
      for (int lattice = 48; found != seen && lattice <= 96; lattice += 48)
      {
        seen = latticeTopology(field, lattice); // small parts of the surface want a finer lattice
      }
      EXPECT_EQ(found, seen) << domain << " " << n;
      wrong += found != seen;
      ++cases;
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << cases;
}

TEST(SurfaceTopology, HangingNodes)
{
  const auto expectProven = [](Domain domain, const Field& field, const Numbers& wanted)
  {
    const MeshRecipe recipe = recipeFor(domain, 4, 1, field);
    const ElementMesh mesh = hangingMesh(recipe, recipe);
    const FaceLocator locator(mesh, 0.0, {});
    EXPECT_EQ(numbersOf(findTopology(mesh, 0.0, &locator, {})), wanted);
  };
  const glm::dvec3 middle(0.0513, 0.0391, 0.0227);
  const KnownSurface ring = torus(0.57, 0.21);
  const Field tilted = [=](const glm::dvec3& x)
  { return ring.field(glm::dvec3(x.y, x.z, x.x) - middle); };
  expectProven(Domain::Hexahedron, sphere(middle, 0.61).field, { { 2, 0 } });
  expectProven(Domain::Hexahedron, sphere(middle, 1.07).field, { { -4, 6 } });
  expectProven(
    Domain::Hexahedron, [=](const glm::dvec3& x) { return ring.field(x - middle); }, { { 0, 0 } });
  expectProven(Domain::Hexahedron, tilted, { { 0, 0 } });
  // A small sphere in one of the smaller faces, and one across all of them.
  expectProven(Domain::Hexahedron, sphere({ 0.01, 0.41, 0.53 }, 0.2).field, { { 2, 0 } });
  expectProven(Domain::Hexahedron, sphere({ -0.31, 0.02, 0.01 }, 0.42).field, { { 2, 0 } });
}

TEST(SurfaceTopology, JumpsAreNotProven)
{
  ElementMesh mesh = makeMesh(recipeFor(Domain::Hexahedron, 3, 2, sphere(aside, 0.61).field));
  const Element& element = mesh.elements[3];
  for (int i = 0; i < coefficientCount(element.domain, element.degrees); ++i)
  {
    mesh.coefficients[element.firstCoefficient + i].w += 1e-2;
  }
  const SurfaceTopology topology = findTopology(mesh, 0.0, nullptr, {});
  EXPECT_TRUE(topology.unresolvedCells.empty());
  EXPECT_FALSE(topology.isProven());
}

TEST(SurfaceTopology, FindsTheComponentOfAPlace)
{
  const auto both = bothOf(sphere({ -0.413, 0.02, 0.01 }, 0.4), sphere({ 0.393, 0.02, 0.01 }, 0.4));
  const ElementMesh mesh = makeMesh(recipeFor(Domain::Wedge, 4, 1, both.field));
  const SurfaceTopology topology = findTopology(mesh, 0.0, nullptr, {});
  ASSERT_EQ(topology.components.size(), 2u);
  std::array<int, 2> componentOf{ -1, -1 };
  for (int n = 0; n < 2000; ++n)
  {
    const bool isRight = n % 2 == 1;
    const double z = 1.0 - (n + 0.5) / 1000.0, angle = 2.4 * n, r = std::sqrt(1.0 - z * z);
    const glm::dvec3 x = glm::dvec3(isRight ? 0.393 : -0.413, 0.02, 0.01) +
      0.4 * glm::dvec3(z, r * std::cos(angle), r * std::sin(angle));
    // Two wedges over the triangles below and above the diagonal of the square.
    const glm::dvec3 t = 0.5 * (x + 1.0);
    const Location place = t.y <= t.x ? Location{ 0, { { t.x - t.y, t.y, t.z } } }
                                      : Location{ 1, { { t.x, t.y - t.x, t.z } } };
    const int component = topology.componentAt(place);
    EXPECT_TRUE(componentOf[isRight] < 0 || componentOf[isRight] == component);
    componentOf[isRight] = component;
  }
  EXPECT_NE(componentOf[0], componentOf[1]);
}

TEST(SurfaceTopology, IsTheSameForAnyNumberOfThreads)
{
  const ElementMesh mesh = makeMesh(recipeFor(Domain::Tetrahedron, 4, 3, gyroid(2.0)));
  const SurfaceTopology one = findTopology(mesh, 0.31, nullptr, {});
  const SurfaceTopology many = findTopology(mesh, 0.31, nullptr, threadedFor(5));
  EXPECT_FALSE(one.components.empty());
  EXPECT_EQ(one.componentOfPiece, many.componentOfPiece);
  EXPECT_EQ(numbersOf(one), numbersOf(many));
}

/// Between one of its loops and the next the caller may be asked.
TEST(SurfaceTopology, ElementsThatTakeLongAreSplitInManyLoopsByAllThreads)
{
  // The field only touches the isovalue, on a sphere: boxes there are split as often as they may be.
  const Field field = [](const glm::dvec3& x)
  { return std::pow(glm::dot(x - aside, x - aside) - 0.61, 2); };
  const ElementMesh mesh = makeMesh(recipeFor(Domain::Hexahedron, 4, 2, field));
  int loops = 0;
  const ParallelFor counted = [&](std::ptrdiff_t count, const LoopBody& body)
  {
    ++loops;
    body(0, count);
  };
  const SurfaceTopology one = findTopology(mesh, 0.0, nullptr, counted);
  const SurfaceTopology many = findTopology(mesh, 0.0, nullptr, threadedFor(5));
  EXPECT_GT(loops, 4 * static_cast<int>(mesh.elements.size()));
  EXPECT_FALSE(one.isProven());
  EXPECT_EQ(one.componentOfPiece, many.componentOfPiece);
  EXPECT_EQ(numbersOf(one), numbersOf(many));
}

TEST(SurfaceTopology, StopsWhenAsked)
{
  const ElementMesh mesh = makeMesh(recipeFor(Domain::Hexahedron, 3, 3, sphere(aside, 0.61).field));
  const Monitor monitor{ [](double) { return false; } };
  const ParallelFor alone;
  Interruptible loops(monitor, alone);
  EXPECT_THROW(findTopology(mesh, 0.0, nullptr, std::ref(loops)), Interrupted);
}

} // namespace hop::testing
