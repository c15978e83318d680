#include "Isolation/SurfaceBoxes.h"

#include "AnalyticFields.h"
#include "Classic/ClassicDistribution.h"
#include "ElementCases.h"
#include "Elements/NodalBasis.h"
#include "Isolation/CriticalPoint.h"
#include "SurfaceSeeds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace hop::testing
{
namespace
{

constexpr double anySize = 10.0;

ElementMesh meshOf(Domain domain, int degree, int cells, const Field& field)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { degree, degree, degree };
  recipe.cells = cells;
  recipe.field = field;
  return makeMesh(recipe);
}

/// Half the edges of a box of a hexahedron: its middle is an odd multiple of them, as boxes come from bisections.
glm::dvec3 halfLengths(const SurfaceBox& box)
{
  glm::dvec3 half(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    while (std::fmod(box.middle.u.xyz[axis], half[axis]) != 0.0 ||
      std::fmod(box.middle.u.xyz[axis], 2.0 * half[axis]) == 0.0)
    {
      half[axis] *= 0.5;
    }
  }
  return half;
}

ElementMesh randomHexahedron(int degree, Random& random)
{
  const ElementCase which{ Domain::Hexahedron, { degree, degree, degree } };
  ElementMesh mesh;
  Element element;
  element.degrees = which.degrees;
  mesh.elements.push_back(element);
  for (const LatticePoint& point : latticePoints(which.domain, which.degrees))
  {
    mesh.coefficients.emplace_back(latticePosition(which.degrees, point).xyz, randomNumber(random));
  }
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

TEST(Isolation, TheFieldRisesAlongItsMeanGradientInCertifiedBoxes)
{
  Random random(1);
  int certified = 0;
  for (int degree = 1; degree <= 6; ++degree)
  {
    const ElementMesh mesh = randomHexahedron(degree, random);
    const BernsteinForm form = mesh.form(0);
    const Degrees degrees{ degree, degree, degree };
    const auto lattice = latticePoints(Domain::Hexahedron, degrees);
    const NodalBasis basis = NodalBasis::lagrange(Domain::Hexahedron, degrees, lattice);
    for (const SurfaceBox& box : findSurfaceBoxes(mesh, 0.0, anySize, {}))
    {
      const bool isOneOfTwo = std::isfinite(box.largestOwnValue);
      if (!box.certified || isOneOfTwo)
      {
        continue;
      }
      ++certified;
      const glm::dvec3 half = halfLengths(box);
      ASSERT_NEAR(glm::length(half), box.referenceRadius, 1e-12);
      const auto gradientAt = [&](const glm::dvec3& t)
      {
        const Jet jet = evaluateGradient(form, { box.middle.u.xyz + (2.0 * t - 1.0) * half });
        return half * gradientOf(jet);
      };
      // The mean of a polynomial is the mean of its Bernstein coefficients.
      std::vector<glm::dvec3> nodal, coefficients(lattice.size());
      for (const LatticePoint& point : lattice)
      {
        nodal.push_back(gradientAt(latticePosition(degrees, point).xyz));
      }
      basis.toBernstein(&nodal[0].x, 3, &coefficients[0].x);
      glm::dvec3 mean(0.0);
      for (const glm::dvec3& c : coefficients)
      {
        mean += c;
      }
      for (int n = 0; n < 20; ++n)
      {
        EXPECT_GT(glm::dot(gradientAt(randomPoint(Domain::Hexahedron, random).xyz), mean), 0.0);
      }
    }
  }
  EXPECT_GT(certified, 500);
}

TEST(Isolation, BoxesOfAHexahedronHoldEverySampleOfTheSurfaceExactly)
{
  Random random(2);
  for (int degree = 1; degree <= 6; ++degree)
  {
    const ElementMesh mesh = randomHexahedron(degree, random);
    const auto boxes = findSurfaceBoxes(mesh, 0.0, anySize, {});
    const auto valueAt = [&](const glm::dvec3& u)
    { return evaluateGradient(mesh.form(0), { u }).value.w; };
    int samples = 0;
    for (int n = 0; n < 400; ++n)
    {
      glm::dvec3 a = randomPoint(Domain::Hexahedron, random).xyz;
      glm::dvec3 b = randomPoint(Domain::Hexahedron, random).xyz;
      if ((valueAt(a) < 0.0) == (valueAt(b) < 0.0))
      {
        continue;
      }
      for (int step = 0; step < 50; ++step)
      {
        const glm::dvec3 middle = 0.5 * (a + b);
        ((valueAt(a) < 0.0) == (valueAt(middle) < 0.0) ? a : b) = middle;
      }
      ++samples;
      EXPECT_TRUE(std::any_of(boxes.begin(), boxes.end(),
        [&](const SurfaceBox& box)
        {
          return glm::all(glm::lessThanEqual(
            glm::abs(a - box.middle.u.xyz), halfLengths(box) + glm::dvec3(1e-12)));
        }));
    }
    EXPECT_GT(samples, 20);
  }
}

class IsolationIn : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(Isolation, IsolationIn, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(IsolationIn, SpheresFromAThousandthOfAnElementUpAreFoundAndCertified)
{
  Random random(3);
  for (const int degree : { 2, 4, 8 })
  {
    for (const double radius : { 0.003, 0.01, 0.03, 0.1, 0.3 })
    {
      SCOPED_TRACE(::testing::Message() << "degree " << degree << ", radius " << radius);
      const KnownSurface ball = sphere(0.6 * randomVector(random), radius);
      const ElementMesh mesh = meshOf(this->GetParam(), degree, 1, ball.field);
      const auto boxes = findSurfaceBoxes(mesh, 0.0, anySize, {});
      EXPECT_EQ(uncertifiedCount(boxes), 0);
      const auto seeds = surfaceSeeds(mesh, 0.0, boxes);
      EXPECT_GE(seeds.size(), 8u);
      for (const Location& seed : seeds)
      {
        EXPECT_LE(std::abs(ball.field(positionAt(mesh, seed))), 1e-9);
      }
    }
  }
}

TEST_P(IsolationIn, EveryOneOfSeveralComponentsInAnElementIsSeeded)
{
  // Two spheres are of degree 4, two more of degree 8; all in one cube.
  const std::array<glm::dvec3, 4> centers{ { { -0.5, -0.45, -0.4 }, { 0.5, 0.4, 0.45 },
    { -0.4, 0.5, -0.5 }, { 0.55, -0.5, 0.5 } } };
  const std::array<double, 4> radii{ 0.02, 0.2, 0.05, 0.1 };
  const Field product = [&](const glm::dvec3& x)
  {
    double f = -1.0;
    for (int s = 0; s < 4; ++s)
    {
      f *= sphere(centers[s], radii[s]).field(x);
    }
    return f;
  };
  const ElementMesh mesh = meshOf(this->GetParam(), 8, 1, product);
  const auto boxes = findSurfaceBoxes(mesh, 0.0, anySize, {});
  EXPECT_EQ(uncertifiedCount(boxes), 0);
  std::array<int, 4> found{};
  for (const Location& seed : surfaceSeeds(mesh, 0.0, boxes))
  {
    for (int s = 0; s < 4; ++s)
    {
      found[s] +=
        std::abs(glm::distance(positionAt(mesh, seed), centers[s]) - radii[s]) < 1e-3 * radii[s];
    }
  }
  for (int s = 0; s < 4; ++s)
  {
    EXPECT_GE(found[s], 8) << "sphere " << s;
  }
}

TEST(Isolation, ABlobAtEveryMaximumInOneElement)
{
  // Maxima of T8(x) + T8(y) + T8(z) stand at 5 places an axis, those on the walls included.
  MeshRecipe recipe;
  recipe.degrees = { 8, 8, 8 };
  recipe.cells = 1;
  const auto chebyshev = [](double t)
  { return std::cos(8.0 * std::acos(glm::clamp(t, -1.0, 1.0))); };
  recipe.field = [&](const glm::dvec3& x)
  { return chebyshev(x.x) + chebyshev(x.y) + chebyshev(x.z); };
  const ElementMesh mesh = makeMesh(recipe);
  const auto boxes = findSurfaceBoxes(mesh, 2.5, anySize, {});
  EXPECT_EQ(uncertifiedCount(boxes), 0);
  std::vector<int> found(125, 0);
  for (const Location& seed : surfaceSeeds(mesh, 2.5, boxes))
  {
    // The blob's number along an axis: the maxima stand at cos(n pi / 4).
    const auto number = [](double t)
    {
      return static_cast<int>(
        std::lround(std::acos(glm::clamp(t, -1.0, 1.0)) * 4.0 / std::acos(-1.0)));
    };
    const glm::dvec3 x = positionAt(mesh, seed);
    ++found[number(x.x) + 5 * (number(x.y) + 5 * number(x.z))];
  }
  EXPECT_EQ(std::count(found.begin(), found.end(), 0), 0);
}

/// Surfaces that are tangent to faces, edges and nodes of the elements, or cross them.
struct SpecialPlace
{
  const char* name;
  Field field;
  int cells;
};

const std::vector<SpecialPlace>& specialPlaces()
{
  static const std::vector<SpecialPlace> all{
    { "a sphere around a node", sphere({ 0, 0, 0 }, 0.5).field, 2 },
    { "a sphere around a middle of an edge", sphere({ 0, 0, 0.5 }, 0.31).field, 2 },
    { "a sphere around a middle of a face", sphere({ 0, 0.5, 0.5 }, 0.31).field, 2 },
    { "a sphere around a corner of the domain", sphere({ 1, 1, 1 }, 0.4).field, 1 },
    { "a sphere around a point of a wall", sphere({ 0.11, 0.23, 1 }, 0.3).field, 1 },
    { "a sphere tangent to a wall from inside", sphere({ 0.1, 0.2, 0.5 }, 0.5).field, 1 },
    { "a sphere tangent to an inner face", sphere({ 0.4, 0.3, 0.35 }, 0.35).field, 2 },
    { "a plane on inner faces", plane({ 1, 0, 0 }, 0.0).field, 2 },
    { "a plane on a wall", plane({ 0, 0, 1 }, 1.0).field, 1 },
    { "a plane through nodes", plane(glm::normalize(glm::dvec3(1, 1, 1)), 0.0).field, 2 },
  };
  return all;
}

TEST_P(IsolationIn, SurfacesAtFacesEdgesAndNodesAreSeededInTime)
{
  for (const SpecialPlace& which : specialPlaces())
  {
    SCOPED_TRACE(which.name);
    const ElementMesh mesh = meshOf(this->GetParam(), 2, which.cells, which.field);
    const auto start = std::chrono::steady_clock::now();
    const auto boxes = findSurfaceBoxes(mesh, 0.0, 0.3, {});
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LT(seconds.count(), 5.0);
    EXPECT_LT(boxes.size(), 20000u);
    EXPECT_EQ(uncertifiedCount(boxes), 0);
    const auto seeds = surfaceSeeds(mesh, 0.0, boxes);
    EXPECT_GE(seeds.size(), 10u);
    for (const Location& seed : seeds)
    {
      EXPECT_LE(std::abs(which.field(positionAt(mesh, seed))), 1e-8);
    }
  }
}

/// Zero sets that are not surfaces everywhere.
struct Singular
{
  const char* name;
  Field field;
  /// Number of isolated singular points.
  int points;
};

const std::vector<Singular>& singulars()
{
  static const std::vector<Singular> all{
    { "a cone", [](const glm::dvec3& x) { return x.x * x.x + x.y * x.y - x.z * x.z; }, 1 },
    { "an isolated point", [](const glm::dvec3& x) { return glm::dot(x, x); }, 1 },
    { "crossing planes", [](const glm::dvec3& x) { return x.x * x.y; }, 0 },
    { "a double plane", [](const glm::dvec3& x) { return x.x * x.x; }, 0 },
    { "nothing but the isovalue", [](const glm::dvec3&) { return 0.0; }, 0 },
  };
  return all;
}

/// The field, moved so that its singularity is off the faces of boxes.
Field shifted(const Field& field)
{
  return [field](const glm::dvec3& x) { return field(x - glm::dvec3(0.113, -0.207, 0.171)); };
}

TEST_P(IsolationIn, SingularSurfacesAreReportedInTimeAndGiveNoNaN)
{
  for (const Singular& which : singulars())
  {
    for (const bool offGrid : { false, true })
    {
      SCOPED_TRACE(::testing::Message() << which.name << (offGrid ? ", off the grid" : ""));
      const ElementMesh mesh =
        meshOf(this->GetParam(), 2, 1, offGrid ? shifted(which.field) : which.field);
      const auto start = std::chrono::steady_clock::now();
      DistributionParameters parameters;
      parameters.sizing.spacing = 0.2;
      const Distribution result = distributeClassic({ &mesh, 0.0, 1e-9 }, parameters, {}, {});
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      EXPECT_LT(seconds.count(), 60.0);
      EXPECT_GT(result.report.boxesUndecided, 0);
      EXPECT_FALSE(result.report.undecidedCells.empty());
      if (which.points > 0)
      {
        EXPECT_GE(result.report.singularPoints, which.points);
      }
      for (const Particle& p : result.particles)
      {
        EXPECT_TRUE(std::isfinite(glm::dot(p.position.xyz, p.normal.xyz) + p.residual + p.spacing +
          p.curvature.mean + p.curvature.gauss));
      }
    }
  }
}

TEST_P(IsolationIn, ASingularPointIsFoundWhereItIs)
{
  const glm::dvec3 tip(0.113, -0.207, 0.171);
  for (const int cone : { 0, 1 })
  {
    const ElementMesh mesh = meshOf(this->GetParam(), 2, 1, shifted(singulars()[cone].field));
    int onSurface = 0;
    for (const SurfaceBox& box : findSurfaceBoxes(mesh, 0.0, anySize, {}))
    {
      CriticalPoint point;
      if (!box.certified && findCriticalPoint(mesh, 0.0, box, point) && point.onSurface)
      {
        ++onSurface;
        EXPECT_LE(glm::distance(positionAt(mesh, point.location), tip), 1e-6);
      }
    }
    EXPECT_GT(onSurface, 0);
  }
}

/// The polynomials of a mesh, converted to their values at the nodes and back, as if its Bezier cells had been written
/// as Lagrange cells.
ElementMesh throughNodes(const ElementMesh& mesh)
{
  ElementMesh result = mesh;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
  {
    const BernsteinForm form = mesh.form(e);
    const auto lattice = latticePoints(form.domain, form.degrees);
    std::vector<Coefficient> nodal;
    for (const LatticePoint& point : lattice)
    {
      nodal.push_back(evaluateGradient(form, latticePosition(form.degrees, point)).value);
    }
    NodalBasis::lagrange(form.domain, form.degrees, lattice)
      .toBernstein(&nodal[0].x, 4, &result.coefficients[mesh.elements[e].firstCoefficient].x);
  }
  return result;
}

/// Boxes and seeds move by no more than rounding errors.
TEST(Isolation, TheSamePolynomialsAsBezierAndAsLagrangeGiveTheSameSeeds)
{
  constexpr double wantedSize = 0.3;
  constexpr double isovalue = 0.6;
  for (const Domain domain : allDomains)
  {
    for (int degree = 1; degree <= 8; ++degree)
    {
      SCOPED_TRACE(::testing::Message() << domain << ", degree " << degree);
      MeshRecipe recipe;
      recipe.domain = domain;
      recipe.degrees = { degree, degree, degree };
      recipe.map = wavyMap(0.1);
      recipe.field = [](const glm::dvec3& x)
      { return glm::length(x - glm::dvec3(0.11, 0.07, 0.05)); };
      const ElementMesh bezier = makeMesh(recipe);
      const ElementMesh lagrange = throughNodes(bezier);
      const auto boxes = findSurfaceBoxes(bezier, isovalue, wantedSize, {});
      const auto otherBoxes = findSurfaceBoxes(lagrange, isovalue, wantedSize, {});
      ASSERT_EQ(boxes.size(), otherBoxes.size());
      const auto seeds = surfaceSeeds(bezier, isovalue, boxes);
      const auto otherSeeds = surfaceSeeds(lagrange, isovalue, otherBoxes);
      ASSERT_EQ(seeds.size(), otherSeeds.size());
      double farthest = 0.0;
      for (std::size_t i = 0; i < seeds.size(); ++i)
      {
        EXPECT_EQ(seeds[i].element, otherSeeds[i].element);
        farthest = std::max(farthest,
          glm::distance(positionAt(bezier, seeds[i]), positionAt(lagrange, otherSeeds[i])));
      }
      EXPECT_LT(farthest, 1e-12);
    }
  }
}

} // namespace
} // namespace hop::testing
