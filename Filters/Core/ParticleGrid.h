#pragma once

#include "RimCurves.h"
#include "SpacingGrid.h"

#include <optional>

namespace hop
{

/// Where finished particles stand, those that moved before those on rims, to be found by place.
class ParticleGrid
{
public:
  /// Splats of particles that are farther apart, in units of the harmonic mean of their spacings, do not overlap.
  static constexpr double Reach = 1.85;

  ParticleGrid(const Buffer<Particle>& particles, const Buffer<RimParticle>& rims,
    const ParallelFor& parallelFor)
    : Positions(particles.size() + rims.size())
    , Spacings(this->Positions.size())
  {
    forAll(parallelFor, this->Positions.size(),
      [&](std::size_t i)
      {
        const Particle& particle =
          i < particles.size() ? particles[i] : rims[i - particles.size()].particle;
        this->Positions[i] = particle.position.xyz;
        this->Spacings[i] = static_cast<float>(particle.spacing);
      });
    this->Grid.emplace(this->Positions, this->Spacings, Reach, 0.5, parallelFor);
  }
  ParticleGrid(const ParticleGrid&) = delete;
  ParticleGrid& operator=(const ParticleGrid&) = delete;

  const glm::dvec3& position(int i) const { return this->Positions[i]; }
  float spacing(int i) const { return this->Spacings[i]; }

  /// See SpacingGrid::visit.
  template <class Use>
  void visit(const glm::dvec3& position, double spacing, const Use& use) const
  {
    this->Grid->visit(position, spacing, use);
  }

private:
  Buffer<glm::dvec3> Positions;
  Buffer<float> Spacings;
  std::optional<SpacingGrid> Grid;
};

} // namespace hop
