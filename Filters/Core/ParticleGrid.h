#pragma once

#include "RimCurves.h"
#include "SpacingGrid.h"

#include <optional>

namespace hop
{

/// Finished particles, those that moved before those on rims, to be found by place: where they stand does not
/// change any more.
class ParticleGrid
{
public:
  /// Splats of particles that are farther apart, in units of the harmonic mean of their spacings, do not overlap.
  static constexpr double Reach = 1.85;

  ParticleGrid(
    Buffer<Particle>& particles, Buffer<RimParticle>& rims, const ParallelFor& parallelFor)
    : Particles(particles)
    , Rims(rims)
    , Positions(particles.size() + rims.size())
    , Spacings(this->Positions.size())
  {
    forAll(parallelFor, this->Positions.size(),
      [&](std::size_t i)
      {
        const Particle& particle = this->at(i);
        this->Positions[i] = particle.position.xyz;
        this->Spacings[i] = static_cast<float>(particle.spacing);
      });
    this->Grid.emplace(this->Positions, this->Spacings, Reach, 0.5, parallelFor);
  }
  ParticleGrid(const ParticleGrid&) = delete;
  ParticleGrid& operator=(const ParticleGrid&) = delete;

  std::size_t size() const { return this->Positions.size(); }
  Buffer<RimParticle>& rims() const { return this->Rims; }
  Particle& at(std::size_t i) const
  {
    const std::size_t free = this->Particles.size();
    return i < free ? this->Particles[i] : this->Rims[i - free].particle;
  }
  const glm::dvec3& position(int i) const { return this->Positions[i]; }
  float spacing(int i) const { return this->Spacings[i]; }

  /// See SpacingGrid::visit.
  template <class Use>
  void visit(const glm::dvec3& position, double spacing, const Use& use) const
  {
    this->Grid->visit(position, spacing, use);
  }

private:
  Buffer<Particle>& Particles;
  Buffer<RimParticle>& Rims;
  Buffer<glm::dvec3> Positions;
  Buffer<float> Spacings;
  std::optional<SpacingGrid> Grid;
};

} // namespace hop
