#pragma once

#include "SurfaceWalker.h"

#include <string>

namespace hop
{

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
};

/// What a distribution cost and what it found.
struct DistributionReport
{
  std::int64_t evaluations = 0;
  std::int64_t iterations = 0;
  /// Boxes that hold the surface, and those from whose middle no point of it was reached.
  std::int64_t boxes = 0;
  std::int64_t boxesWithoutSeed = 0;
  /// Particles given up because they could not be put on the surface again.
  std::int64_t particlesRejected = 0;
  /// Particles with D h > 2: the surface bends faster than their spacing can follow.
  std::int64_t particlesUndersampled = 0;
  bool converged = true;
  bool aborted = false;
  /// Why nothing was computed; empty if all is well.
  std::string error;
};

struct Distribution
{
  std::vector<Particle> particles;
  DistributionReport report;
};

} // namespace hop
