/**
 * @struct SplatParticles
 * @brief  the particles of a polydata, ready for the GPU
 *
 * Positions are kept relative to the middle of the particles, so that float32 resolves details of
 * 1e-2 at coordinates of 1e6.
 *
 * One particle per point of a vertex cell, in the order of the cells; without vertex cells, one per
 * point. A particle that cannot be drawn (position or normal not finite, normal zero, radius not
 * positive) keeps its place with radius 0, so that particle numbers stay those of the cells.
 */

#pragma once

#include "vtkType.h"

#include <array>
#include <vector>

class vtkDataArray;
class vtkPointData;
class vtkPolyData;

namespace hop
{
/** The point arrays that particles are made of; those that are nullptr are missing. */
struct ParticleArrays
{
  vtkDataArray* Radii = nullptr;   ///< one a point, world units
  double FallbackRadius = 1.;      ///< of all particles without Radii
  vtkDataArray* Normals = nullptr; ///< any length but 0; without, normals stay (0, 0, 0)
  /**
   * Up to two planes a point that cut its splat off: 3 or 6 components of unit vectors to the side
   * that is cut off, (0, 0, 0) for no plane, and 1 or 2 distances of the planes from the point, along
   * those vectors, >= 0, world units.
   */
  vtkDataArray* ClipNormals = nullptr;
  vtkDataArray* ClipDistances = nullptr;
  /**
   * 1 or 2 angles by which the surface turns at these planes, degrees; 180 where it ends. The less it turns,
   * the farther beyond the plane a splat fills gaps that others leave, see OverlapAt(). Without angles splats
   * end at all planes.
   */
  vtkDataArray* ClipAngles = nullptr;
  /**
   * 1 or 2 curvatures (1 / world units) of the edges that touch these planes where they are nearest, along the
   * surface, towards the plane's vector. Without, edges are straight.
   */
  vtkDataArray* ClipCurvatures = nullptr;
  vtkDataArray* ShapeOperators = nullptr; ///< dn/dx, 6 components: xx, yy, zz, xy, yz, xz
  vtkDataArray* Isovalues = nullptr;      ///< one value a point that tells nested surfaces apart
  vtkDataArray* CellColors = nullptr;     ///< see vtkSurfaceSplatMapper::SetCellColorArrayName()

  /** Those with the names that vtkSurfaceSplatMapper lists, without radii and colours. */
  static ParticleArrays FromPointData(vtkPointData* data);
};

struct SplatParticles
{
  std::array<double, 3> Origin = { 0., 0., 0. };
  std::vector<float> CentreRadius; ///< 4 a particle: position - Origin, radius (world units)
  /**
   * 4 a particle: unit normal; 1 if its cell is translucent else 0, and twice the number of its isovalue more.
   */
  std::vector<float> Normal;
  /**
   * 12 a particle: normal and distance of two planes; how far beyond either the splat fills gaps, in radii;
   * by how much both edges are curved. Empty without planes.
   */
  std::vector<float> Clip;
  /**
   * 8 a particle: shape operator as xx, yy, zz, 0, xy, yz, xz, 0, fitted to the particles around
   * (Particles/FitShapes.h). Empty if the surface bends so little over a splat that flat disks do as
   * well.
   */
  std::vector<float> Shape;
  std::vector<vtkIdType> PointIds; ///< 1 a particle: the point it was made from
  std::vector<vtkIdType> CellIds;  ///< 1 a particle: its vertex cell; empty without vertex cells
  /**
   * One for each isovalue that ParticleArrays::Isovalues tells apart, at least one: all its particles are from
   * the first to before the second. Those of others may be among them.
   */
  std::vector<std::array<vtkIdType, 2>> IsovalueRanges;
  vtkIdType Skipped = 0; ///< particles that cannot be drawn

  /** More values than these, of which pixels hold the number in 7 bits, tell no isovalues apart. */
  static constexpr int MaximumNumberOfIsovalues = 128;

  vtkIdType GetNumberOfParticles() const { return static_cast<vtkIdType>(this->PointIds.size()); }

  /**
   * How far apart that many points are if they are spread evenly over the sides of a box, as hexagons; or
   * along it, if it is a line. 0 if it is a point.
   */
  static double EstimateDistance(const double bounds[6], vtkIdType count);

  /** OverlapAt() planes at which the surface is almost smooth. */
  static constexpr float SmoothOverlap = 0.35f;

  /** Planes with at least this overlap are such, for shaders too: far from all that OverlapAt() gives. */
  static constexpr float LeastSmoothOverlap = 0.25f;

  /**
   * How far, in radii, a splat fills gaps beyond a plane at which the surface turns by so many degrees.
   * SmoothOverlap below 10 degrees, where it is almost smooth: farther off splats stand out at outlines. At
   * kinks a little, for particles on both sides do not know the line between them exactly; the less the sharper
   * they are, and not at all from 90 degrees on, where splats would stick out.
   */
  static float OverlapAt(double degrees);

  /** Reads the particles of a polydata. */
  static SplatParticles FromPolyData(vtkPolyData* input, const ParticleArrays& arrays);
};
}
