/**
 * @struct SplatParticles
 * @brief  the particles of a polydata, ready for the GPU
 *
 * Positions are kept relative to the middle of the particles, so that float32 resolves details of
 * 1e-2 at coordinates of 1e6.
 *
 * There is one particle per point of a vertex cell, in the order of the cells; without vertex cells there is one per
 * point. A particle that cannot be drawn (position, normal or radius not finite in float32, normal zero, radius not
 * positive, a point that is not there) keeps its place with radius 0, so that the numbers of particles stay the numbers
 * of the cells.
 */

#pragma once

#include "Common/SplatProfile.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <vector>

class vtkDataArray;
class vtkPointData;
class vtkPolyData;

namespace hop
{
/** The point arrays that particles are made of. An array that is missing is nullptr. */
struct ParticleArrays
{
  vtkDataArray* Radii = nullptr;   ///< one a point, world units
  double FallbackRadius = 1.;      ///< radius of all particles if there are no Radii, world units
  vtkDataArray* Normals = nullptr; ///< of any length but 0; without them normals stay (0, 0, 0)

  ///@{
  /**
   * Up to three planes a point that cut its splat off. ClipNormals has 3 components a plane: unit vectors to the side
   * that is cut off, (0, 0, 0) for no plane. ClipDistances has 1 a plane: distance of the plane from the point along
   * its vector, >= 0, world units. A third plane comes after two others.
   */
  vtkDataArray* ClipNormals = nullptr;
  vtkDataArray* ClipDistances = nullptr;
  ///@}

  /**
   * Dihedral angles, 1 a plane, of the surface at the planes, in degrees: the angle between the normals of its two sides, 0
   * where it is smooth, 180 at a boundary curve, 0 at a crease behind which no particle stands. The smaller the angle, the farther beyond the plane a splat fills gaps
   * that others leave, see OverlapAt(). Without angles splats end at all planes.
   */
  vtkDataArray* ClipAngles = nullptr;

  /**
   * Curvatures, 1 a plane (1 / world units), within the surface, of the creases or boundary curves that the planes touch
   * where they are nearest. Positive ones bend towards the plane's vector. Without curvatures the curves are straight.
   */
  vtkDataArray* ClipCurvatures = nullptr;

  /**
   * Where the cell of each point ends on the surface, 4 to 16 components: for each border the vector from the point to
   * the border's nearest place, along the tangent plane, (0, 0, 0) for no border; and the border's curvature, positive
   * where it bends along the vector.
   */
  vtkDataArray* CellBorders = nullptr;

  vtkDataArray* ShapeOperators =
    nullptr; ///< dn/dx, 1 / world units; 6 components: xx, yy, zz, xy, yz, xz
  /**
   * 6 a point: position and unit normal as they were when all other arrays were computed. Particles that one affine map
   * has moved since then take the other arrays along. Without it they have not moved.
   */
  vtkDataArray* Placements = nullptr;
  vtkDataArray* Isovalues =
    nullptr; ///< one a point; particles of different values are not averaged
  vtkDataArray* CellColors = nullptr; ///< see vtkSurfaceSplatMapper::SetCellColorArrayName()
  vtkDataArray* Ghosts =
    nullptr; ///< vtkGhostType of points: duplicate ones are ghosts, hidden ones not drawn

  /**
   * Normals of the side of a crease of which clip planes and shape operators are, which count instead of Normals;
   * (0, 0, 0) at points on no crease.
   */
  vtkDataArray* SideNormals = nullptr;
  vtkDataArray* Creases = nullptr; ///< both sides of creases, see Common/SplatColumns.h

  /** Arrays made of columns, see Common/SplatColumns.h. */
  std::vector<vtkSmartPointer<vtkDataArray>> Columns;

  /** The arrays with the names that vtkSurfaceSplatMapper lists, without radii and colours. */
  static ParticleArrays FromPointData(vtkPointData* data, vtkIdType points);

  /** The array, or nullptr if it has fewer rows than it needs: nobody knows what the missing ones would say. */
  static vtkDataArray* IfComplete(vtkDataArray* array, vtkIdType rows);
};

struct SplatParticles
{
  std::array<double, 3> Origin = { 0., 0., 0. };
  std::vector<float> CentreRadius; ///< 4 a particle: position - Origin, radius (world units)
  /**
   * 4 a particle: unit normal, tag. The tag is twice the number of the particle's isovalue, plus 1 if its cell is
   * translucent, plus LayerMark where MarkLayers() says so, plus GhostMark for ghosts. Isovalues are numbered from 0 on, the smallest first.
   */
  std::vector<float> Normal;
  bool HasLayers = false; ///< whether a particle has LayerMark
  /** A share of 1, so that tags are still whole numbers after rounding down. */
  static constexpr float LayerMark = 0.5f;
  bool HasGhosts =
    false; ///< whether a particle has GhostMark: it is blended with others, which is all
  static constexpr float GhostMark = 0.25f; ///< as LayerMark
  /**
   * ClipStride a particle: normal and distance of one plane, the same of another; two overlaps in radii, see
   * OverlapAt(); two curvatures, see ParticleArrays::ClipCurvatures. If any particle has a third plane: its normal and
   * distance, its overlap, 0, its curvature, 0. Empty without planes.
   */
  std::vector<float> Clip;
  int ClipStride = 0; ///< 0 without planes, 12 with two a particle, 20 with three

  /** Number of planes of a particle with this stride. */
  static int ClipPlanesIn(int stride) { return (stride + 4) / 8; }
  /** Place of a plane among the numbers of its particle. */
  static int PlaneAt(int plane) { return plane < 2 ? 4 * plane : 12; }
  /** Place of the plane's overlap; the curvature is two further. */
  static int OverlapPlace(int plane) { return plane < 2 ? 8 + plane : 16; }

  /** 16 a particle: four borders as in ParticleArrays::CellBorders. Empty without borders. */
  std::vector<float> Borders;
  /**
   * 8 a particle: shape operator as xx, yy, zz, 0, xy, yz, xz, 0, fitted to the particles around
   * (Particles/FitShapes.h). Empty if the surface bends so little over a splat that flat disks do as
   * well.
   */
  std::vector<float> Shape;
  /** 1 a particle: the point it was made from. Second splats at points on creases come last. */
  std::vector<vtkIdType> PointIds;
  std::vector<vtkIdType> CellIds; ///< 1 a particle: its vertex cell; empty without vertex cells
  /**
   * One range for each isovalue that ParticleArrays::Isovalues tells apart, at least one range: all particles of the
   * isovalue are from the first number to before the second. Particles of other isovalues may be among them.
   */
  std::vector<std::array<vtkIdType, 2>> IsovalueRanges;
  vtkIdType Skipped = 0; ///< number of particles that cannot be drawn
  /**
   * Particles have been moved by something that is no affine map: nobody knows how shape operators and planes are to
   * follow, so that there are none.
   */
  bool Warped = false;

  /**
   * Number of isovalues up to which they are told apart; particles of more are all of one class. The pixels of the
   * visibility pass hold the number of an isovalue in 7 bits, so that it cannot be larger.
   */
  static constexpr int MaximumNumberOfIsovalues = 128;

  /** Borders of its cell that a particle has room for. */
  static constexpr int MaximumNumberOfBorders = 4;

  vtkIdType GetNumberOfParticles() const { return static_cast<vtkIdType>(this->PointIds.size()); }

  /**
   * Distance of neighbours if so many points are spread evenly, as hexagons, over the sides of a box; or along the box,
   * if it is a line. 0 if the box is a point.
   */
  static double EstimateDistance(const double bounds[6], vtkIdType count);

  /** OverlapAt() a plane at which the surface is almost smooth, in radii. */
  static constexpr float SmoothOverlap = static_cast<float>(SplatOverlap::Smooth);

  /**
   * A plane with at least this overlap (radii) is one at which the surface is almost smooth, for shaders too. Any value
   * between the overlap of creases and SmoothOverlap does; this one is far from both, so that rounding cannot matter.
   */
  static constexpr float LeastSmoothOverlap = 0.25f;

  /** OverlapAt() a plane behind which no other splat makes a surface, in radii: a whole splat goes on beyond it. */
  static constexpr float OpenOverlap = 2.f;

  /**
   * How far, in radii, a splat fills gaps beyond a plane at which the surface has this dihedral angle, in degrees.
   * OpenOverlap at 0, SmoothOverlap below 10 degrees. At creases a little, for particles on both sides do not know the line between them
   * exactly: the less the sharper the crease is, and nothing from 90 degrees on, where splats would stick out.
   */
  static float OverlapAt(double degrees);

  /** Reads the particles of a polydata. */
  static SplatParticles FromPolyData(vtkPolyData* input, const ParticleArrays& arrays);
};
}
