#include "Elements/GatheredMesh.h"

#include "Elements/CornerNumbers.h"
#include "RanksInMemory.h"
#include "ScatteredMesh.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <tuple>

namespace hop::testing
{
namespace
{

ElementMesh wavyBoxes()
{
  MeshRecipe recipe;
  recipe.cells = 3;
  recipe.map = wavyMap(0.1);
  recipe.field = [](const glm::dvec3& x) { return x.x * x.y - x.z; };
  return makeMesh(recipe);
}

TEST(GatheredMesh, IsTheSameHoweverElementsLayOnRanks)
{
  const ElementMesh whole = wavyBoxes();
  GatheredMesh expected = gatheredAlone(whole);
  for (const auto& [ranks, worker, seed] :
    { std::tuple{ 2, 0, 1 }, std::tuple{ 3, 2, 2 }, std::tuple{ 8, 5, 3 }, std::tuple{ 40, 1, 4 } })
  {
    const std::vector<ElementMesh> parts = scattered(whole, ranks, seed);
    runRanks(ranks,
      [&, worker = worker](Exchange& exchange)
      {
        ElementMesh mine = parts[exchange.rank()];
        const GatheredMesh all = gatheredAt(exchange, worker, mine);
        if (exchange.rank() != worker)
        {
          EXPECT_TRUE(all.mesh.elements.empty());
          return;
        }
        ASSERT_EQ(all.mesh.elements.size(), expected.mesh.elements.size());
        for (int e = 0; e < static_cast<int>(all.mesh.elements.size()); ++e)
        {
          ASSERT_EQ(all.mesh.elements[e].corners, expected.mesh.elements[e].corners);
          ASSERT_EQ(all.mesh.form(e).coefficients[5], expected.mesh.form(e).coefficients[5]);
          const ElementHome& home = all.homes[e];
          ASSERT_EQ(parts[home.rank].form(home.element).coefficients[5],
            expected.mesh.form(e).coefficients[5]);
        }
      });
  }
}

TEST(GatheredMesh, NumbersTheCellsOfAllRanksThrough)
{
  const std::vector<ElementMesh> parts = scattered(wavyBoxes(), 3, 7);
  runRanks(3,
    [&](Exchange& exchange)
    {
      ElementMesh mine = parts[exchange.rank()];
      const GatheredMesh all = gatheredAt(exchange, 0, mine);
      for (std::size_t e = 0; e < all.homes.size(); ++e)
      {
        const ElementHome& home = all.homes[e];
        EXPECT_EQ(all.mesh.elements[e].cell,
          home.rank * CellsOfRank + parts[home.rank].elements[home.element].cell);
      }
    });
}

/// Gives every third element a field of its own: lambda 2 of a vector that depends on the element.
void addExactFields(ElementMesh& mesh)
{
  const std::vector<double> weights;
  for (std::size_t e = 0; e < mesh.elements.size(); e += 3)
  {
    Element& element = mesh.elements[e];
    const BernsteinForm form = mesh.form(static_cast<int>(e));
    std::vector<double> control;
    for (int i = 0; i < static_cast<int>(coefficientCount(form.domain, form.degrees)); ++i)
    {
      const Coefficient c = form.coefficients[i];
      control.insert(
        control.end(), { c.x, c.y, c.z, -c.y * double(e), c.x + c.z * c.y, c.z * c.x - c.w });
    }
    const ExactSource exact =
      exactSource({ form.domain, form.degrees, 6, control, weights }, Quantity::Lambda2);
    element.exactField = static_cast<int>(mesh.exactFields.size());
    mesh.exactFields.push_back(exact.field);
    mesh.exactFields.back().firstCoefficient = mesh.exactCoefficients.size();
    mesh.exactCoefficients.insert(
      mesh.exactCoefficients.end(), exact.coefficients.begin(), exact.coefficients.end());
  }
}

TEST(GatheredMesh, KeepsExactFieldsWithTheirElements)
{
  ElementMesh whole = wavyBoxes();
  addExactFields(whole);
  std::vector<std::vector<int>> chosen(3);
  for (int e = 0; e < static_cast<int>(whole.elements.size()); ++e)
  {
    chosen[e % 2 + e % 5 / 4].push_back(e);
  }
  runRanks(3,
    [&](Exchange& exchange)
    {
      ElementMesh mine = pickElements(whole, chosen[exchange.rank()]);
      const GatheredMesh all = gatheredAt(exchange, 1, mine);
      int differing = 0;
      for (int e = 0; e < static_cast<int>(all.homes.size()); ++e)
      {
        const ElementHome& home = all.homes[e];
        const Location there{ chosen[home.rank][home.element], { { 0.3, 0.2, 0.4 } } };
        const Jet jet = exactHessian(all.mesh, { e, there.u });
        ASSERT_EQ(jet.value, exactHessian(whole, there).value);
        ASSERT_EQ(jet.second, exactHessian(whole, there).second);
        differing += jet.value != evaluateHessian(all.mesh.form(e), there.u).value;
      }
      EXPECT_EQ(differing, exchange.rank() == 1 ? 9 : 0);
    });
}

TEST(GatheredMesh, HoldsRationalElementsBesidePolynomialOnes)
{
  const ElementMesh whole = wavyBoxes();
  std::vector<ElementMesh> parts = scattered(whole, 2, 5);
  parts[1].weights.assign(parts[1].coefficients.size(), 2.0);
  for (Element& element : parts[1].elements)
  {
    element.rational = true;
  }
  runRanks(2,
    [&](Exchange& exchange)
    {
      ElementMesh mine = parts[exchange.rank()];
      const GatheredMesh all = gatheredAt(exchange, 0, mine);
      for (std::size_t e = 0; e < all.homes.size(); ++e)
      {
        const double* weights = all.mesh.form(static_cast<int>(e)).weights;
        ASSERT_EQ(weights != nullptr, all.homes[e].rank == 1);
        EXPECT_TRUE(!weights || weights[26] == 2.0);
      }
    });
}

TEST(GatheredMesh, RefusesMoreElementsThanHaveNumbers)
{
  EXPECT_THROW(roomFor({ { 2'000'000'000 }, { 2'000'000'000 } }), std::length_error);
}

} // namespace
} // namespace hop::testing
