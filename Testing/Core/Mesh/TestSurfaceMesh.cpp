// Meshes of known surfaces: closed, of the right topology, area and shape.

#include "Mesh/SurfaceMesh.h"

#include "AnalyticFields.h"
#include "Fast/FastDistribution.h"
#include "MeshMeasures.h"
#include "Support/Interruptible.h"
#include "TestMeshes.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hop::testing
{
namespace
{

struct Meshed
{
  ElementMesh elements;
  Distribution distribution;
  SurfaceMesh mesh;
};

/// \param spacing world units; the cube that holds the surface is 2 wide
Meshed meshOf(const Field& field, int degree, double spacing, double angularDensity = 0.0,
  double smallestSpacing = 0.0)
{
  MeshRecipe recipe;
  recipe.degrees = { degree, degree, degree };
  recipe.map = wavyMap(0.1);
  recipe.field = field;
  Meshed result;
  result.elements = makeMesh(recipe);
  const Isosurface surface{ &result.elements, 0.0, 1e-9 };
  DistributionParameters parameters;
  parameters.sizing = { spacing, angularDensity, smallestSpacing };
  result.distribution = distributeFast(surface, parameters, {}, {});
  result.mesh =
    meshSurface(surface, ConstrainedEdges(result.distribution), result.distribution, {}, {});
  return result;
}

/// What holds for every mesh of a smooth closed surface.
void expectClosed(const Meshed& meshed)
{
  const MeshMeasures measures = measureMesh(meshed.distribution, meshed.mesh.triangles);
  EXPECT_EQ(measures.badEdges, 0);
  EXPECT_EQ(measures.openEdges, 0);
  EXPECT_EQ(measures.badVertices, 0);
  EXPECT_EQ(measures.turnedTriangles, 0);
  EXPECT_EQ(measures.unusedParticles, 0);
  EXPECT_EQ(meshed.mesh.openLoops, 0);
  EXPECT_EQ(meshed.mesh.openLength, 0.0);
  EXPECT_EQ(meshed.mesh.unusedParticles, 0);
  EXPECT_GE(measures.medianMinAngle, 50.0);
  EXPECT_GE(measures.lowMinAngle, 30.0);
}

double sumOf(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(SurfaceMesh, ClosesASphere)
{
  const KnownSurface known = sphere({ 0, 0, 0 }, 0.6);
  const Meshed meshed = meshOf(known.field, 4, 0.05);
  expectClosed(meshed);
  const MeshMeasures measures = measureMesh(meshed.distribution, meshed.mesh.triangles);
  EXPECT_EQ(measures.eulerCharacteristic, 2);
  EXPECT_EQ(measures.components, 1);
  EXPECT_NEAR(measures.area / known.area, 1.0, 0.002);
}

TEST(SurfaceMesh, ClosesATorus)
{
  const KnownSurface known = torus(0.5, 0.22);
  for (const double angularDensity : { 0.0, 7.0 })
  {
    const Meshed meshed =
      meshOf(known.field, 6, angularDensity > 0.0 ? 0.12 : 0.04, angularDensity);
    expectClosed(meshed);
    const MeshMeasures measures = measureMesh(meshed.distribution, meshed.mesh.triangles);
    EXPECT_EQ(measures.eulerCharacteristic, 0);
    EXPECT_EQ(measures.components, 1);
    EXPECT_NEAR(measures.area / known.area, 1.0, 0.005);
  }
}

TEST(SurfaceMesh, KeepsTwoSpheresApart)
{
  // 0.03 spacings between them.
  constexpr double spacing = 0.05;
  constexpr double r = 0.4 - 0.5 * 0.03 * spacing;
  const Meshed meshed =
    meshOf(bothOf(sphere({ -0.4, 0, 0 }, r), sphere({ 0.4, 0, 0 }, r)).field, 4, spacing);
  expectClosed(meshed);
  const MeshMeasures measures = measureMesh(meshed.distribution, meshed.mesh.triangles);
  EXPECT_EQ(measures.eulerCharacteristic, 4);
  EXPECT_EQ(measures.components, 2);
}

/// The mesh ends where the surface does, and nowhere else.
void expectBorders(const Meshed& meshed, std::int64_t loops, std::int64_t eulerCharacteristic)
{
  const MeshMeasures measures = measureMesh(meshed.distribution, meshed.mesh.triangles);
  EXPECT_EQ(measures.badEdges, 0);
  EXPECT_EQ(measures.badVertices, 0);
  EXPECT_EQ(measures.turnedTriangles, 0);
  EXPECT_EQ(measures.holeEdges, 0);
  EXPECT_EQ(measures.unusedParticles, 0);
  EXPECT_EQ(measures.openLoops, loops);
  EXPECT_EQ(measures.eulerCharacteristic, eulerCharacteristic);
  EXPECT_EQ(meshed.mesh.openLoops, 0);
}

TEST(SurfaceMesh, EndsAtTheEndOfTheDomain)
{
  // A tube has two borders, a sphere that the cube cuts has six, a slanted plane one, with corners.
  expectBorders(meshOf(cylinder(0.5).field, 4, 0.06), 2, 0);
  expectBorders(meshOf(sphere({ 0, 0, 0 }, 1.2).field, 4, 0.06), 6, -4);
  expectBorders(
    meshOf(plane(glm::normalize(glm::dvec3(1.0, 0.3, 0.05)), 0.1).field, 2, 0.06), 1, 1);
}

/// With particles on creases.
Meshed meshWithCreases(const ElementMesh& elements, double spacing,
  const ParallelFor& parallelFor = {}, double angularDensity = 0.0)
{
  Meshed result;
  result.elements = elements;
  const Isosurface surface{ &result.elements, 0.0, 1e-9 };
  DistributionParameters parameters;
  parameters.sizing = { spacing, angularDensity };
  parameters.onCreases = true;
  result.distribution = distributeFast(surface, parameters, {}, parallelFor);
  result.mesh = meshSurface(
    surface, ConstrainedEdges(result.distribution), result.distribution, {}, parallelFor);
  return result;
}

/// A roof, z = 0.1 - |x|, whose ridge is a right angle.
ElementMesh rightAngledRoof()
{
  MeshRecipe left, right;
  left.field = [](const glm::dvec3& x) { return x.z - 0.1 - x.x; };
  right.field = [](const glm::dvec3& x) { return x.z - 0.1 + x.x; };
  ElementMesh elements;
  appendBox(elements, left, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(elements, right, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(elements, 1e-9);
  return elements;
}

TEST(SurfaceMesh, FoldsAtARidge)
{
  const Meshed meshed = meshWithCreases(rightAngledRoof(), 0.07);
  expectBorders(meshed, 1, 1);
  const double area = measureMesh(meshed.distribution, meshed.mesh.triangles).area;
  EXPECT_NEAR(area, 4.0 * std::sqrt(2.0), 1e-9); // no triangle cuts the ridge off
}

/// A polyhedron: a sphere as linear tetrahedra have it, with creases in all of their faces.
ElementMesh polyhedron()
{
  MeshRecipe recipe;
  recipe.domain = Domain::Tetrahedron;
  recipe.degrees = { 1, 1, 1 };
  recipe.cells = 3;
  recipe.field = [](const glm::dvec3& x)
  { return glm::length(x - glm::dvec3(0.05, 0.02, 0.01)) - 0.7; };
  return makeMesh(recipe);
}

TEST(SurfaceMesh, ClosesOverCreasesThatMeet)
{
  const ElementMesh elements = polyhedron();
  std::vector<double> areas;
  for (const double spacing : { 0.03, 0.05, 0.08 })
  {
    const Meshed meshed = meshWithCreases(elements, spacing);
    expectBorders(meshed, 0, 2);
    const MeshMeasures measures = measureMesh(meshed.distribution, meshed.mesh.triangles);
    EXPECT_EQ(measures.components, 1);
    EXPECT_EQ(measures.openEdges, 0);
    areas.push_back(measures.area);
  }
  // Facets are flat, so that nothing is lost but at edges below 10 degrees.
  EXPECT_NEAR(areas[1] / areas[0], 1.0, 1e-4);
  EXPECT_NEAR(areas[2] / areas[0], 1.0, 1e-4);
}

/// Two boxes that meet in x = 0, each with a field of its own.
ElementMesh halves(const Field& left, const Field& right)
{
  MeshRecipe recipe;
  ElementMesh elements;
  recipe.field = left;
  appendBox(elements, recipe, { -1, -1, -1 }, { 0, 1, 1 });
  recipe.field = right;
  appendBox(elements, recipe, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(elements, 1e-9);
  return elements;
}

TEST(SurfaceMesh, ClosesOverACreaseThatIsClosedInItsFace)
{
  // Half a ball and the cap of a paraboloid on its circle.
  for (const double r : { 0.5, 0.13, 0.06 })
  {
    SCOPED_TRACE(r);
    const Field ball = [r](const glm::dvec3& x) { return glm::dot(x, x) - r * r; };
    const Field cap = [r](const glm::dvec3& x) { return x.y * x.y + x.z * x.z - r * r + r * x.x; };
    const Meshed meshed = meshWithCreases(halves(ball, cap), 0.08, {}, 10.0);
    expectBorders(meshed, 0, 2);
    EXPECT_GE(meshed.distribution.edges.coincident.size(), 3u);
    // The area of the paraboloid: pi / 6 (5^1.5 - 1) r^2.
    const double area = (2.0 + (5.0 * std::sqrt(5.0) - 1.0) / 6.0) * 3.141592653589793 * r * r;
    EXPECT_NEAR(measureMesh(meshed.distribution, meshed.mesh.triangles).area / area, 1.0, 0.05);
  }
}

TEST(SurfaceMesh, KeepsBranchesOfACreaseApartAtASaddle)
{
  // The crease is the hyperbola y z = c, whose branches come within sqrt(8 c) of each other: less than a chord of theirs.
  constexpr double a = 0.03, b = 0.3;
  for (const double c : { 2e-5, 5e-5, 2e-4 })
  {
    SCOPED_TRACE(c);
    const ElementMesh elements =
      halves([&](const glm::dvec3& x) { return x.y * x.z - c + a * x.x; },
        [&](const glm::dvec3& x) { return x.y * x.z - c + b * x.x; });
    const Meshed meshed = meshWithCreases(elements, 0.04, {}, 10.0);
    const MeshMeasures measures = measureMesh(meshed.distribution, meshed.mesh.triangles);
    EXPECT_FALSE(meshed.distribution.edges.coincident.empty());
    EXPECT_EQ(measures.badEdges, 0);
    EXPECT_EQ(measures.holeEdges, 0);
    EXPECT_EQ(meshed.mesh.openLoops, 0);
    EXPECT_EQ(meshed.mesh.unusedParticles, 0);
  }
}

/// A cube whose left half has a surface of its own: with another one at z = 0.5 on the right, the field jumps.
ElementMesh besideAnother(const Field& field)
{
  MeshRecipe left, right;
  left.degrees = { 3, 3, 3 };
  left.field = field;
  right.field = [](const glm::dvec3& x) { return x.z - 0.5; };
  ElementMesh elements;
  appendBox(elements, left, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(elements, right, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(elements, 1e-9);
  return elements;
}

constexpr double jumpSpacing = 0.06;

/// \param jumping a discontinuous field
void expectNothingLacks(const ElementMesh& jumping)
{
  const Meshed meshed = meshWithCreases(jumping, jumpSpacing);
  EXPECT_EQ(meshed.mesh.openLoops, 0);
  EXPECT_EQ(meshed.mesh.unusedParticles, 0);
  EXPECT_FALSE(meshed.distribution.pieces.areOne());
}

/// The end of the surface leaves the face between the halves by its upper edge, shortly before it comes to the corner.
TEST(SurfaceMesh, KeepsCornersThatItsEndCutsOff)
{
  for (const double bend : { -8.0, -4.0, -1.0, 0.0, 1.0, 4.0, 8.0 })
  {
    for (const double slope : { 0.05, 0.1, 0.3 })
    {
      for (const double before : { 0.005, 0.015, 0.025, 0.035, 0.045, 0.055 })
      {
        SCOPED_TRACE(::testing::Message() << bend << ", " << slope << ", " << before);
        expectNothingLacks(besideAnother(
          [=](const glm::dvec3& x)
          {
            const double y = x.y - 1.0 + before;
            return x.z - 1.0 - slope * (x.x + y) - bend * y * y;
          }));
      }
    }
  }
}

/// The surface cuts off the edge between two faces at which it ends, but for a strip of almost no width, or a gap, in the
/// middle of the edge: there its curves come within far less than a chord of each other.
TEST(SurfaceMesh, KeepsStripsThatAreAllButCut)
{
  for (const double width : { 1e-5, 1e-4, 1e-3, 1e-2, -1e-5, -1e-4, -1e-3, -1e-2 }) // spacings
  {
    for (const double slope : { 0.3, 1.0, 3.0 })
    {
      for (const double bend : { 0.1, 1.0 })
      {
        for (const double middle : { 0.007, 0.021, 0.035, 0.049 })
        {
          SCOPED_TRACE(
            ::testing::Message() << width << ", " << slope << ", " << bend << ", " << middle);
          expectNothingLacks(besideAnother(
            [=](const glm::dvec3& x)
            {
              const double y = x.y - middle;
              return x.z - 1.0 + slope * x.x * (1.0 + 0.3 * y) + bend * y * y + width * jumpSpacing;
            }));
        }
      }
    }
  }
}

/// The surface cuts off a corner of the left half, a piece far smaller than the spacing.
TEST(SurfaceMesh, KeepsSmallPieces)
{
  for (const double size : { 1e-3, 1e-2, 1e-1 }) // spacings
  {
    SCOPED_TRACE(size);
    expectNothingLacks(besideAnother(
      [=](const glm::dvec3& x) { return x.z + x.x + x.y - 2.0 + size * jumpSpacing; }));
  }
}

/// Joins the particles of a mesh anew, with some more in its midst that no triangle can have, as their normals are turned.
std::int64_t unusedWith(int more, Meshed meshed)
{
  Distribution& distribution = meshed.distribution;
  const glm::dvec3 middle(-0.5, 0.0, 0.1);
  const Particle nearest =
    *std::min_element(distribution.particles.begin(), distribution.particles.end(),
      [&](const Particle& a, const Particle& b)
      { return glm::distance(a.position.xyz, middle) < glm::distance(b.position.xyz, middle); });
  for (int n = 0; n < more; ++n)
  {
    Particle turned = nearest;
    turned.position.xyz += nearest.spacing * glm::dvec3(0.3 + 0.1 * n, 0.2 * n, 0.0);
    turned.normal = { { 0.6, 0.0, 0.8 } }; // those of the sheet point down
    distribution.particles.push_back(turned);
  }
  const Isosurface surface{ &meshed.elements, 0.0, 1e-9 };
  const SurfaceMesh mesh =
    meshSurface(surface, ConstrainedEdges(distribution), distribution, {}, {});
  EXPECT_EQ(mesh.openLoops, 0);
  EXPECT_EQ(mesh.atFaults.size(), static_cast<std::size_t>(mesh.unusedParticles));
  return mesh.unusedParticles;
}

TEST(SurfaceMesh, NeedsNoLoneParticleInPieces)
{
  const Field plane = [](const glm::dvec3& x) { return x.z - 0.1; };
  const Meshed jumping = meshWithCreases(besideAnother(plane), jumpSpacing);
  EXPECT_EQ(unusedWith(1, jumping), 0);
  EXPECT_EQ(unusedWith(2, jumping), 0);
  EXPECT_EQ(unusedWith(4, jumping), 4) << "they may be of another component";
  EXPECT_EQ(unusedWith(1, meshWithCreases(halves(plane, plane), jumpSpacing)), 1)
    << "where topology tells more";
}

TEST(SurfaceMesh, IsTheSameOverCreasesForAnyNumberOfThreads)
{
  const ElementMesh elements = polyhedron();
  const Meshed one = meshWithCreases(elements, 0.06);
  const Meshed three = meshWithCreases(elements, 0.06, threadedFor(3));
  EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
  ASSERT_EQ(one.distribution.particles.size(), three.distribution.particles.size());
  for (std::size_t p = 0; p < one.distribution.particles.size(); ++p)
  {
    EXPECT_EQ(
      one.distribution.particles[p].position.xyz, three.distribution.particles[p].position.xyz);
  }
}

/// A sum of waves, other ones for every seed.
Field waves(int seed)
{
  return [seed](const glm::dvec3& x)
  {
    double sum = -0.2;
    for (int n = 0; n < 4; ++n)
    {
      const double k = 17.0 * seed + 5.0 * n;
      const glm::dvec3 along(std::sin(k + 1.0), std::sin(1.3 * k + 2.0), std::sin(1.7 * k + 3.0));
      sum += std::cos(3.5 * glm::dot(along, x) + std::sin(2.1 * k)) / 2.0;
    }
    return sum;
  };
}

class SurfaceMeshInDomain : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(SurfaceMesh, SurfaceMeshInDomain, ::testing::ValuesIn(allDomains),
  [](const auto& domain) { return ::testing::PrintToString(domain.param); });

/// Fields of degree 3 in bent cells, with creases at all faces: no hole, no particle left over.
TEST_P(SurfaceMeshInDomain, HasNoHoleForAnyField)
{
  for (int seed = 0; seed < 12; ++seed)
  {
    MeshRecipe recipe;
    recipe.domain = this->GetParam();
    recipe.degrees = { 3, 3, 3 };
    recipe.map = wavyMap(0.1);
    recipe.field = waves(seed);
    const ElementMesh elements = makeMesh(recipe);
    for (const double spacing : { 0.04, 0.08 })
    {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", spacing " << spacing);
      constexpr double angularDensity = 10.0; // the filter's
      const Meshed meshed = meshWithCreases(elements, spacing, {}, angularDensity);
      const MeshMeasures measures = measureMesh(meshed.distribution, meshed.mesh.triangles);
      EXPECT_EQ(measures.badEdges, 0);
      EXPECT_EQ(measures.badVertices, 0);
      EXPECT_EQ(measures.turnedTriangles, 0);
      EXPECT_EQ(measures.holeEdges, 0);
      EXPECT_EQ(meshed.mesh.openLoops, 0);
      EXPECT_EQ(meshed.mesh.unusedParticles, 0);
    }
  }
}

TEST(SurfaceMesh, ClosesThinBodies)
{
  // A plate at whose rim the spacing follows the curvature, down to an eleventh. Where it goes on falling, to a twentieth
  // within a few particles, holes may stay; they are counted.
  const Field plate = [](const glm::dvec3& x)
  { return 1.0 - (x.x * x.x + x.y * x.y) / 0.49 - x.z * x.z / 0.0025; };
  for (const double smallest : { 0.05 / 11.0, 0.0 })
  {
    const Meshed meshed = meshOf(plate, 4, 0.05, 10.0, smallest);
    const MeshMeasures measures = measureMesh(meshed.distribution, meshed.mesh.triangles);
    EXPECT_EQ(measures.badEdges, 0);
    EXPECT_EQ(measures.unusedParticles, meshed.mesh.unusedParticles);
    EXPECT_EQ(measures.turnedTriangles, meshed.mesh.turnedTriangles);
    EXPECT_EQ(measures.openLoops, meshed.mesh.openLoops);
    EXPECT_LE(measures.openLoops, smallest > 0.0 ? 0 : 2);
    EXPECT_EQ(measures.eulerCharacteristic, 2 - measures.openLoops);
  }
}

TEST(SurfaceMesh, IsAManifoldWhateverTheParticlesAre)
{
  // Spacings far too large for the surface: what there is has to be sound, and what is open is told.
  for (const double spacing : { 0.15, 0.2, 0.3, 0.45, 0.7 })
  {
    const Meshed meshed = meshOf(torus(0.5, 0.1).field, 6, spacing);
    const MeshMeasures measures = measureMesh(meshed.distribution, meshed.mesh.triangles);
    EXPECT_EQ(measures.badEdges, 0);
    EXPECT_EQ(measures.badVertices, 0);
    EXPECT_EQ(measures.turnedTriangles, 0);
    EXPECT_EQ(measures.unusedParticles, meshed.mesh.unusedParticles);
    EXPECT_EQ(measures.openEdges > 0, meshed.mesh.openLoops > 0);
    EXPECT_EQ(meshed.mesh.openLength > 0.0, meshed.mesh.openLoops > 0);
  }
}

TEST(SurfaceMesh, EndsEarlyWhereTheMonitorAsks)
{
  Meshed meshed = meshOf(sphere({ 0, 0, 0 }, 0.6).field, 4, 0.1);
  const Isosurface surface{ &meshed.elements, 0.0, 1e-9 };
  const Monitor stop{ [](double) { return false; } };
  EXPECT_THROW(
    meshSurface(surface, ConstrainedEdges(meshed.distribution), meshed.distribution, stop, {}),
    Interrupted);
  EXPECT_THROW(particleAreas(meshed.distribution, ConstrainedEdges(meshed.distribution), stop, {}),
    Interrupted);
}

TEST(SurfaceMesh, IsTheSameForAnyNumberOfThreads)
{
  Meshed one = meshOf(torus(0.5, 0.22).field, 6, 0.04);
  const Isosurface surface{ &one.elements, 0.0, 1e-9 };
  for (const int threads : { 2, 5 })
  {
    EXPECT_EQ(meshSurface(surface, ConstrainedEdges(one.distribution), one.distribution, {},
                threadedFor(threads))
                .triangles,
      one.mesh.triangles);
  }
}

TEST(SurfaceMesh, IsEmptyWithoutParticles)
{
  Distribution nothing;
  const SurfaceMesh mesh = meshSurface({}, ConstrainedEdges(nothing), nothing, {}, {});
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_EQ(mesh.openLoops, 0);
  EXPECT_TRUE(particleAreas(nothing, ConstrainedEdges(nothing), {}, {}).empty());
}

TEST(ParticleAreas, AddUpToTheSurface)
{
  const KnownSurface ball = sphere({ 0, 0, 0 }, 0.6);
  const Meshed coarse = meshOf(ball.field, 4, 0.1);
  EXPECT_NEAR(
    sumOf(particleAreas(coarse.distribution, ConstrainedEdges(coarse.distribution), {}, {})) /
      ball.area,
    1.0, 0.002);
  const KnownSurface ring = torus(0.5, 0.22);
  const Meshed fine = meshOf(ring.field, 6, 0.05);
  EXPECT_NEAR(sumOf(particleAreas(fine.distribution, ConstrainedEdges(fine.distribution), {}, {})) /
      ring.area,
    1.0, 0.002);
}

TEST(ParticleAreas, AreNoneOfParticlesThatAreReplaced)
{
  const KnownSurface ball = sphere({ 0, 0, 0 }, 0.6);
  Meshed meshed = meshOf(ball.field, 4, 0.1);
  Distribution& distribution = meshed.distribution;
  distribution.particles.push_back(Particle(distribution.particles.front()));
  distribution.edges.replaced = { 0 };
  const std::vector<double> areas =
    particleAreas(distribution, ConstrainedEdges(distribution), {}, {});
  EXPECT_EQ(areas.front(), 0.0);
  EXPECT_NEAR(sumOf(areas) / ball.area, 1.0, 0.002);
}

/// Hexagonal packing in the plane z = 0, spacing 1, around the origin, where two particles are missing.
Distribution packingWithAHole()
{
  Distribution distribution;
  for (int row = -8; row <= 8; ++row)
  {
    for (int column = -8; column <= 8; ++column)
    {
      if (row != 0 || (column != 0 && column != 1))
      {
        Particle particle;
        particle.position.xyz = { column + 0.5 * row, 0.5 * std::sqrt(3.0) * row, 0.0 };
        particle.normal.xyz = { 0.0, 0.0, 1.0 };
        particle.spacing = 1.0;
        distribution.particles.push_back(particle);
      }
    }
  }
  return distribution;
}

TEST(ParticleAreas, CoverTheHoleOfMissingParticles)
{
  // The particles above and below the hole meet in its middle, farther apart than neighbours are looked for first.
  const Distribution distribution = packingWithAHole();
  const std::vector<double> areas =
    particleAreas(distribution, ConstrainedEdges(distribution), {}, {});
  constexpr double hexagon = 0.8660254037844386;
  double more = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    if (glm::length(distribution.particles[i].position.xyz) < 4.5)
    {
      more += areas[i] - hexagon;
    }
  }
  EXPECT_NEAR(more, 2.0 * hexagon, 1e-6);
}

} // namespace
} // namespace hop::testing
