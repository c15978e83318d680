#include "Elements/CanonicalOrder.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

namespace hop::testing
{
namespace
{

constexpr int cellsPerSide = 4;

ElementMesh boxes(Domain domain)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.cells = cellsPerSide;
  recipe.map = wavyMap(0.1);
  recipe.field = [](const glm::dvec3& x) { return x.x * x.y - x.z; };
  ElementMesh mesh = makeMesh(recipe);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    mesh.elements[e].cell = static_cast<std::int64_t>(e);
  }
  return mesh;
}

std::vector<std::int64_t> cellsInOrder(const ElementMesh& mesh)
{
  std::vector<std::int64_t> cells;
  for (const int e : canonicalOrder(mesh))
  {
    cells.push_back(mesh.elements[e].cell);
  }
  return cells;
}

class CanonicalOrder : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(Domains, CanonicalOrder, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(CanonicalOrder, DoesNotDependOnTheOrderOfTheElements)
{
  ElementMesh mesh = boxes(this->GetParam());
  const std::vector<std::int64_t> expected = cellsInOrder(mesh);
  std::vector<std::int64_t> all = expected;
  std::sort(all.begin(), all.end());
  for (std::size_t e = 0; e < all.size(); ++e)
  {
    ASSERT_EQ(all[e], static_cast<std::int64_t>(e));
  }
  std::mt19937 random(3);
  std::shuffle(mesh.elements.begin(), mesh.elements.end(), random);
  EXPECT_EQ(cellsInOrder(mesh), expected);
}

TEST_P(CanonicalOrder, DoesNotDependOnWhichOtherElementsThereAre)
{
  ElementMesh mesh = boxes(this->GetParam());
  const auto isKept = [](std::int64_t cell) { return cell % 3 == 0; };
  std::vector<std::int64_t> expected = cellsInOrder(mesh);
  expected.erase(
    std::remove_if(expected.begin(), expected.end(), std::not_fn(isKept)), expected.end());
  const auto end = std::remove_if(mesh.elements.begin(), mesh.elements.end(),
    [&](const Element& element) { return !isKept(element.cell); });
  mesh.elements.erase(end, mesh.elements.end());
  EXPECT_EQ(cellsInOrder(mesh), expected);
}

TEST(CanonicalOrderOfBoxes, TellsElementsInOnePlaceApartByTheirFields)
{
  ElementMesh mesh = boxes(Domain::Hexahedron);
  // The same elements again, with another field in the last coefficient.
  const std::size_t count = mesh.coefficients.size();
  mesh.coefficients.resize(2 * count);
  std::copy_n(mesh.coefficients.begin(), count, mesh.coefficients.begin() + count);
  const std::size_t elements = mesh.elements.size();
  for (std::size_t e = 0; e < elements; ++e)
  {
    Element copy = mesh.elements[e];
    copy.cell += static_cast<std::int64_t>(elements);
    copy.firstCoefficient += count;
    mesh.coefficients[copy.firstCoefficient + 26].w -= 1.0;
    mesh.elements.push_back(copy);
  }
  const std::vector<std::int64_t> expected = cellsInOrder(mesh);
  std::reverse(mesh.elements.begin(), mesh.elements.end());
  EXPECT_EQ(cellsInOrder(mesh), expected);
  for (std::size_t i = 0; i < expected.size(); i += 2)
  {
    EXPECT_EQ(expected[i], expected[i + 1] + static_cast<std::int64_t>(elements));
  }
}

TEST(CanonicalOrderOfBoxes, HasTheSameSideOfParallelFacesFirst)
{
  const ElementMesh mesh = boxes(Domain::Hexahedron);
  const std::vector<int> order = canonicalOrder(mesh);
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    place[order[i]] = static_cast<int>(i);
  }
  for (std::size_t e = 0; e < order.size(); ++e)
  {
    for (int face = 0; face < 6; ++face)
    {
      const int behind = mesh.neighbor(static_cast<int>(e), face).element;
      if (behind >= 0)
      {
        // Boxes are numbered along x, then y, then z: the one with the larger coordinate has the larger number.
        EXPECT_EQ(place[e] < place[behind], static_cast<int>(e) < behind);
      }
    }
  }
}

TEST(CanonicalOrderOfBoxes, OfNothingIsNothing)
{
  EXPECT_TRUE(canonicalOrder({}).empty());
}

} // namespace
} // namespace hop::testing
