#include "AvailableParts.h"

#include "Support/Random.h"

#include <glm/glm.hpp>

#include <cmath>
#include <vector>

namespace hop::testing
{
namespace
{

/// Places around the origin, and behind them some far away, as many as make whole vectors.
struct Neighborhood
{
  std::vector<double> x, y;
  std::size_t used = 0;

  void add(const glm::dvec2& place)
  {
    this->x.resize(this->used);
    this->y.resize(this->used++);
    this->x.push_back(place.x);
    this->y.push_back(place.y);
    while (this->x.size() % kernel::MaximumLanes != 0)
    {
      this->x.push_back(40.0);
      this->y.push_back(0.0);
    }
  }

  kernel::PlaneCell measure(const kernel::CellBend& bend) const
  {
    return kernel::current().planeCell(
      { this->x.data(), this->y.data(), static_cast<std::ptrdiff_t>(this->used),
        static_cast<std::ptrdiff_t>(this->x.size()) },
      bend);
  }

  /// The corners of the cell, cut out of a square by one line after the other.
  std::vector<glm::dvec2> corners() const
  {
    std::vector<glm::dvec2> polygon{ { -9, -9 }, { 9, -9 }, { 9, 9 }, { -9, 9 } };
    for (std::size_t n = 0; n < this->used; ++n)
    {
      const glm::dvec2 p(this->x[n], this->y[n]);
      const auto height = [&](const glm::dvec2& t) { return glm::dot(p, t - 0.5 * p); };
      std::vector<glm::dvec2> rest;
      for (std::size_t c = 0; c < polygon.size(); ++c)
      {
        const glm::dvec2 a = polygon[c], b = polygon[(c + 1) % polygon.size()];
        if (height(a) <= 0.0)
        {
          rest.push_back(a);
        }
        if (height(a) * height(b) < 0.0)
        {
          rest.push_back(a + height(a) / (height(a) - height(b)) * (b - a));
        }
      }
      polygon = rest;
    }
    return polygon;
  }
};

constexpr kernel::CellBend flat{ 0.0, 0.0, 0.0, 0.0 };

class PlaneCell : public ::testing::TestWithParam<InstructionSet>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(availableInstructionSets().back()); }
};

TEST_P(PlaneCell, IsTheHexagonOfHexagonalPacking)
{
  Neighborhood near;
  for (int n = 0; n < 6; ++n)
  {
    const double angle = 0.3 + n * std::acos(0.5);
    near.add({ std::cos(angle), std::sin(angle) });
    near.add({ 2.0 * std::cos(angle), 2.0 * std::sin(angle) }); // behind the first, in line with it
  }
  const kernel::PlaneCell cell = near.measure(flat);
  EXPECT_NEAR(cell.area, 0.5 * std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(cell.reachSquared, 1.0 / 3.0, 1e-14);
}

TEST_P(PlaneCell, IsWhatLinesCutOutOfThePlane)
{
  Random random(7);
  for (int round = 0; round < 200; ++round)
  {
    Neighborhood near;
    for (int n = 0; n < 5 + round % 17; ++n)
    {
      // All around, so that the cell is closed.
      const double angle = n < 5 ? 1.25 * (n + 0.3 * random.uniform()) : 6.28 * random.uniform();
      const double radius = 0.5 + 1.5 * random.uniform();
      near.add({ radius * std::cos(angle), radius * std::sin(angle) });
    }
    const std::vector<glm::dvec2> corners = near.corners();
    double area = 0.0, moment = 0.0, reach = 0.0;
    for (std::size_t c = 0; c < corners.size(); ++c)
    {
      const glm::dvec2 a = corners[c], b = corners[(c + 1) % corners.size()];
      const double part = 0.5 * (a.x * b.y - a.y * b.x);
      area += part;
      moment += part * (glm::dot(a, a) + glm::dot(a, b) + glm::dot(b, b)) / 6.0;
      reach = std::max(reach, glm::dot(a, a));
    }
    const kernel::PlaneCell cell = near.measure(flat);
    EXPECT_NEAR(cell.area, area, 1e-12 * area) << round;
    EXPECT_NEAR(cell.reachSquared, reach, 1e-12 * reach) << round;
    // form^2/|t|^2 = k^2 |t|^2: the second moment. On a sphere gauss takes it away again.
    constexpr double k = 0.4;
    EXPECT_NEAR(near.measure({ k, 0.0, k, 0.0 }).area, area + k * k * moment, 1e-12 * area)
      << round;
    EXPECT_NEAR(near.measure({ k, 0.0, k, k * k }).area, area, 1e-12 * area) << round;
  }
}

TEST_P(PlaneCell, OfPlacesOnOneSideReachesFar)
{
  Neighborhood near;
  for (const double angle : { 0.1, 0.9, 2.0, 3.0 })
  {
    near.add({ std::cos(angle), std::sin(angle) });
  }
  EXPECT_GT(near.measure(flat).reachSquared, 100.0);
}

INSTANTIATE_TEST_SUITE_P(
  All, PlaneCell, ::testing::ValuesIn(availableInstructionSets()), nameOfSet);

} // namespace
} // namespace hop::testing
