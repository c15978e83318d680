#pragma once

#include "Fast/PatchRelaxation.h"
#include "Isolation/SurfaceProxy.h"
#include "Surface/Anchor.h"

#include <atomic>
#include <functional>
#include <vector>

namespace hop
{

/// Particles on their way to an even spread. Those that move are tied to the mesh by anchors; those on boundary curves
/// stay where they are, and come last among the patches.
class MovingParticles
{
public:
  /// \param proxy says which spacing is wanted where; outlives this, as the surface's mesh does
  /// \param boundary curves patches that are fixed
  MovingParticles(const Isosurface& surface, const SurfaceProxy& proxy, Buffer<Patch> boundaries,
    ParallelFor parallelFor);

  /// How many move.
  std::size_t count() const { return this->Anchors.size(); }
  /// How many there are in all.
  std::size_t size() const { return this->Patches.size(); }
  const Buffer<Anchor>& anchors() const { return this->Anchors; }
  const Buffer<Patch>& patches() const { return this->Patches; }
  const Isosurface& surface() const { return this->Surface; }
  const SurfaceProxy& proxy() const { return this->Proxy; }
  std::int64_t evaluations() const { return this->Evaluations; }
  std::int64_t sweeps() const { return this->SweepCount; }

  /// Adds a particle for each place from which one Newton step leads to the surface; one evaluation each.
  void add(const std::vector<Location>& places);
  /// The same for seeds; those near samples cost nothing.
  void add(const std::vector<SurfaceProxy::Seed>& seeds);
  /// Adds so many seeds in all, everywhere as dense as wanted.
  void draw(std::int64_t count, std::uint64_t randomSeed);
  /// The first round may start from patches that were evaluated that far from the surface, in units of the
  /// spacing.
  static constexpr float SeedOffset = 0.5f;
  /// Takes a Newton step with those that are farther from the surface than that, in units of the spacing.
  void approach(float farthest = SeedOffset);
  /// Adds particles whose patches are known.
  void add(const Buffer<Anchor>& anchors, const Buffer<Patch>& patches);
  /// Adds those that move of others, and what they cost.
  void join(const MovingParticles& others);
  /// Keeps those marked, of those that move.
  /// \param kept one for each of them at least
  void keep(const std::vector<char>& kept);

  /// Sweeps, what they tell about the number of particles, and one evaluation each.
  /// \param reached told now and then which share of the sweeps is done
  void relax(const Sweeps& sweeps, const Balance& balance,
    const std::function<void(double share)>& reached = {});

  /// Takes particles to where relaxation wants them, and to the surface; one evaluation each gives them
  /// new patches there, more where half a step has to do. Afterwards they are sorted by element.
  /// \param displacements in the tangent planes of the patches, one for each that moves
  /// \param kept marks of those that move; others are dropped instead
  /// \param inserted the last so many of those kept are dropped where they do not get there in one step:
  ///   they stand where others do
  void commit(
    const std::vector<glm::vec2>& displacements, std::vector<char> kept, std::size_t inserted = 0);

  /// Where one Newton step takes particle i. Costs evaluations only where it leaves its element.
  Location onSurface(std::size_t i, std::int64_t& cost) const;
  /// Gives particle i a new anchor and patch, unless they are too far from those before.
  void renew(std::size_t i, const Location& place, const Jet& jet);
  /// Puts particle i where it was found to lie.
  void settle(std::size_t i, const Location& place, const FieldPoint& point)
  {
    this->Patches[i].position = point.map.position.xyz;
    this->Patches[i].normal = glm::vec3(surfaceNormal(point.gradient).xyz);
    this->Anchors[i] = { place, glm::mat3(point.map.inverse), 0.0f };
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
  bool retry(
    std::size_t i, glm::dvec3 step, Anchor& anchor, Patch& patch, std::int64_t& cost) const;

  Isosurface Surface;
  const SurfaceProxy& Proxy;
  ParallelFor Parallel;
  Buffer<Anchor> Anchors;
  Buffer<Patch> Patches;
  // Where they are put in another order.
  Buffer<Anchor> SpareAnchors;
  Buffer<Patch> SparePatches;
  std::atomic<std::int64_t> Evaluations{ 0 };
  std::int64_t SweepCount = 0;
};

} // namespace hop
