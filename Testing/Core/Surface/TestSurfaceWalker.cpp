#include "Surface/SurfaceWalker.h"

#include "AnalyticFields.h"
#include "ElementCases.h"

#include <gtest/gtest.h>

#include <limits>

namespace hop::testing
{
namespace
{

/// Bound on the evaluations of project(): each Newton step may take the most hops, and ends with one evaluation.
constexpr std::int64_t mostEvaluations =
  1 + SurfaceWalker::MaximumNewtonSteps * (SurfaceWalker::MaximumHops + 1);

Location randomLocation(const ElementMesh& mesh, Random& random)
{
  const int element = static_cast<int>(random.uniform() * mesh.elements.size());
  return { element, randomPoint(mesh.elements[element].domain, random) };
}

bool insideElement(const ElementMesh& mesh, const Location& location)
{
  return insideMargin(mesh.elements[location.element].domain, location.u) > -1e-12;
}

/// The point of the cube [-1,1]^3 nearest to x.
glm::dvec3 inCube(const glm::dvec3& x)
{
  return glm::clamp(x, -1.0, 1.0);
}

class WalkThrough : public ::testing::TestWithParam<Domain>
{
protected:
  MeshRecipe recipe(int degree, int cells, const Field& field = plane({ 1, 0, 0 }, 0.0).field) const
  {
    MeshRecipe recipe;
    recipe.domain = this->GetParam();
    recipe.degrees = { degree, degree, degree };
    recipe.cells = cells;
    recipe.field = field;
    return recipe;
  }

  MeshRecipe bent(int degree, int cells, const Field& field) const
  {
    MeshRecipe result = this->recipe(degree, cells, field);
    result.map = wavyMap(0.15);
    return result;
  }
};

INSTANTIATE_TEST_SUITE_P(SurfaceWalker, WalkThrough, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(WalkThrough, MovesToTheWorldTargetThroughAffineElementsExactly)
{
  const ElementMesh mesh = makeMesh(this->recipe(1, 3));
  SurfaceWalker walker({ &mesh, 0.0, 0.0 });
  Random random(1);
  int crossings = 0;
  for (int n = 0; n < 300; ++n)
  {
    const Evaluated start = walker.evaluate(randomLocation(mesh, random));
    const glm::dvec3 target = start.point.map.position.xyz + 0.35 * randomVector(random);
    if (target != inCube(target))
    {
      continue;
    }
    const Location end = walker.move(start, { target - start.point.map.position.xyz });
    EXPECT_TRUE(insideElement(mesh, end));
    EXPECT_LE(glm::distance(walker.evaluate(end).point.map.position.xyz, target), 1e-12);
    crossings += end.element != start.location.element;
  }
  EXPECT_GT(crossings, 50);
}

TEST_P(WalkThrough, MovesToTheWorldTargetThroughCurvedElementsToFirstOrder)
{
  const ElementMesh mesh = makeMesh(this->bent(4, 3, plane({ 1, 0, 0 }, 0.0).field));
  SurfaceWalker walker({ &mesh, 0.0, 0.0 });
  const auto meanError = [&](double stepLength)
  {
    Random random(2);
    double sum = 0.0;
    for (int n = 0; n < 200; ++n)
    {
      Location from = randomLocation(mesh, random);
      const Evaluated start = walker.evaluate(from);
      // Towards the middle, so that no boundary is in the way.
      const WorldVector step{ -stepLength * glm::normalize(start.point.map.position.xyz) };
      const Evaluated end = walker.evaluate(walker.move(start, step));
      sum += length(end.point.map.position - (start.point.map.position + step));
    }
    return sum / 200.0;
  };
  // Half the step leaves a quarter of the error.
  EXPECT_LT(meanError(0.2), 0.03 * 0.2);
  EXPECT_LT(meanError(0.1), 0.4 * meanError(0.2));
  EXPECT_LT(meanError(0.05), 0.4 * meanError(0.1));
}

TEST_P(WalkThrough, SlidesAlongTheBoundary)
{
  const ElementMesh mesh = makeMesh(this->recipe(1, 2));
  SurfaceWalker walker({ &mesh, 0.0, 0.0 });
  Random random(3);
  int endedShort = 0;
  int endsOnFaces[4] = {};
  for (int n = 0; n < 1000; ++n)
  {
    const Evaluated start = walker.evaluate(randomLocation(mesh, random));
    const glm::dvec3 target = start.point.map.position.xyz + 0.4 * randomVector(random);
    const Location end = walker.move(start, { target - start.point.map.position.xyz });
    EXPECT_TRUE(insideElement(mesh, end));
    const glm::dvec3 x = walker.evaluate(end).point.map.position.xyz;
    const int faces =
      (std::abs(x.x) > 1.0 - 1e-12) + (std::abs(x.y) > 1.0 - 1e-12) + (std::abs(x.z) > 1.0 - 1e-12);
    // A step against a face, an edge or a corner of the cube ends at the point nearest to the target.
    endedShort += glm::distance(x, inCube(target)) > 1e-12;
    ++endsOnFaces[faces];
  }
  EXPECT_GT(endsOnFaces[0], 300);
  EXPECT_GT(endsOnFaces[1], 100);
  EXPECT_GT(endsOnFaces[2], 10);
  // Where many simplices meet in an edge of the cube, some steps end short of that point.
  EXPECT_LE(endedShort, this->GetParam() == Domain::Hexahedron ? 0 : 20);
}

TEST_P(WalkThrough, EndsInTheCorner)
{
  const ElementMesh mesh = makeMesh(this->recipe(1, 1));
  SurfaceWalker walker({ &mesh, 0.0, 0.0 });
  Random random(4);
  for (int n = 0; n < 50; ++n)
  {
    const Location from{ 0, randomPoint(this->GetParam(), random) };
    const Evaluated start = walker.evaluate(from);
    const WorldVector step{ glm::dvec3(1.5, 1.7, 1.3) - start.point.map.position.xyz };
    const glm::dvec3 end = walker.evaluate(walker.move(start, step)).point.map.position.xyz;
    EXPECT_LE(glm::distance(end, glm::dvec3(1, 1, 1)), 1e-12);
  }
}

TEST(SurfaceWalker, EndsAtAFaceAfterTheMostHops)
{
  MeshRecipe recipe;
  recipe.degrees = { 1, 1, 1 };
  recipe.cells = 20;
  const ElementMesh mesh = makeMesh(recipe);
  SurfaceWalker walker({ &mesh, 0.0, 0.0 });
  const Evaluated start = walker.evaluate({ 0, { { 0.5, 0.5, 0.5 } } });
  const Location end = walker.move(start, { { 1.5, 0, 0 } });
  EXPECT_TRUE(insideElement(mesh, end));
  EXPECT_NEAR(walker.evaluate(end).point.map.position.xyz.x, -1.0 + 8 * 0.1, 1e-12);
  EXPECT_LE(walker.evaluations(), 2 + SurfaceWalker::MaximumHops);
}

TEST(SurfaceWalker, CountsEveryEvaluation)
{
  MeshRecipe recipe;
  const ElementMesh mesh = makeMesh(recipe);
  SurfaceWalker walker({ &mesh, 0.0, 0.0 });
  EXPECT_EQ(walker.evaluations(), 0);
  walker.evaluate({ 0, { { 0.5, 0.5, 0.5 } } });
  walker.evaluateCurved({ 0, { { 0.5, 0.5, 0.5 } } });
  EXPECT_EQ(walker.evaluations(), 2);
}

/// Derivatives are at hand at the place of the last evaluation with a Hessian, nowhere else.
TEST(SurfaceWalker, KeepsTheLastDerivatives)
{
  const ElementMesh mesh = makeMesh(MeshRecipe{});
  SurfaceWalker walker({ &mesh, 0.0, 0.0 });
  const Location here{ 0, { { 0.5, 0.25, 0.5 } } };
  const Evaluated at = walker.evaluateCurved(here);
  EXPECT_EQ(fieldPoint(walker.jetAt(here), 0.0).gradient.xyz, at.point.gradient.xyz);
  EXPECT_EQ(walker.evaluations(), 1);
  const Location elsewhere{ 0, { { 0.5, 0.25, 0.75 } } };
  EXPECT_EQ(fieldPoint(walker.jetAt(elsewhere), 0.0).map.position.xyz,
    walker.evaluate(elsewhere).point.map.position.xyz);
  EXPECT_EQ(walker.evaluations(), 3);
  // An evaluation is counted even where its result is at hand.
  walker.evaluateCurved(elsewhere);
  EXPECT_EQ(walker.evaluations(), 4);
}

TEST_P(WalkThrough, ProjectsOntoTheSurfaceAcrossFaces)
{
  const ElementMesh mesh = makeMesh(this->bent(4, 3, sphere({ 0, 0, 0 }, 0.55).field));
  SurfaceWalker walker({ &mesh, 0.0, 1e-11 });
  Random random(5);
  int tried = 0, crossings = 0;
  for (int n = 0; n < 500; ++n)
  {
    const Location start = randomLocation(mesh, random);
    const glm::dvec3 from = walker.evaluate(start).point.map.position.xyz;
    if (std::abs(glm::length(from) - 0.55) > 0.3)
    {
      continue;
    }
    Evaluated on;
    ASSERT_TRUE(walker.project(start, 1.0, on)) << from.x << ' ' << from.y << ' ' << from.z;
    EXPECT_LE(std::abs(on.point.value), 1e-11 * length(on.point.gradient));
    EXPECT_TRUE(insideElement(mesh, on.location));
    // Newton's method follows the gradient: the point found is not far from the nearest one.
    const double distance = std::abs(glm::length(from) - 0.55);
    EXPECT_LE(glm::distance(on.point.map.position.xyz, from), 1.5 * distance + 1e-3);
    // The sphere itself lies within the interpolation error of the mesh.
    EXPECT_NEAR(glm::length(on.point.map.position.xyz), 0.55, 2e-3);
    ++tried;
    crossings += on.location.element != start.element;
  }
  EXPECT_GT(tried, 100);
  EXPECT_GT(crossings, 20);
}

TEST_P(WalkThrough, ProjectsOntoAnyIsovalue)
{
  const ElementMesh mesh = makeMesh(this->recipe(2, 2, sphere({ 0, 0, 0 }, 0.0).field));
  SurfaceWalker walker({ &mesh, -0.49, 1e-11 });
  Evaluated on;
  ASSERT_TRUE(walker.project({ 0, { { 0.3, 0.3, 0.3 } } }, 2.0, on));
  EXPECT_NEAR(glm::length(on.point.map.position.xyz), 0.7, 1e-10);
}

TEST_P(WalkThrough, ProjectionConvergesQuadratically)
{
  MeshRecipe recipe = this->bent(4, 1, sphere({ 0, 0, 0 }, 0.5).field);
  const ElementMesh mesh = makeMesh(recipe);
  Random random(6);
  double steps[3] = {};
  constexpr double tolerances[] = { 1e-3, 1e-6, 1e-12 };
  for (int n = 0; n < 60; ++n)
  {
    const Location start = randomLocation(mesh, random);
    const double r =
      glm::length(SurfaceWalker({ &mesh, 0.0, 0.0 }).evaluate(start).point.map.position.xyz);
    for (int i = 0; r > 0.3 && r < 0.7 && i < 3; ++i)
    {
      SurfaceWalker walker({ &mesh, 0.0, tolerances[i] });
      Evaluated on;
      ASSERT_TRUE(walker.project(start, 1.0, on));
      steps[i] += static_cast<double>(walker.evaluations());
    }
  }
  // The number of digits doubles with each step: 3 to 6 to 12 takes about one each.
  EXPECT_GT(steps[0], 0.0);
  EXPECT_LT(steps[2] / steps[1], 1.4);
  EXPECT_LT(steps[1] / steps[0], 1.7);
}

TEST_P(WalkThrough, ProjectsAlongTheBoundary)
{
  // The sphere leaves the cube through all six sides.
  const ElementMesh mesh = makeMesh(this->bent(4, 2, sphere({ 0, 0, 0 }, 1.2).field));
  SurfaceWalker walker({ &mesh, 0.0, 1e-11 });
  Random random(7);
  int onBoundary = 0;
  for (int n = 0; n < 300; ++n)
  {
    Location start = randomLocation(mesh, random);
    const auto& faces = facts(this->GetParam()).faces;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
      const Face& face = faces[f];
      // Start from a boundary face, well inside the sphere: the nearest point of the sphere lies beyond the face.
      const double distance = glm::dot(face.inward.xyz, start.u.xyz) + face.offset;
      const Location onFace{ start.element,
        { start.u.xyz - distance / glm::dot(face.inward.xyz, face.inward.xyz) * face.inward.xyz } };
      if (mesh.neighbor(start.element, f).element >= 0 || !insideElement(mesh, onFace))
      {
        continue;
      }
      Evaluated on;
      if (walker.project(onFace, 0.6, on))
      {
        EXPECT_LE(std::abs(on.point.value), 1e-11 * length(on.point.gradient));
        EXPECT_TRUE(insideElement(mesh, on.location));
        onBoundary += boundaryFaceCount(mesh, on.location) > 0;
      }
    }
  }
  EXPECT_GT(onBoundary, 50);
}

TEST_P(WalkThrough, LeftHandedElementsAreAsGood)
{
  MeshRecipe recipe = this->recipe(4, 2, sphere({ 0, 0, 0 }, 0.6).field);
  recipe.map = [map = wavyMap(0.1)](const glm::dvec3& x) { return map({ -x.x, x.y, x.z }); };
  const ElementMesh mesh = makeMesh(recipe);
  SurfaceWalker walker({ &mesh, 0.0, 1e-11 });
  Random random(8);
  int found = 0;
  for (int n = 0; n < 100; ++n)
  {
    Evaluated on;
    const Location start = randomLocation(mesh, random);
    const Evaluated before = walker.evaluate(start);
    if (std::abs(glm::length(before.point.map.position.xyz) - 0.6) < 0.3)
    {
      ASSERT_TRUE(walker.project(start, 1.0, on));
      EXPECT_NEAR(glm::length(on.point.map.position.xyz), 0.6, 2e-3);
      ++found;
    }
  }
  EXPECT_GT(found, 20);
}

TEST(SurfaceWalker, TravelsNoFartherThanAllowed)
{
  MeshRecipe recipe;
  recipe.field = plane({ 1, 0, 0 }, 0.8).field;
  const ElementMesh mesh = makeMesh(recipe);
  SurfaceWalker walker({ &mesh, 0.0, 1e-11 });
  const Location start{ 0, { { 0.5, 0.5, 0.5 } } }; // x = -0.5, so 1.3 away
  Evaluated on;
  EXPECT_FALSE(walker.project(start, 1.29, on));
  EXPECT_TRUE(walker.project(start, 1.31, on));
  EXPECT_NEAR(on.point.map.position.xyz.x, 0.8, 1e-11);
}

/// The walker gives up, and does so in time.
void expectGivesUp(const ElementMesh& mesh, const Location& start, double isovalue = 0.0)
{
  SurfaceWalker walker({ &mesh, isovalue, 1e-10 });
  Evaluated on;
  EXPECT_FALSE(walker.project(start, 10.0, on));
  EXPECT_LE(walker.evaluations(), mostEvaluations);
}

TEST_P(WalkThrough, GivesUpWhereThereIsNoSurface)
{
  const ElementMesh mesh = makeMesh(this->bent(3, 2, sphere({ 0.1, 0, 0 }, 0.6).field));
  Random random(9);
  for (int n = 0; n < 50; ++n)
  {
    expectGivesUp(mesh, randomLocation(mesh, random), 50.0);
    expectGivesUp(mesh, randomLocation(mesh, random), -50.0);
  }
}

TEST_P(WalkThrough, GivesUpWhereTheGradientVanishes)
{
  const ElementMesh constant = makeMesh(this->recipe(2, 1, [](const glm::dvec3&) { return 1.0; }));
  expectGivesUp(constant, { 0, { { 0.2, 0.3, 0.4 } } });
  // On the surface, but without any direction to it.
  expectGivesUp(constant, { 0, { { 0.2, 0.3, 0.4 } } }, 1.0);
}

TEST_P(WalkThrough, GivesUpInSingularElements)
{
  MeshRecipe recipe = this->recipe(2, 2);
  recipe.map = [](const glm::dvec3& x) { return glm::dvec3(x.x, x.y, 0.0); };
  const ElementMesh mesh = makeMesh(recipe);
  expectGivesUp(mesh, { 0, { { 0.2, 0.3, 0.4 } } }, 0.3);
}

TEST_P(WalkThrough, StopsAtTheFaceOfASingularNeighbor)
{
  // Right of x = 0 all is flat.
  MeshRecipe recipe = this->recipe(1, 2);
  recipe.map = [](const glm::dvec3& x) { return x.x > 0.0 ? glm::dvec3(0.0, x.y, x.z) : x; };
  const ElementMesh mesh = makeMesh(recipe);
  expectGivesUp(mesh, { 0, { { 0.2, 0.3, 0.4 } } }, -0.5);
}

TEST_P(WalkThrough, GivesUpAtNaN)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int component = 0; component < 4; ++component)
  {
    for (const double poison : { nan, std::numeric_limits<double>::infinity() })
    {
      ElementMesh mesh = makeMesh(this->recipe(2, 2, sphere({ 0, 0, 0 }, 0.6).field));
      mesh.coefficients[mesh.elements[0].firstCoefficient + 1][component] = poison;
      expectGivesUp(mesh, { 0, { { 0.3, 0.2, 0.2 } } });
    }
  }
}

TEST(SurfaceWalker, NeverReturnsAPointOffTheSurfaceWhateverTheElement)
{
  // Random control points: elements folded over themselves, with no sense of inside or outside.
  Random random(10);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    ElementMesh mesh;
    Element element;
    element.domain = which.domain;
    element.degrees = which.degrees;
    mesh.elements.push_back(element);
    mesh.coefficients = randomCoefficients(which, random);
    findFaceNeighbors(mesh, 1e-9);
    for (int n = 0; n < 20; ++n)
    {
      SurfaceWalker walker({ &mesh, 0.0, 1e-9 });
      Evaluated on;
      const bool found = walker.project({ 0, randomPoint(which.domain, random) }, 10.0, on);
      EXPECT_LE(walker.evaluations(), mostEvaluations);
      if (found)
      {
        EXPECT_TRUE(insideElement(mesh, on.location));
        EXPECT_LE(
          std::abs(walker.evaluate(on.location).point.value), 1e-9 * length(on.point.gradient));
      }
    }
  }
}

TEST(SurfaceWalker, MeasuresAJumpAlikeFromBothSides)
{
  // Along the face x = 0 the fields have slopes 0.8 and 1.6; both sides' curves are 0.05 apart.
  MeshRecipe left, right;
  left.field = [](const glm::dvec3& x) { return 0.6 * x.x + 0.8 * x.z; };
  right.field = [](const glm::dvec3& x) { return 0.6 * x.x + 1.6 * (x.z - 0.05); };
  ElementMesh mesh;
  appendBox(mesh, left, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(mesh, right, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  SurfaceWalker walker({ &mesh, 0.0, 1e-9 });
  const auto jumpFrom = [&](const Location& place, int face)
  {
    const Evaluated here = walker.evaluate(place);
    const auto there = walker.behind(here, face);
    return there ? SurfaceWalker::jumpBetween(mesh, here, *there) : -1.0;
  };
  EXPECT_NEAR(jumpFrom({ 0, { { 1, 0.3, 0.5 } } }, 1), 0.05, 1e-12);
  EXPECT_NEAR(jumpFrom({ 1, { { 0, 0.3, 0.525 } } }, 0), 0.05, 1e-12);
}

TEST(SurfaceWalker, PassesAFaceWhoseJumpIsWithinTheTolerance)
{
  // Along the face x = 0 the field has slope 0.8, and jumps by 0.04: both sides' curves are 0.05 apart.
  MeshRecipe left, right;
  left.field = [](const glm::dvec3& x) { return 0.6 * x.x + 0.8 * x.z; };
  right.field = [](const glm::dvec3& x) { return 0.6 * x.x + 0.8 * x.z - 0.04; };
  ElementMesh mesh;
  appendBox(mesh, left, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(mesh, right, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  const Location place{ 0, { { 1, 0.3, 0.5 } } };
  SurfaceWalker seamless({ &mesh, 0.0, 1e-9 });
  const Evaluated here = seamless.evaluate(place);
  const auto there = seamless.behind(here, 1);
  ASSERT_TRUE(there.has_value());
  EXPECT_NEAR(SurfaceWalker::jumpBetween(mesh, here, *there), 0.05, 1e-12);
  for (const float tolerance : { 0.049f, 0.051f })
  {
    const std::vector<float> jumpTolerances(2 * MaximumFaces, tolerance);
    SurfaceWalker walker({ &mesh, 0.0, 1e-9, nullptr, &jumpTolerances });
    const bool passes = tolerance > 0.05f;
    EXPECT_EQ(walker.endsAt(here, 1), !passes);
    EXPECT_EQ(walker.endFaceCount(place), passes ? 0 : 1);
    EXPECT_EQ(walker.move(here, { { 0.2, 0, 0 } }).element, passes ? 1 : 0);
    SurfaceWalker ending(
      Isosurface{ &mesh, 0.0, 1e-9, nullptr, &jumpTolerances }.endingWhereItMay());
    EXPECT_TRUE(ending.endsAt(here, 1));
  }
}

TEST(SurfaceWalker, BoundaryFacesOfACornerAnEdgeAFaceAndTheInside)
{
  MeshRecipe recipe;
  const ElementMesh mesh = makeMesh(recipe);
  EXPECT_EQ(boundaryFaceCount(mesh, { 0, { { 0, 0, 0 } } }), 3);
  EXPECT_EQ(boundaryFaceCount(mesh, { 0, { { 0.5, 0, 0 } } }), 2);
  EXPECT_EQ(boundaryFaceCount(mesh, { 0, { { 0.5, 0, 0.5 } } }), 1);
  EXPECT_EQ(boundaryFaceCount(mesh, { 0, { { 0.5, 0.5, 0.5 } } }), 0);
  // Faces with a neighbour are no boundary.
  EXPECT_EQ(boundaryFaceCount(mesh, { 0, { { 1, 1, 1 } } }), 0);
}

} // namespace
} // namespace hop::testing
