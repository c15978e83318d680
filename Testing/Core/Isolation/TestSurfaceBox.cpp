#include "Isolation/SurfaceBox.h"

#include "PieceCases.h"

#include <cmath>
#include <utility>

namespace hop::testing
{
namespace
{

class BoxEnds : public PiecesOf
{
};

INSTANTIATE_TEST_SUITE_P(SurfaceBox, BoxEnds, allPieceCases(), nameOfCase);

TEST_P(BoxEnds, LeadToThePlaneOfALinearFieldInOneStep)
{
  const WholeElement element(
    this->domain(), this->degree(), [](const glm::dvec3& u) { return 2.0 + u.x + u.z; });
  SurfaceBox box;
  box.middle = { 0, middleOf(facts(this->domain())) };
  box.ends = { { { glm::dvec3(0.1) }, { glm::dvec3(0.1, 0.1, 0.8) } } };
  std::int64_t evaluations = 7;
  const Location found = findBetweenEnds(element.mesh, 2.6, box, evaluations);
  EXPECT_EQ(found.element, 0);
  EXPECT_LE(glm::distance(found.u.xyz, glm::dvec3(0.1, 0.1, 0.5)), 1e-12);
  EXPECT_EQ(evaluations, 7 + 3) << "both ends and one place between them";
}

TEST_P(BoxEnds, LeadToAThousandthOfTheirDifference)
{
  Random random(1);
  for (int seed = 1; seed <= 20; ++seed)
  {
    const WholeElement element = this->randomElement(seed);
    const auto valueAt = [&](const ReferencePoint& u)
    { return evaluateGradient(element.mesh.form(0), u).value.w; };
    SurfaceBox box;
    box.middle.element = 0;
    box.ends = { { randomPoint(this->domain(), random), randomPoint(this->domain(), random) } };
    if (valueAt(box.ends[0]) > valueAt(box.ends[1]))
    {
      std::swap(box.ends[0], box.ends[1]);
    }
    const double lower = valueAt(box.ends[0]);
    const double upper = valueAt(box.ends[1]);
    const double isovalue = lower + (0.01 + 0.98 * random.uniform()) * (upper - lower);
    std::int64_t evaluations = 0;
    const ReferencePoint u = findBetweenEnds(element.mesh, isovalue, box, evaluations).u;
    EXPECT_LE(std::abs(valueAt(u) - isovalue), 1e-3 * (upper - lower));
    EXPECT_LE(evaluations, 15);
    const double t =
      glm::distance(u.xyz, box.ends[0].xyz) / glm::distance(box.ends[1].xyz, box.ends[0].xyz);
    EXPECT_LE(t, 1.0);
    EXPECT_LE(glm::distance(u.xyz, glm::mix(box.ends[0].xyz, box.ends[1].xyz, t)), 1e-12);
  }
}

TEST(SurfaceBox, HoldsPlacesOfItsElementUpToItsRadius)
{
  SurfaceBox box;
  box.middle = { 3, { glm::dvec3(0.5) } };
  box.referenceRadius = 0.2;
  EXPECT_TRUE(isAtBox(box, { 3, { glm::dvec3(0.5) } }));
  EXPECT_TRUE(isAtBox(box, { 3, { glm::dvec3(0.5, 0.31, 0.5) } }));
  EXPECT_FALSE(isAtBox(box, { 3, { glm::dvec3(0.5, 0.29, 0.5) } }));
  EXPECT_FALSE(isAtBox(box, { 3, { glm::dvec3(0.65) } })) << "farther along the diagonal";
  EXPECT_FALSE(isAtBox(box, { 2, { glm::dvec3(0.5) } }));
}

} // namespace
} // namespace hop::testing
