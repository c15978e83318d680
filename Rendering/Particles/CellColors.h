/**
 * @class CellColors
 * @brief how the values that colour particles go on within a cell, and whether they jump where it ends
 *
 * The values of particles of one cell have a gradient by least squares. Where splats of one cell alone are averaged,
 * which stand on one side of a border, the mean is right to first order only with gradients.
 */

#pragma once

#include "Particles/ParticleLocator.h"

#include <array>
#include <vector>

namespace hop
{
class CellColors
{
public:
  /** Particles in arrays like the ones of SplatParticles, which outlive the object. */
  struct Particles
  {
    const float* CentreRadius;
    const float* Normal;
    const float* Borders;
    vtkIdType Count;
  };

  /**
   * @param values one a particle, on a scale of 0 to 1, which outlive the object; a value that is no number counts for
   *   nothing
   */
  CellColors(const Particles& particles, const std::vector<float>& values);

  /**
   * Whether values jump where cells end, judged by some thousand borders: what both sides foretell for a place of the
   * border differs by much more than what two particles of one cell foretell. Kinks are no jumps.
   */
  bool JumpBetweenCells() const;

  /** Derivatives of all particles' values along tangent and bitangent of their disks (glsl/Disk.glsl), per radius. */
  std::vector<std::array<float, 2>> FitGradients() const;

private:
  using Vector2 = std::array<double, 2>;
  class Neighborhood;
  /** Sums of differences, and how many there are. */
  struct Differences
  {
    double Across = 0., Within = 0.;
    int Count = 0;
  };

  void Compare(Neighborhood& own, Neighborhood& other, vtkIdType particle, Differences& sums) const;

  const Particles Drawn;
  const std::vector<float>& Values;
  const ParticleLocator Locator;
};
}
