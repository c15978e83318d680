#include "Mesh/CurvedTriangles.h"

#include "AnalyticFields.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace hop::testing
{
namespace
{

using Triangles = std::vector<std::array<int, 3>>;

/// Points of a triangulated surface, near the isosurface.
struct PointMesh
{
  std::vector<glm::dvec3> points;
  Triangles triangles;
};

/// The octahedron, each triangle split into n^2.
PointMesh octasphere(double radius, int n)
{
  PointMesh mesh;
  std::map<std::array<int, 3>, int> numbers;
  const auto pointAt = [&](const glm::ivec3& lattice)
  {
    const auto [found, isNew] = numbers.try_emplace(
      { lattice.x, lattice.y, lattice.z }, static_cast<int>(mesh.points.size()));
    if (isNew)
    {
      mesh.points.push_back(radius * glm::normalize(glm::dvec3(lattice)));
    }
    return found->second;
  };
  for (int octant = 0; octant < 8; ++octant)
  {
    const glm::ivec3 sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    const bool flipped = sign.x * sign.y * sign.z < 0;
    const auto add = [&](const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c)
    {
      mesh.triangles.push_back({ pointAt(sign * a), pointAt(sign * (flipped ? c : b)),
        pointAt(sign * (flipped ? b : c)) });
    };
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; i + j < n; ++j)
      {
        const auto at = [&](int di, int dj)
        { return glm::ivec3(i + di, j + dj, n - i - di - j - dj); };
        add(at(0, 0), at(1, 0), at(0, 1));
        if (i + j + 1 < n)
        {
          add(at(1, 0), at(1, 1), at(0, 1));
        }
      }
    }
  }
  return mesh;
}

/// n by m quadrilaterals, two triangles each.
PointMesh torusMesh(double major, double minor, int n, int m)
{
  PointMesh mesh;
  const double turn = 2.0 * std::acos(-1.0);
  const auto number = [&](int i, int j) { return (i % n) * m + j % m; };
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < m; ++j)
    {
      const double u = turn * i / n;
      const double v = turn * j / m;
      const double r = major + minor * std::cos(v);
      mesh.points.emplace_back(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
      mesh.triangles.push_back({ number(i, j), number(i + 1, j), number(i, j + 1) });
      mesh.triangles.push_back({ number(i + 1, j), number(i + 1, j + 1), number(i, j + 1) });
    }
  }
  return mesh;
}

/// Places of a mesh's points on the isosurface.
Buffer<Particle> particlesAt(const Isosurface& surface, const std::vector<glm::dvec3>& points)
{
  SurfaceWalker walker(surface);
  Buffer<Particle> particles;
  for (const glm::dvec3& x : points)
  {
    Evaluated at = walker.evaluate({ 0, { glm::dvec3(0.5) } });
    for (int n = 0; n < 20; ++n)
    {
      at = walker.evaluate(walker.move(at, { x - at.point.map.position.xyz }));
    }
    EXPECT_TRUE(walker.project(at.location, 0.5, at));
    EXPECT_LE(glm::distance(at.point.map.position.xyz, x), 1e-3);
    particles.push_back(particleAt(at.location, at.point, {}, 0.1));
  }
  return particles;
}

std::vector<int> ownVertices(std::size_t count)
{
  std::vector<int> vertices(count);
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

/// Lagrange's shape functions of a triangle in VTK's order of nodes, by the nodes' lattice points.
std::vector<glm::ivec3> latticeOf(int order)
{
  std::vector<glm::ivec3> lattice{ { order, 0, 0 }, { 0, order, 0 }, { 0, 0, order } };
  for (int edge = 0; edge < 3; ++edge)
  {
    for (int i = 1; i < order; ++i)
    {
      glm::ivec3 at(0);
      at[edge] = order - i;
      at[(edge + 1) % 3] = i;
      lattice.push_back(at);
    }
  }
  if (order == 3)
  {
    lattice.emplace_back(1, 1, 1);
  }
  else if (order == 4)
  {
    lattice.insert(lattice.end(), { { 2, 1, 1 }, { 1, 2, 1 }, { 1, 1, 2 } });
  }
  return lattice;
}

double shapeFunction(const glm::ivec3& node, int order, const glm::dvec3& b)
{
  double value = 1.0;
  for (int c = 0; c < 3; ++c)
  {
    for (int i = 0; i < node[c]; ++i)
    {
      value *= (order * b[c] - i) / (node[c] - i);
    }
  }
  return value;
}

/// Largest distance of the curved triangles from the surface and of their interpolated normals from its normal.
struct Errors
{
  double distance = 0.0;
  double normal = 0.0;
  std::int64_t straight = 0;
};

using Nearest = std::function<glm::dvec3(const glm::dvec3&)>;

Errors errorsOf(const Isosurface& surface, const PointMesh& mesh, int order,
  const KnownSurface& known, const Nearest& nearest)
{
  Buffer<Particle> particles = particlesAt(surface, mesh.points);
  const CurvedTriangles bent =
    bendTriangles(surface, mesh.triangles, ownVertices(particles.size()), order, particles, {});
  const std::vector<glm::ivec3> lattice = latticeOf(order);
  const std::size_t count = lattice.size();
  Errors errors{ 0.0, 0.0, bent.straightNodes };
  constexpr int samples = 7;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int i = 0; i <= samples; ++i)
    {
      for (int j = 0; i + j <= samples; ++j)
      {
        const glm::dvec3 b = glm::dvec3(i, j, samples - i - j) / double(samples);
        glm::dvec3 x(0.0);
        glm::dvec3 n(0.0);
        for (std::size_t k = 0; k < count; ++k)
        {
          const Particle& node = particles[bent.nodes[t * count + k]];
          const double weight = shapeFunction(lattice[k], order, b);
          x += weight * node.position.xyz;
          n += weight * node.normal.xyz;
        }
        const glm::dvec3 foot = nearest(x);
        errors.distance = std::max(errors.distance, glm::distance(x, foot));
        errors.normal = std::max(errors.normal, glm::distance(n, known.normal(foot)));
      }
    }
  }
  return errors;
}

/// A mesh of curved elements that holds a field of degree 4 to some 1e-9.
ElementMesh curvedMesh(const Field& field)
{
  MeshRecipe recipe;
  recipe.degrees = { 12, 12, 12 };
  recipe.cells = 2;
  recipe.map = wavyMap(0.02);
  recipe.field = field;
  return makeMesh(recipe);
}

class ByOrder : public ::testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(CurvedTriangles, ByOrder, ::testing::Values(2, 3, 4));

/// Errors on meshes of which each halves the triangles of the one before.
void expectOrder(int order, const std::vector<Errors>& errors)
{
  for (std::size_t n = 1; n < errors.size(); ++n)
  {
    EXPECT_EQ(errors[n].straight, 0);
    const double rate = std::log2(errors[n - 1].distance / errors[n].distance);
    const double rateOfNormals = std::log2(errors[n - 1].normal / errors[n].normal);
    EXPECT_GE(rate, order + 0.8) << errors[n - 1].distance << " " << errors[n].distance;
    EXPECT_GE(rateOfNormals, order + 0.8) << errors[n - 1].normal << " " << errors[n].normal;
  }
}

TEST_P(ByOrder, ConvergesOnASphereInCurvedElements)
{
  const KnownSurface known = sphere(glm::dvec3(0.0), 0.7);
  const ElementMesh mesh = curvedMesh(known.field);
  std::vector<Errors> errors;
  for (const int n : { 4, 8, 16 })
  {
    errors.push_back(errorsOf({ &mesh, 0.0, 1e-13 }, octasphere(0.7, n), this->GetParam(), known,
      [](const glm::dvec3& x) { return 0.7 * glm::normalize(x); }));
  }
  expectOrder(this->GetParam(), errors);
}

TEST_P(ByOrder, ConvergesOnATorusInCurvedElements)
{
  const KnownSurface known = torus(0.6, 0.25);
  const ElementMesh mesh = curvedMesh(known.field);
  const auto nearest = [](const glm::dvec3& x)
  {
    const glm::dvec3 core = 0.6 * glm::normalize(glm::dvec3(x.x, x.y, 0.0));
    return core + 0.25 * glm::normalize(x - core);
  };
  std::vector<Errors> errors;
  for (const int n : { 8, 16, 32 })
  {
    errors.push_back(errorsOf(
      { &mesh, 0.0, 1e-13 }, torusMesh(0.6, 0.25, 2 * n, n), this->GetParam(), known, nearest));
  }
  expectOrder(this->GetParam(), errors);
}

TEST_P(ByOrder, SharesTheNodesOfEdges)
{
  const KnownSurface known = sphere(glm::dvec3(0.0), 0.7);
  const ElementMesh mesh = curvedMesh(known.field);
  const PointMesh points = octasphere(0.7, 3);
  Buffer<Particle> particles = particlesAt({ &mesh, 0.0, 1e-12 }, points.points);
  const std::size_t corners = particles.size();
  const int order = this->GetParam();
  const CurvedTriangles bent = bendTriangles(
    { &mesh, 0.0, 1e-12 }, points.triangles, ownVertices(corners), order, particles, {});
  const std::size_t count = CurvedTriangles::nodeCount(order);
  ASSERT_EQ(bent.nodes.size(), count * points.triangles.size());
  // A closed mesh: each edge has two triangles, which pass its nodes in opposite directions.
  std::map<std::vector<int>, int> uses;
  for (std::size_t t = 0; t < points.triangles.size(); ++t)
  {
    const int* nodes = bent.nodes.data() + t * count;
    for (int e = 0; e < 3; ++e)
    {
      std::vector<int> edge{ nodes[e] };
      edge.insert(edge.end(), nodes + 3 + e * (order - 1), nodes + 3 + (e + 1) * (order - 1));
      edge.push_back(nodes[(e + 1) % 3]);
      ++uses[edge];
    }
  }
  EXPECT_EQ(uses.size(), 3 * points.triangles.size());
  for (const auto& [edge, number] : uses)
  {
    EXPECT_EQ(number, 1);
    EXPECT_EQ(uses.count({ edge.rbegin(), edge.rend() }), 1u);
  }
  EXPECT_EQ(std::set<int>(bent.nodes.begin(), bent.nodes.end()).size(), particles.size());
}

TEST(CurvedTriangles, KeepsEdgesOnBoundaryCurves)
{
  // A sphere that leaves the cube through x = 1: its boundary curve is a circle in this face.
  const KnownSurface known = sphere({ 0.6, 0.0, 0.0 }, 0.7);
  MeshRecipe recipe;
  recipe.cells = 3;
  recipe.field = known.field;
  const ElementMesh mesh = makeMesh(recipe);
  const Isosurface surface{ &mesh, 0.0, 1e-12 };
  PointMesh cap;
  const double radius = std::sqrt(0.49 - 0.16);
  constexpr int count = 12;
  for (int ring = 0; ring < 2; ++ring)
  {
    for (int i = 0; i < count; ++i)
    {
      const double angle = 2.0 * std::acos(-1.0) * (i + 0.5 * ring) / count;
      const glm::dvec3 outer(1.0, radius * std::cos(angle), radius * std::sin(angle));
      const glm::dvec3 centre(0.6, 0.0, 0.0);
      const glm::dvec3 inner =
        centre + 0.7 * glm::normalize(outer - centre - glm::dvec3(0.3, 0, 0));
      cap.points.push_back(ring == 0 ? outer : inner);
      const int next = (i + 1) % count;
      if (ring == 0)
      {
        cap.triangles.push_back({ i, next, count + i });
        cap.triangles.push_back({ next, count + next, count + i });
      }
    }
  }
  for (int order = 2; order <= 4; ++order)
  {
    Buffer<Particle> particles = particlesAt(surface, cap.points);
    const CurvedTriangles bent =
      bendTriangles(surface, cap.triangles, ownVertices(cap.points.size()), order, particles, {});
    EXPECT_EQ(bent.straightNodes, 0);
    const std::size_t nodes = CurvedTriangles::nodeCount(order);
    for (std::size_t t = 0; t < cap.triangles.size(); t += 2)
    {
      for (int i = 0; i < order - 1; ++i)
      {
        const glm::dvec3 x = particles[bent.nodes[t * nodes + 3 + i]].position.xyz;
        EXPECT_NEAR(x.x, 1.0, 1e-11);
        EXPECT_NEAR(std::hypot(x.y, x.z), radius, 1e-9);
        const double angle =
          2.0 * std::acos(-1.0) * (static_cast<double>(t) / 2.0 + (i + 1.0) / order) / count;
        EXPECT_NEAR(std::remainder(std::atan2(x.z, x.y) - angle, 2.0 * std::acos(-1.0)), 0.0, 5e-3);
      }
    }
  }
}

TEST(CurvedTriangles, MeetInCreases)
{
  // |x| + z = 0.5 has a crease of 90 degrees in the faces at x = 0, two straight elements wide.
  MeshRecipe recipe;
  recipe.cells = 2;
  recipe.field = [](const glm::dvec3& x) { return 0.5 - std::abs(x.x) - x.z - 0.2 * x.y * x.y; };
  const ElementMesh mesh = makeMesh(recipe);
  const Isosurface surface{ &mesh, 0.0, 1e-13 };
  const auto height = [](double x, double y) { return 0.5 - std::abs(x) - 0.2 * y * y; };
  PointMesh roof;
  for (const double y : { -0.8, 0.3 })
  {
    for (const double x : { -0.4, -1e-13, 1e-13, 0.4 })
    {
      roof.points.emplace_back(x, y, height(x, y));
    }
  }
  roof.triangles = { { 0, 1, 5 }, { 0, 5, 4 }, { 2, 3, 7 }, { 2, 7, 6 } };
  Buffer<Particle> particles = particlesAt(surface, roof.points);
  std::vector<int> vertices = ownVertices(particles.size());
  vertices[2] = 1;
  vertices[6] = 5;
  const CurvedTriangles bent = bendTriangles(surface, roof.triangles, vertices, 3, particles, {});
  EXPECT_EQ(bent.straightNodes, 0);
  const std::size_t nodes = CurvedTriangles::nodeCount(3);
  // Edge 12 of the first triangle and edge 20 of the last are the crease.
  for (int i = 0; i < 2; ++i)
  {
    const int node = bent.nodes[5 + i];
    EXPECT_EQ(node, bent.nodes[3 * nodes + 8 - i]);
    const Particle& particle = particles[node];
    EXPECT_NEAR(particle.position.xyz.x, 0.0, 1e-12);
    EXPECT_NEAR(particle.position.xyz.z, height(0.0, particle.position.xyz.y), 1e-12);
    EXPECT_NEAR(particle.normal.xyz.x, 0.0, 1e-6);
    EXPECT_NEAR(length(particle.normal), 1.0, 1e-12);
  }
}

TEST(CurvedTriangles, AreTheSameForAnyNumberOfThreads)
{
  const KnownSurface known = sphere(glm::dvec3(0.0), 0.7);
  const ElementMesh mesh = curvedMesh(known.field);
  const PointMesh points = octasphere(0.7, 6);
  const Isosurface surface{ &mesh, 0.0, 1e-12 };
  const Buffer<Particle> corners = particlesAt(surface, points.points);
  const auto bend = [&](const ParallelFor& parallelFor)
  {
    Buffer<Particle> particles = corners;
    const CurvedTriangles bent = bendTriangles(
      surface, points.triangles, ownVertices(corners.size()), 3, particles, parallelFor);
    std::vector<double> numbers(bent.nodes.begin(), bent.nodes.end());
    for (const Particle& particle : particles)
    {
      numbers.insert(numbers.end(), &particle.position.xyz.x, &particle.position.xyz.x + 3);
    }
    return numbers;
  };
  EXPECT_EQ(bend({}), bend(threadedFor(3)));
}

TEST(CurvedTriangles, LeavesNodesStraightWhereThereIsNoSurface)
{
  // Corners on two sheets: the line between them meets neither.
  MeshRecipe recipe;
  recipe.cells = 1;
  recipe.field = [](const glm::dvec3& x) { return x.x * x.x - 0.25; };
  const ElementMesh mesh = makeMesh(recipe);
  const Isosurface surface{ &mesh, 0.0, 1e-12 };
  Buffer<Particle> particles =
    particlesAt(surface, { { 0.5, 0.0, 0.0 }, { 0.5, 0.3, 0.0 }, { -0.5, 0.0, 0.2 } });
  const CurvedTriangles bent =
    bendTriangles(surface, { { 0, 1, 2 } }, { 0, 1, 2 }, 2, particles, {});
  EXPECT_EQ(bent.straightNodes, 2);
  for (const Particle& particle : particles)
  {
    EXPECT_TRUE(std::isfinite(particle.position.xyz.x));
    EXPECT_TRUE(std::isfinite(length(particle.normal)));
    EXPECT_TRUE(std::isfinite(particle.residual));
  }
  // The field stands still there.
  EXPECT_NEAR(particles[bent.nodes[4]].position.xyz.x, 0.0, 1e-12);
  EXPECT_GE(particles[bent.nodes[4]].residual, 0.5);
}

} // namespace
} // namespace hop::testing
