#include "Isolation/SurfaceProxy.h"

#include "AnalyticFields.h"
#include "Edges/SampleComparison.h"
#include "ElementCases.h"
#include "SurfaceSeeds.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

constexpr double spacing = 0.08;

ElementMesh curvedMesh(Domain domain)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { 3, 3, 3 };
  recipe.cells = 4;
  recipe.map = wavyMap(0.1);
  recipe.field = sphere({ 0, 0, 0 }, 0.7).field;
  return makeMesh(recipe);
}

SurfaceProxy proxyOf(const ElementMesh& mesh, double boxesPerSpacing = 5.0)
{
  return { { &mesh, 0.0, 1e-9 }, { spacing, 0.0 },
    findSurfaceBoxes(mesh, 0.0, boxesPerSpacing * spacing, {}), {} };
}

class Proxy : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(SurfaceProxy, Proxy, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(Proxy, GuessesTheSurfaceAtSeeds)
{
  const ElementMesh mesh = curvedMesh(this->GetParam());
  const SurfaceProxy proxy = proxyOf(mesh);
  const auto seeds = proxy.seeds(std::llround(proxy.particleCount()), 0.5, {});
  ASSERT_GT(seeds.size(), 500u);
  std::size_t guessed = 0;
  for (const SurfaceProxy::Seed& seed : seeds)
  {
    Anchor anchor;
    Patch guess;
    if (!proxy.guess(seed, anchor, guess))
    {
      continue;
    }
    ++guessed;
    Anchor there;
    Patch found;
    ASSERT_TRUE(anchorPatch(
      seed.place, evaluateHessian(mesh.form(seed.place.element), seed.place.u), 0.0, there, found));
    EXPECT_LE(glm::distance(guess.position, found.position), 0.15 * spacing);
    EXPECT_GE(glm::dot(guess.normal, found.normal), 0.98f);
    EXPECT_EQ(guess.spacing, static_cast<float>(spacing));
  }
  // Most seeds are near enough to the sample of their box.
  EXPECT_GE(static_cast<double>(guessed), 0.5 * static_cast<double>(seeds.size()));
}

TEST_P(Proxy, LocatesPlacesNearSamplesOnly)
{
  const ElementMesh mesh = curvedMesh(this->GetParam());
  const SurfaceProxy proxy = proxyOf(mesh, 2.0);
  int located = 0;
  for (const SurfaceProxy::Sample& sample : proxy.samples())
  {
    ASSERT_TRUE(sample.found);
    const auto tangents = tangentsOf(sample.patch.normal);
    const int element = sample.anchor.place.element;
    const glm::dvec3 near = sample.patch.position + 0.5 * spacing * glm::dvec3(tangents[0]);
    if (const auto place = proxy.locate(near, element))
    {
      ++located;
      EXPECT_EQ(place->element, element);
      EXPECT_LE(glm::distance(positionAt(mesh, *place), near), 0.06 * spacing);
    }
    EXPECT_FALSE(proxy.locate(glm::dvec3(2.0), element));
  }
  EXPECT_GE(located, static_cast<int>(proxy.samples().size()) / 2);
}

TEST(SurfaceProxy, KnowsTheSpacingForANumber)
{
  // The number goes with 1/s^2 on a sphere, or less where curvature decides: D s/(2 pi) is a fifth here.
  for (const double density : { 0.0, 10.0 })
  {
    const ElementMesh mesh = curvedMesh(Domain::Hexahedron);
    const auto at = [&](double s)
    {
      return SurfaceProxy(
        { &mesh, 0.0, 1e-9 }, { s, density }, findSurfaceBoxes(mesh, 0.0, 5.0 * spacing, {}), {});
    };
    const SurfaceProxy proxy = at(spacing);
    const double wanted = 0.3 * proxy.particleCount();
    const double found = proxy.spacingFor(wanted);
    EXPECT_NEAR(at(found).particleCount() / wanted, 1.0, 0.02) << "density " << density;
    EXPECT_GT(found, 1.5 * spacing);
  }
}

TEST(SurfaceProxy, ScaledSpacingsGiveOtherNumbers)
{
  const ElementMesh mesh = curvedMesh(Domain::Wedge);
  SurfaceProxy proxy(
    { &mesh, 0.0, 1e-9 }, { spacing, 10.0 }, findSurfaceBoxes(mesh, 0.0, 5.0 * spacing, {}), {});
  const double count = proxy.particleCount();
  const Patch before = proxy.samples()[0].patch;
  const float spacingBefore = proxy.spacingAt(before.position, before.curvatureMagnitude());
  proxy.scaleSpacings(1.1);
  EXPECT_NEAR(proxy.particleCount(), count / 1.21, 1e-9 * count);
  EXPECT_FLOAT_EQ(proxy.samples()[0].patch.spacing, 1.1f * before.spacing);
  EXPECT_NEAR(proxy.spacingAt(before.position, before.curvatureMagnitude()), 1.1f * spacingBefore,
    1e-5f * spacingBefore);
}

TEST(SurfaceProxy, FeelsASmallSpacingHoweverLargeTheSpacingsAroundIt)
{
  MeshRecipe recipe;
  recipe.cells = 4;
  recipe.field = [](const glm::dvec3& x) { return x.z + 0.1; };
  const ElementMesh mesh = makeMesh(recipe);
  SurfaceProxy proxy(
    { &mesh, 0.0, 1e-9 }, { spacing, 10.0 }, findSurfaceBoxes(mesh, 0.0, 6.0 * spacing, {}), {});
  const double before = proxy.particleCount();
  const glm::dvec3 first(0.13, 0.07, -0.1);
  const glm::dvec3 second(-0.4, 0.3, -0.1);
  constexpr float small = 0.1f * spacing;
  proxy.limitSpacings({ { first, small } }, {});
  proxy.limitSpacings({ { second, 2.0f * small } }, {});
  EXPECT_GT(proxy.particleCount(), before);
  for (double distance = 0.0; distance < 4.0 * small; distance += 0.1 * small)
  {
    const glm::dvec3 aside(distance, 0.0, 0.0);
    const double growth = SizingField::GradationSlope * distance;
    EXPECT_NEAR(proxy.spacingAt(first + aside, 0.0f), small + growth, 1e-6);
    EXPECT_NEAR(proxy.spacingAt(second + aside, 0.0f), 2.0 * small + growth, 1e-6);
  }
}

/// Of other boxes of the same surface, those of elements that have the same ones as before.
TEST(SurfaceProxy, KeepsSamplesOfElementsWhoseBoxesStay)
{
  const ElementMesh mesh = curvedMesh(Domain::Hexahedron);
  const Isosurface surface{ &mesh, 0.0, 1e-9 };
  const auto boxesAt = [&](double largest, const KnownBoxes& known = {})
  {
    return findSurfaceBoxes(
      mesh, 0.0, [&](const SurfaceBox& box) { return box.size <= largest; }, {}, {}, known);
  };
  const std::vector<SurfaceBox> coarse = boxesAt(5.0 * spacing);
  const auto isOnTheLeft = [&](const SurfaceBox& box)
  { return box.middle.element < static_cast<int>(mesh.elements.size()) / 2; };
  const std::vector<SurfaceBox> mixed = boxesAt(2.0 * spacing, { &coarse, isOnTheLeft });
  const auto left = std::count_if(coarse.begin(), coarse.end(), isOnTheLeft);
  ASSERT_EQ(std::count_if(mixed.begin(), mixed.end(), isOnTheLeft), left);
  ASSERT_GT(mixed.size(), 2 * coarse.size());

  const SizingFunction sizing{ spacing, 10.0 };
  const SurfaceProxy before(surface, sizing, coarse, {});
  const std::vector<SizingField::Limit> limits{ { { 0.0, 0.0, 0.7 }, 0.3f * spacing } };
  const SurfaceProxy kept(before, mixed, limits, {});
  SurfaceProxy anew(surface, sizing, mixed, {});
  anew.limitSpacings(limits, {});
  EXPECT_EQ(kept.particleCount(), anew.particleCount());
  EXPECT_EQ(kept.smallestSpacing(), anew.smallestSpacing());
  EXPECT_LE(kept.evaluations(), anew.evaluations() - left);
  ASSERT_EQ(kept.samples().size(), anew.samples().size());
  for (std::size_t b = 0; b < kept.samples().size(); ++b)
  {
    EXPECT_EQ(kept.samples()[b].patch.position, anew.samples()[b].patch.position);
    EXPECT_EQ(kept.samples()[b].patch.spacing, anew.samples()[b].patch.spacing);
  }
}

/// A bump on a plane, in elements far smaller than the spacing on the plane, which is to be 0.5.
ElementMesh fineMesh()
{
  MeshRecipe recipe;
  recipe.degrees = { 1, 1, 1 };
  recipe.cells = 40;
  recipe.field = [](const glm::dvec3& x)
  { return x.z - 0.31 * std::exp(-8.0 * (x.x * x.x + x.y * x.y)); };
  return makeMesh(recipe);
}

TEST(SurfaceProxy, OfSamplesCloserThanTheirSpacingsFewLimitSpacings)
{
  const ElementMesh mesh = fineMesh();
  const SurfaceProxy proxy(
    { &mesh, 0.0, 1e-9 }, { 0.5, 15.0 }, findSurfaceBoxes(mesh, 0.0, 3.0, {}), {});
  const auto& samples = proxy.samples();
  ASSERT_GT(samples.size(), 1600u);
  EXPECT_LT(proxy.spacingPlaces(), samples.size() / 3);
  for (const SurfaceProxy::Sample& one : samples)
  {
    double limit = proxy.sizing().at(one.patch.curvatureMagnitude());
    for (const SurfaceProxy::Sample& other : samples)
    {
      limit = std::min(limit,
        other.patch.spacing +
          SizingField::GradationSlope * glm::distance(one.patch.position, other.patch.position));
    }
    ASSERT_LE(one.patch.spacing, 1.1 * limit);
    ASSERT_GE(one.patch.spacing, 0.999 * limit);
  }
}

TEST(SurfaceProxy, SamplesThatMayBeNoSurfaceDoNotLimitSpacings)
{
  const ElementMesh mesh = curvedMesh(Domain::Hexahedron);
  std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, 0.0, 5.0 * spacing, {});
  const auto places = [&]() {
    return SurfaceProxy({ &mesh, 0.0, 1e-9 }, { spacing, 10.0 }, boxes, {}).spacingPlaces();
  };
  const std::size_t all = places();
  boxes[3].certified = false;
  boxes[3].straddles = true;
  EXPECT_EQ(places(), all);
  boxes[3].straddles = false;
  EXPECT_EQ(places(), all - 1);
}

/// Loops of no length ask the caller for an early end, and any loop may bring it.
TEST(SurfaceProxy, EndsWithWhicheverLoopTheCallerEnds)
{
  struct Ended
  {
  };
  const ElementMesh mesh = fineMesh();
  const auto boxes = findSurfaceBoxes(mesh, 0.0, 3.0, {});
  int loops = 0, questions = 0, last = 0;
  const ParallelFor counting = [&](std::ptrdiff_t count, const LoopBody& body)
  {
    questions += count == 0;
    if (++loops == last)
    {
      throw Ended();
    }
    runInThreads({}, count, body);
  };
  const auto build = [&] { SurfaceProxy({ &mesh, 0.0, 1e-9 }, { 0.02, 15.0 }, boxes, counting); };

  build();
  EXPECT_GT(questions, 0);
  const int all = loops;
  for (last = 1; last <= all; ++last)
  {
    loops = 0;
    EXPECT_THROW(build(), Ended) << "loop " << last;
    EXPECT_EQ(loops, last);
  }
}

TEST(SampleComparison, KnowsSmallJumpsFromLargeOnes)
{
  // z = 0 for x < 0; behind x = 0 the surface is that much higher.
  for (const double jump : { 0.0, 0.02, 0.5 })
  {
    ElementMesh mesh;
    MeshRecipe recipe;
    recipe.cells = 2;
    recipe.field = [](const glm::dvec3& x) { return x.z + 0.01; };
    appendBox(mesh, recipe, { -1, -1, -1 }, { 0, 1, 1 });
    recipe.field = [jump](const glm::dvec3& x) { return x.z + 0.01 - jump * spacing; };
    appendBox(mesh, recipe, { 0, -1, -1 }, { 1, 1, 1 });
    findFaceNeighbors(mesh, 1e-9);
    const SurfaceProxy proxy = proxyOf(mesh, 4.0);
    const SampleComparison comparison(mesh, proxy);
    int meeting = 0;
    int compared = 0;
    for (std::size_t b = 0; b < proxy.boxes().size(); ++b)
    {
      const SurfaceBox& box = proxy.boxes()[b];
      visitFaceCrossings(
        mesh, box, [&](int face) { return mesh.neighbor(box.middle.element, face).element >= 0; },
        [&](const FaceCrossing& crossing)
        {
          if (std::abs(positionAt(mesh, crossing.location).x) < 1e-9)
          {
            ++compared;
            meeting += comparison.meet(crossing, proxy.samples()[b], 0.1);
          }
        });
    }
    ASSERT_GT(compared, 10);
    EXPECT_EQ(meeting, jump < 0.1 ? compared : 0) << jump;
  }
}

} // namespace
} // namespace hop::testing
