#pragma once

#include "Fast/MovingParticles.h"

#include "AnalyticFields.h"
#include "TestMeshes.h"
#include "ThreadedFor.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace hop::testing
{

/// Particles on their way over a sphere of radius 0.7 in a straight mesh that holds it exactly.
struct MovingOnSphere
{
  static constexpr double Radius = 0.7;
  static constexpr double Tolerance = 1e-9;

  explicit MovingOnSphere(const SizingFunction& sizingFunction = { 0.1, 0.0 })
    : sizing(sizingFunction)
    , mesh(makeSphereMesh())
    , surface{ &mesh, 0.0, Tolerance }
    , proxy(surface, sizing, findSurfaceBoxes(mesh, 0.0, sizing.spacing, {}), {})
  {
  }

  std::unique_ptr<MovingParticles> particles(const Buffer<Patch>& boundaryPatches = {}) const
  {
    return std::make_unique<MovingParticles>(
      this->surface, this->proxy, boundaryPatches, threadedFor(2));
  }

  /// As many as the sphere takes, or `count`, after two rounds of relaxation.
  std::unique_ptr<MovingParticles> relaxed(std::int64_t count = 0) const
  {
    auto moving = this->particles();
    moving->draw(count > 0 ? count : std::llround(this->proxy.particleCount()), 1);
    moving->approach();
    moving->relax({ 7 }, { Balance::Everywhere, 0.0 });
    moving->relax({ 13 }, {});
    return moving;
  }

  static ElementMesh makeSphereMesh()
  {
    MeshRecipe recipe;
    recipe.field = sphere({ 0, 0, 0 }, Radius).field;
    return makeMesh(recipe);
  }

  SizingFunction sizing;
  ElementMesh mesh;
  Isosurface surface;
  SurfaceProxy proxy;
};

/// Least distance between two particles, in units of the smaller of their spacings.
inline double leastDistance(const MovingParticles& moving)
{
  double least = 1e300;
  const Buffer<Patch>& patches = moving.patches();
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const double spacing = std::min(patches[i].spacing, patches[j].spacing);
      least = std::min(least, glm::distance(patches[i].position, patches[j].position) / spacing);
    }
  }
  return least;
}

/// Patches of all particles, fixed ones included, by position.
inline std::vector<glm::dvec3> positionsOf(const Buffer<Patch>& patches)
{
  std::vector<glm::dvec3> positions;
  for (const Patch& patch : patches)
  {
    positions.push_back(patch.position);
  }
  return positions;
}

} // namespace hop::testing
