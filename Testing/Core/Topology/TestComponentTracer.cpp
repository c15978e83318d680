#include "Topology/ComponentTracer.h"

#include "AnalyticFields.h"
#include "Topology/SurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

ElementMesh meshOf(const Field& field, Domain domain)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { 4, 4, 4 };
  recipe.field = field;
  return makeMesh(recipe);
}

/// All pieces of the surface, by component, as findTopology() has them; components with a boundary are left out.
std::vector<std::vector<PieceNumber>> closedComponents(const ElementMesh& mesh)
{
  const SurfaceTopology topology = findTopology(mesh, 0.0, nullptr, {});
  std::vector<std::vector<PieceNumber>> pieces(topology.components.size());
  for (std::size_t e = 0; e < topology.componentOfPiece.size(); ++e)
  {
    for (std::size_t piece = 0; piece < topology.componentOfPiece[e].size(); ++piece)
    {
      const int component = topology.componentOfPiece[e][piece];
      EXPECT_TRUE(topology.components[component].proven);
      if (topology.components[component].boundaryLoops == 0)
      {
        pieces[component].push_back({ static_cast<int>(e), static_cast<int>(piece) });
      }
    }
  }
  return pieces;
}

class ComponentTracing : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(Topology, ComponentTracing,
  ::testing::Values(Domain::Hexahedron, Domain::Wedge, Domain::Tetrahedron));

TEST_P(ComponentTracing, FindsThePiecesOfClosedComponents)
{
  const KnownSurface wall = plane({ 0.6, 0.8, 0.0 }, -0.7);
  const KnownSurface ball = sphere({ 0.31, 0.27, -0.1 }, 0.4);
  const KnownSurface other = sphere({ 0.7, -0.6, 0.6 }, 0.1);
  for (const Field& field :
    { bothOf(ball, wall).field, bothOf(ball, other).field, torus(0.6, 0.2).field })
  {
    const ElementMesh mesh = meshOf(field, this->GetParam());
    int closed = 0;
    for (std::vector<PieceNumber> pieces : closedComponents(mesh))
    {
      for (const PieceNumber& start : pieces)
      {
        ComponentTracer tracer(mesh, 0.0);
        std::vector<PieceNumber> found =
          tracer.closedComponent(start, [](const PieceNumber&) { return true; });
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, pieces);
      }
      closed += !pieces.empty();
    }
    EXPECT_GT(closed, 0);
  }
}

TEST_P(ComponentTracing, FindsNothingWhereTheSurfaceEnds)
{
  const ElementMesh mesh = meshOf(sphere({ 1.0, 0.1, 0.2 }, 0.3).field, this->GetParam());
  ComponentTracer tracer(mesh, 0.0);
  int pieces = 0;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
  {
    for (std::size_t piece = 0; piece < tracer.surfaceOf(e).pieces.size(); ++piece, ++pieces)
    {
      EXPECT_TRUE(
        tracer
          .closedComponent({ e, static_cast<int>(piece) }, [](const PieceNumber&) { return true; })
          .empty());
    }
  }
  EXPECT_GT(pieces, 0);
}

TEST(ComponentTracer, EndsWhenItIsTold)
{
  const ElementMesh mesh = meshOf(sphere({ 0.0, 0.0, 0.0 }, 0.5).field, Domain::Hexahedron);
  ComponentTracer tracer(mesh, 0.0);
  int seen = 0;
  EXPECT_TRUE(
    tracer.closedComponent({ 0, 0 }, [&](const PieceNumber&) { return ++seen < 3; }).empty());
  EXPECT_EQ(seen, 3);
}

TEST(ComponentTracer, PreparesWhatItWouldFind)
{
  const ElementMesh mesh = meshOf(torus(0.6, 0.2).field, Domain::Tetrahedron);
  ComponentTracer prepared(mesh, 0.0), plain(mesh, 0.0);
  std::vector<int> elements;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); e += 2)
  {
    elements.push_back(e);
  }
  prepared.prepare(elements);
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
  {
    EXPECT_EQ(prepared.surfaceOf(e).pieces.size(), plain.surfaceOf(e).pieces.size());
    EXPECT_EQ(prepared.surfaceOf(e).leaves.size(), plain.surfaceOf(e).leaves.size());
  }
}

} // namespace
} // namespace hop::testing
