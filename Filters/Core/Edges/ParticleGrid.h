#pragma once

#include "Edges/BoundaryCurves.h"
#include "Support/SpacedPoints.h"
#include "Support/SpacingGrid.h"

namespace hop
{

/// Finished particles, those that moved before those on boundary curves, to be found by place: where they stand does not
/// change any more.
class ParticleGrid
{
public:
  /// Splats of particles that are farther apart, in units of the harmonic mean of their spacings, do not overlap.
  static constexpr double Reach = 1.85;

  ParticleGrid(Buffer<Particle>& particles, Buffer<BoundaryParticle>& boundaries,
    const ParallelFor& parallelFor)
    : Particles(particles)
    , Boundaries(boundaries)
    , Points(
        particles.size() + boundaries.size(),
        [this](std::size_t i) { return this->at(i).position.xyz; },
        [this](std::size_t i) { return this->at(i).spacing; }, parallelFor)
    , Grid(this->Points.positions, this->Points.spacings, Reach, 0.5, parallelFor)
  {
  }
  ParticleGrid(const ParticleGrid&) = delete;
  ParticleGrid& operator=(const ParticleGrid&) = delete;

  std::size_t size() const { return this->Points.positions.size(); }
  Buffer<BoundaryParticle>& boundaries() const { return this->Boundaries; }
  Particle& at(std::size_t i) const
  {
    const std::size_t free = this->Particles.size();
    return i < free ? this->Particles[i] : this->Boundaries[i - free].particle;
  }
  const glm::dvec3& position(int i) const { return this->Points.positions[i]; }
  float spacing(int i) const { return this->Points.spacings[i]; }

  /// See SpacingGrid::visit.
  template <class Use>
  void visit(const glm::dvec3& position, double spacing, const Use& use) const
  {
    this->Grid.visit(position, spacing, use);
  }

private:
  Buffer<Particle>& Particles;
  Buffer<BoundaryParticle>& Boundaries;
  SpacedPoints Points;
  SpacingGrid Grid;
};

} // namespace hop
