#pragma once

#include "Edges/BoundaryCurves.h"
#include "Support/SpacedPoints.h"
#include "Support/SpacingGrid.h"

namespace hop
{

/// Cells per reach of the grids of this room: the size of SpacingGrid that suits visits around single points. Smaller
/// cells mean more look-ups, larger ones more points that are too far off; results are the same.
inline constexpr double CellsPerReach = 0.5;

/// Finished particles, to be found by place: first those that were free to move, then those on boundary curves. Where
/// they stand does not change any more.
class ParticleGrid
{
public:
  /// Splats of particles that are farther apart, in units of the harmonic mean of their spacings, do not overlap: twice
  /// splatReach(), 1.856. A larger one costs time only.
  static constexpr double Reach = 1.86;

  ParticleGrid(
    Buffer<Particle>& free, Buffer<BoundaryParticle>& onBoundary, const ParallelFor& parallelFor)
    : Free(free)
    , OnBoundary(onBoundary)
    , Points(
        free.size() + onBoundary.size(), [this](std::size_t i) { return this->at(i).position.xyz; },
        [this](std::size_t i) { return this->at(i).spacing; }, parallelFor)
    , Grid(this->Points.positions, this->Points.spacings, Reach, CellsPerReach, parallelFor)
  {
  }
  ParticleGrid(const ParticleGrid&) = delete;
  ParticleGrid& operator=(const ParticleGrid&) = delete;

  std::size_t size() const { return this->Points.positions.size(); }
  Buffer<BoundaryParticle>& boundaryParticles() const { return this->OnBoundary; }
  Particle& at(std::size_t i) const
  {
    const std::size_t free = this->Free.size();
    return i < free ? this->Free[i] : this->OnBoundary[i - free].particle;
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
  Buffer<Particle>& Free;
  Buffer<BoundaryParticle>& OnBoundary;
  SpacedPoints Points;
  SpacingGrid Grid;
};

} // namespace hop
