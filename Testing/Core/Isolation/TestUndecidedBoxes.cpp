#include "Isolation/UndecidedBoxes.h"

#include "ElementCases.h"
#include "Isolation/SurfaceBoxes.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

struct Reported
{
  std::vector<SurfaceBox> boxes;
  DistributionReport report;
};

/// \param field over the cube of 2 x 2 x 2 cells; its elements are cells 100, 101 and so on of the input
Reported reportOf(Domain domain, const Field& field)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.field = field;
  ElementMesh mesh = makeMesh(recipe);
  std::int64_t cell = 100;
  for (Element& element : mesh.elements)
  {
    element.cell = cell++;
  }
  Reported result;
  result.boxes = findSurfaceBoxes(mesh, 0.0, 10.0, {});
  reportUndecided({ &mesh, 0.0, 1e-9 }, result.boxes, result.report);
  return result;
}

class Undecided : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(UndecidedBoxes, Undecided, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(Undecided, APlaneLeavesNothing)
{
  const auto [boxes, report] =
    reportOf(this->GetParam(), [](const glm::dvec3& x) { return x.x + 0.4 * x.y - 0.2; });
  ASSERT_FALSE(boxes.empty());
  EXPECT_EQ(report.boxes, static_cast<std::int64_t>(boxes.size()));
  EXPECT_EQ(report.boxesUndecided, 0);
  EXPECT_TRUE(report.undecidedCells.empty());
  EXPECT_EQ(report.singularPoints, 0);
}

TEST_P(Undecided, AConeIsOneSingularPointInOneCell)
{
  const glm::dvec3 tip(0.313, -0.427, 0.271);
  const auto [boxes, report] = reportOf(this->GetParam(),
    [&](const glm::dvec3& x)
    {
      const glm::dvec3 d = x - tip;
      return d.x * d.x + d.y * d.y - d.z * d.z;
    });
  std::int64_t undecided = 0;
  for (const SurfaceBox& box : boxes)
  {
    undecided += !box.certified;
  }
  EXPECT_GT(undecided, 0);
  EXPECT_EQ(report.boxes, static_cast<std::int64_t>(boxes.size()));
  EXPECT_EQ(report.boxesUndecided, undecided);
  EXPECT_EQ(report.undecidedCells.size(), 1u);
  EXPECT_EQ(report.singularPoints, 1);
}

TEST_P(Undecided, CellsAreNamedOnceEachAscending)
{
  // A double plane: all of its boxes stay undecided, in half of the cells.
  const auto [boxes, report] =
    reportOf(this->GetParam(), [](const glm::dvec3& x) { return (x.x - 0.413) * (x.x - 0.413); });
  std::vector<std::int64_t> expected;
  for (const SurfaceBox& box : boxes)
  {
    EXPECT_FALSE(box.certified);
    const std::int64_t cell = 100 + box.middle.element;
    if (expected.empty() || expected.back() != cell)
    {
      expected.push_back(cell);
    }
  }
  EXPECT_GE(expected.size(), 4u);
  EXPECT_EQ(report.undecidedCells, expected);
  EXPECT_EQ(report.boxesUndecided, static_cast<std::int64_t>(boxes.size()));
}

} // namespace
} // namespace hop::testing
