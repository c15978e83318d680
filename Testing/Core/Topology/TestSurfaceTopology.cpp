#include "Topology/SurfaceTopology.h"

#include "AnalyticFields.h"
#include "ElementCases.h"
#include "TestMeshes.h"

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

} // namespace hop::testing
