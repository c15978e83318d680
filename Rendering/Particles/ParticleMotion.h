/**
 * @class ParticleMotion
 * @brief how particles have been moved since they were computed
 *
 * ParaView's *Transform*, *Reflect* and others move points and turn their normals, but leave what no filter can know of:
 * radii, shape operators, clip planes. So particles carry where they were computed, in a form that no filter changes,
 * and the affine map from there to here says how all of it is to be carried along.
 *
 * A merged input may hold several sets, each moved in its own way. Points that moved by one map stand in one run, so
 * that the maps are found run by run.
 */

#pragma once

#include "vtkType.h"

#include <array>
#include <vector>

class vtkDataArray;
class vtkPoints;

namespace hop
{
/** An affine map without its translation, which changes nothing but positions. */
class LinearMap
{
public:
  using Matrix = std::array<std::array<double, 3>, 3>;

  /** @param matrix is not singular */
  explicit LinearMap(const Matrix& matrix);

  /** The image of a normal, of length 1: by the inverse transpose, so that it stays normal to the surface. */
  void CarryNormal(const double from[3], double to[3]) const;

  /** By how much lengths in the plane orthogonal to a unit vector grow at most. */
  double StretchAcross(const double normal[3]) const;

  /**
   * The shape operator (SplatParticles::Shape) of the image of the surface.
   * @param normal of the surface before the map, of length 1
   */
  void CarryShape(const double normal[3], float shape[8]) const;

  /**
   * A clip plane of a particle (normal and distance), and the curvature of its edge. A plane without normal stays so.
   */
  void CarryClip(const double normal[3], float plane[4], float& curvature) const;

private:
  Matrix Forward;
  Matrix InverseTranspose;
};

class ParticleMotion
{
public:
  /** @param placements 6 components: position and unit normal as computed. Without it nothing has moved. */
  ParticleMotion(vtkPoints* points, vtkDataArray* placements);

  /** Whether some points have been moved by something that is not one affine map for a whole run. */
  bool IsWarped() const { return this->Warped; }

  /** The map of a point; nullptr where it has not moved, or nobody knows how. */
  const LinearMap* Of(vtkIdType point) const;

private:
  struct Run
  {
    vtkIdType End; ///< points from the end of the run before
    LinearMap Map;
  };
  std::vector<Run> Runs;
  bool Warped = false;
};
}
