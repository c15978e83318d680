#pragma once

#include "Fast/PatchRelaxation.h"
#include "Isolation/SurfaceProxy.h"
#include "Surface/Anchor.h"

#include <atomic>
#include <functional>
#include <vector>

namespace hop
{

/// Particles on their way to an even spread. Particles that move are tied to the mesh by anchors. Particles on boundary
/// curves stay where they are, and come last among the patches.
class MovingParticles
{
public:
  /// \param proxy tells the spacing everywhere; outlives this, as the surface's mesh does
  /// \param boundaryPatches particles on boundary curves, which are fixed
  MovingParticles(const Isosurface& surface, const SurfaceProxy& proxy,
    Buffer<Patch> boundaryPatches, ParallelFor parallelFor);

  /// Number of particles that move.
  std::size_t count() const { return this->Anchors.size(); }
  /// Number of all particles, fixed ones on boundary curves included.
  std::size_t size() const { return this->Patches.size(); }
  const Buffer<Anchor>& anchors() const { return this->Anchors; }
  const Buffer<Patch>& patches() const { return this->Patches; }
  const Isosurface& surface() const { return this->Surface; }
  const SurfaceProxy& proxy() const { return this->Proxy; }
  std::int64_t evaluations() const { return this->Evaluations; }
  std::int64_t sweeps() const { return this->SweepCount; }

  /// Adds a particle for each place from which one Newton step leads to the surface; costs one evaluation a place.
  void add(const std::vector<Location>& places);
  /// The same for seeds; a seed near the sample of its box costs nothing.
  void add(const std::vector<SurfaceProxy::Seed>& seeds);
  /// Adds `count` seeds, as dense everywhere as the sizing function asks for.
  void draw(std::int64_t count, std::uint64_t randomSeed);
  /// Largest distance from the surface, in units of the spacing, at which the patches of the first round may be
  /// evaluated. Chosen by experiment. Larger: the first round moves particles on patches that are less exact; smaller:
  /// more seeds take a Newton step first, which costs an evaluation each.
  static constexpr float SeedOffset = 0.5f;
  /// Takes a Newton step with the particles that are farther from the surface than this, in units of the spacing.
  void approach(float farthest = SeedOffset);
  /// Adds particles whose patches are known.
  void add(const Buffer<Anchor>& anchors, const Buffer<Patch>& patches);
  /// Adds the particles that move of others, and what these cost.
  void append(const MovingParticles& others);
  /// Keeps the marked ones of the particles that move.
  /// \param kept one mark at least for each particle that moves
  void keep(const std::vector<char>& kept);

  /// Replaces the particles that are fixed.
  void replaceFixed(const Buffer<Patch>& patches);

  /// A round of relaxation: sweeps, insertion and deletion, and one evaluation a particle.
  /// \param reached called now and then with the share of the sweeps that is done
  void relax(const Sweeps& sweeps, const Balance& balance,
    const std::function<void(double share)>& reached = {});

  /// Moves particles by the displacements of a relaxation and back to the surface. One evaluation gives each a new
  /// patch there; a step that has to be halved costs more. Afterwards particles are sorted by element.
  /// \param displacements in the tangent planes of the patches, one for each particle that moves
  /// \param kept marks the particles that move; the others are dropped
  /// \param inserted number of particles at the end that are dropped if their step fails: they start where others stand
  void commit(
    const std::vector<glm::vec2>& displacements, std::vector<char> kept, std::size_t inserted = 0);

  /// Where one Newton step takes particle i. Costs evaluations only where the step leaves the element.
  Location onSurface(std::size_t i, std::int64_t& cost) const;
  /// Gives particle i a new anchor and patch, unless they are too far from the old ones.
  void renew(std::size_t i, const Location& place, const Jet& jet);
  /// Puts particle i on a place of the surface.
  void place(std::size_t i, const Location& location, const FieldPoint& point)
  {
    this->Patches[i].position = point.map.position.xyz;
    this->Patches[i].normal = glm::vec3(surfaceNormal(point.gradient).xyz);
    this->Anchors[i] = { location, glm::mat3(point.map.inverse), 0.0f };
  }

private:
  std::size_t makeRoom(std::size_t count);
  void arrange(const std::vector<int>& order);
  std::vector<char> anchorAt(const std::vector<int>& which, const std::vector<Location>& places);
  Location target(std::size_t i, const glm::dvec3& step, std::int64_t& cost) const;
  glm::dvec3 stepTo(std::size_t i, const glm::vec2& displacement) const;
  std::vector<Location> targets(
    const std::vector<int>& which, const std::vector<glm::vec2>& displacements);
  std::vector<char> step(
    const std::vector<int>& which, const std::vector<glm::vec2>& displacements);
  bool halveStep(
    std::size_t i, glm::dvec3 step, Anchor& anchor, Patch& patch, std::int64_t& cost) const;

  Isosurface Surface;
  const SurfaceProxy& Proxy;
  ParallelFor Parallel;
  Buffer<Anchor> Anchors;
  Buffer<Patch> Patches;
  // Memory for reordering.
  Buffer<Anchor> SpareAnchors;
  Buffer<Patch> SparePatches;
  std::atomic<std::int64_t> Evaluations{ 0 };
  std::int64_t SweepCount = 0;
};

} // namespace hop
