#pragma once

#include "Support/Buffer.h"
#include "Surface/SurfaceWalker.h"

#include <array>
#include <string>
#include <vector>

namespace hop
{

/// A plane near a particle at which the surface ends or turns, touching that edge where it is nearest.
struct ClipPlane
{
  /// Unit normal, pointing to the far side; zero if there is no plane.
  WorldVector normal;
  /// World units, >= 0; more than that of the edge where others leave a corner between creases open.
  double distance = 0.0;
  /// By which the edge bends along the surface, towards the plane's normal, 1/radius; 0 where it is almost smooth.
  double bend = 0.0;
  /// By which the surface turns there, radians, see FaceJumps::dihedralAngles; pi where it ends.
  float dihedralAngle = 0.0f;
  /// Of the particle's element, at which the surface turns; -1 where it ends.
  int face = -1;

  bool exists() const { return dot(this->normal, this->normal) > 0.0; }
  bool isBoundary() const { return this->exists() && this->face < 0; }
};

/// One particle of a finished distribution.
struct Particle
{
  Location location;
  WorldPoint position;
  /// Unit normal -grad F/|grad F|.
  WorldVector normal;
  Curvature curvature;
  /// |F - c|/|grad F|, world units.
  double residual = 0.0;
  /// h, the distance to neighbours that this particle wants, world units.
  double spacing = 0.0;
  /// In corners there are two. Boundary curves and creases first, then the nearer.
  std::array<ClipPlane, 2> clips;
  /// On a boundary curve where the field jumps between elements: F - c on the other side. Zero elsewhere.
  double jump = 0.0;
  /// Of the splat's radius to the spacing: less than 1 where it stands alone on a piece of the surface smaller
  /// than that.
  double shrink = 1.0;

  /// Largest D h that particles can follow; beyond it the surface bends faster.
  static constexpr double LargestBend = 2.0;
  bool isUndersampled() const { return this->curvature.magnitude * this->spacing > LargestBend; }
};

/// What a distribution cost and what it found.
struct DistributionReport
{
  std::int64_t evaluations = 0;
  std::int64_t iterations = 0;
  /// Boxes in which the surface may be (SurfaceBoxes.h), and those of them that are not certified to
  /// hold one sheet.
  std::int64_t boxes = 0;
  std::int64_t boxesUndecided = 0;
  /// Input cells with undecided boxes, ascending, each once.
  std::vector<std::int64_t> undecidedCells;
  /// Points near undecided boxes where the gradient vanishes on the surface: cones, isolated points,
  /// crossings.
  std::int64_t singularPoints = 0;
  /// Particles given up because they could not be put on the surface again.
  std::int64_t particlesRejected = 0;
  /// See Particle::isUndersampled().
  std::int64_t particlesUndersampled = 0;
  bool converged = true;
  bool aborted = false;
  /// Why nothing was computed; empty if all is well.
  std::string error;
};

struct Distribution
{
  Buffer<Particle> particles;
  DistributionReport report;
};

} // namespace hop
