#include "Topology/TopologyComparison.h"

#include "AnalyticFields.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <map>

namespace hop::testing
{
namespace
{

struct TriangleMesh
{
  std::vector<glm::dvec3> points;
  std::vector<std::array<int, 3>> triangles;
};

/// An octahedron around a centre, its faces split `times` times, on a sphere. Splitting gives middles to sides.
TriangleMesh sphereMesh(const glm::dvec3& centre, double radius, int times)
{
  TriangleMesh mesh{ { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
                       { 0, 0, -1 } },
    { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 }, { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 },
      { 0, 3, 5 } } };
  for (; times > 0; --times)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b)
    {
      const auto [entry, isNew] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.points.size()));
      if (isNew)
      {
        mesh.points.push_back(glm::normalize(mesh.points[a] + mesh.points[b]));
      }
      return entry->second;
    };
    std::vector<std::array<int, 3>> smaller;
    for (const auto& [a, b, c] : mesh.triangles)
    {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      smaller.insert(
        smaller.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
    }
    mesh.triangles = smaller;
  }
  for (glm::dvec3& point : mesh.points)
  {
    point = centre + radius * point;
  }
  return mesh;
}

/// Two spheres in one straight hexahedron, 3e-3 of its size apart.
class TwoSpheres : public ::testing::Test
{
protected:
  TwoSpheres()
  {
    MeshRecipe recipe;
    recipe.degrees = { 4, 4, 4 };
    recipe.cells = 1;
    recipe.field = bothOf(sphere(this->Left, 0.4), sphere(this->Right, 0.4)).field;
    this->Surface = findTopology(makeMesh(recipe), 0.0, nullptr, {});
    this->append(sphereMesh(this->Left, 0.4, 3));
    this->append(sphereMesh(this->Right, 0.4, 3));
  }

  void append(const TriangleMesh& mesh)
  {
    const int first = static_cast<int>(this->Vertices.size());
    for (const glm::dvec3& point : mesh.points)
    {
      Particle particle;
      particle.location = { 0, { 0.5 * (point + 1.0) } };
      this->Vertices.push_back(particle);
    }
    for (const auto& [a, b, c] : mesh.triangles)
    {
      this->Triangles.push_back({ first + a, first + b, first + c });
    }
  }

  TopologyComparison compare() const
  {
    return compareTopology(this->Surface, this->Vertices, this->Triangles, {});
  }

  const glm::dvec3 Left{ -0.413, 0.02, 0.01 };
  const glm::dvec3 Right{ 0.393, 0.02, 0.01 };
  SurfaceTopology Surface;
  Buffer<Particle> Vertices;
  std::vector<std::array<int, 3>> Triangles;
};

TEST_F(TwoSpheres, AreProven)
{
  const TopologyComparison comparison = this->compare();
  EXPECT_TRUE(comparison.proven);
  EXPECT_TRUE(comparison.missingComponents.empty());
  ASSERT_EQ(comparison.meshComponents.size(), 2u);
  for (const ComponentComparison& mesh : comparison.meshComponents)
  {
    EXPECT_TRUE(mesh.proven && mesh.isManifold);
    EXPECT_EQ(mesh.eulerCharacteristic, 2);
    EXPECT_EQ(mesh.boundaryLoops, 0);
  }
  EXPECT_NE(comparison.meshComponents[0].component, comparison.meshComponents[1].component);
}

TEST_F(TwoSpheres, AHoleIsSeen)
{
  this->Triangles.pop_back();
  const TopologyComparison comparison = this->compare();
  EXPECT_FALSE(comparison.proven);
  EXPECT_TRUE(comparison.meshComponents[0].proven);
  EXPECT_FALSE(comparison.meshComponents[1].proven);
  EXPECT_EQ(comparison.meshComponents[1].eulerCharacteristic, 1);
  EXPECT_EQ(comparison.meshComponents[1].boundaryLoops, 1);
}

TEST_F(TwoSpheres, AMissingComponentIsSeen)
{
  this->Vertices.resize(this->Vertices.size() / 2);
  this->Triangles.resize(this->Triangles.size() / 2);
  const TopologyComparison comparison = this->compare();
  EXPECT_FALSE(comparison.proven);
  EXPECT_EQ(comparison.missingComponents.size(), 1u);
  EXPECT_TRUE(comparison.meshComponents[0].proven);
}

TEST_F(TwoSpheres, ABridgeIsSeen)
{
  // A triangle of each is taken away, and the two holes are joined by a tube.
  const std::array<int, 3> a = this->Triangles.front(), b = this->Triangles.back();
  this->Triangles.pop_back();
  this->Triangles.erase(this->Triangles.begin());
  for (int n = 0; n < 3; ++n)
  {
    const int next = (n + 1) % 3, m = (3 - n) % 3, before = (3 - next) % 3;
    this->Triangles.push_back({ a[n], a[next], b[m] });
    this->Triangles.push_back({ b[before], b[m], a[next] });
  }
  const TopologyComparison comparison = this->compare();
  EXPECT_FALSE(comparison.proven);
  ASSERT_EQ(comparison.meshComponents.size(), 1u);
  EXPECT_TRUE(comparison.meshComponents[0].isManifold);
  EXPECT_EQ(comparison.meshComponents[0].component, -1);
  EXPECT_EQ(comparison.meshComponents[0].eulerCharacteristic, 2);
}

TEST_F(TwoSpheres, WhatIsNoManifoldIsSeen)
{
  const auto breaks = [this](const std::array<int, 3>& triangle)
  {
    this->Triangles.push_back(triangle);
    const TopologyComparison comparison = this->compare();
    this->Triangles.pop_back();
    return !comparison.proven && !comparison.meshComponents[0].isManifold;
  };
  const std::array<int, 3> first = this->Triangles.front();
  EXPECT_TRUE(breaks(first));
  EXPECT_TRUE(breaks({ first[1], first[0], first[2] }));
  EXPECT_TRUE(breaks({ first[0], first[1], 30 }));
}

TEST_F(TwoSpheres, VerticesWithoutTrianglesDoNotCount)
{
  this->Vertices.insert(this->Vertices.begin(), this->Vertices.back());
  for (std::array<int, 3>& triangle : this->Triangles)
  {
    triangle = { triangle[0] + 1, triangle[1] + 1, triangle[2] + 1 };
  }
  this->Vertices.push_back(this->Vertices.back());
  const TopologyComparison comparison = this->compare();
  EXPECT_TRUE(comparison.proven);
  ASSERT_EQ(comparison.meshComponents.size(), 2u);
  EXPECT_EQ(comparison.meshComponents[0].vertex, 1);
}

TEST_F(TwoSpheres, StrayVerticesOfAnotherComponentAreSeen)
{
  // A lone triangle between the two spheres lies on neither.
  const int last = static_cast<int>(this->Vertices.size());
  this->Vertices.push_back(this->Vertices.front());
  this->Vertices.push_back(this->Vertices.front());
  this->Vertices.push_back(this->Vertices[last - 1]);
  this->Triangles.push_back({ last, last + 1, last + 2 });
  const TopologyComparison comparison = this->compare();
  ASSERT_EQ(comparison.meshComponents.size(), 3u);
  for (const ComponentComparison& mesh : comparison.meshComponents)
  {
    EXPECT_FALSE(mesh.proven);
  }
}

} // namespace
} // namespace hop::testing
