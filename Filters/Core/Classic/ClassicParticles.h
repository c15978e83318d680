#pragma once

#include "Isolation/SurfaceBox.h"
#include "Support/PointBins.h"
#include "Support/Random.h"
#include "Surface/SizingFunction.h"
#include "Surface/SurfaceWalker.h"

#include <cstdint>
#include <vector>

namespace hop
{

/// A particle of the paper's scheme, while it moves.
struct ClassicParticle
{
  /// Step lengths lambda in units of h^2; the paper divides and multiplies them by ten. In hexagonal packing the second
  /// derivative of the energy along the surface is about 4.5/h^2, so that a Newton step has lambda = 0.22.
  static constexpr double InitialLambda = 0.2;
  /// The step length of a particle whose energy no try has lowered: it stays where it is. Chosen by experiment: a
  /// ten-thousandth of h a unit of force.
  static constexpr double SmallestLambda = 1e-4;

  Evaluated at;
  WorldVector normal;
  /// Curvature magnitude, 1/world units; zero where the spacing does not depend on it.
  double curvature = 0.0;
  double lambda = InitialLambda;
  /// Energy of hexagonal packing around it; less on a boundary curve, where neighbours are missing.
  double ideal = 0.0;
  double energy = 0.0;

  const WorldPoint& position() const { return this->at.point.map.position; }
};

/// The particles of the paper's scheme. While they move they stay on the surface.
class ClassicParticles
{
public:
  ClassicParticles(
    const Isosurface& surface, const SizingFunction& sizing, ParallelFor parallelFor);

  /// At the present level.
  SizingFunction sizing;
  std::vector<ClassicParticle> movers;
  /// The particles near each particle, as of the last renewNeighbors().
  NeighborLists neighbors;

  /// Random places in the elements, projected onto the surface; fewer than `count` where Newton's method fails.
  /// \param farthest way to the surface, world units
  std::vector<ClassicParticle> randomSeeds(int count, double farthest, Random& random);

  /// A particle for every box from which Newton's method finds the surface.
  std::vector<ClassicParticle> seedsOf(const std::vector<SurfaceBox>& boxes);

  /// Adds each seed that has no particle of the same orientation within its spacing.
  void addUncovered(const std::vector<ClassicParticle>& seeds);

  /// Adds a particle at a distance from another, in a direction (radians) of its tangent plane.
  /// \return false if it could not be put on the surface
  bool addBeside(const ClassicParticle& parent, double distance, double angle);

  /// Moves a particle by a step in world space, and back to the surface.
  /// \param to the particle there
  /// \return false if that failed, ended more than `farthest` from the start, or on a sheet that is turned away
  bool displace(
    const ClassicParticle& from, const WorldVector& step, double farthest, ClassicParticle& to);

  void renewNeighbors();

  /// r of eq. (6).
  double scaledDistance(const ClassicParticle& a, const ClassicParticle& b) const;

  std::int64_t evaluations() const { return this->SeedCost + this->Walker.evaluations(); }
  /// Number of particles given up because they could not be put on the surface.
  std::int64_t rejected() const { return this->Rejected; }

private:
  bool place(const Location& start, double maximumTravel, SurfaceWalker& walker,
    ClassicParticle& mover) const;
  bool seed(
    const SurfaceBox& box, SurfaceWalker& walker, ClassicParticle& mover, std::int64_t& cost) const;

  ParallelFor Parallel;
  Isosurface Surface;
  SurfaceWalker Walker;
  std::int64_t SeedCost = 0;
  std::int64_t Rejected = 0;
};

/// A unit vector at right angles to another.
glm::dvec3 orthogonalTo(const glm::dvec3& n);

} // namespace hop
