#pragma once

#include "Support/Buffer.h"
#include "Surface/Energy.h"
#include "Surface/SurfaceEdges.h"
#include "Surface/SurfacePieces.h"
#include "Surface/SurfaceWalker.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace hop
{

/// A plane near a particle at which splats are cut off, because an edge of the surface runs there: a boundary curve or
/// a crease. It touches the edge in the edge's point nearest to the particle.
struct ClipPlane
{
  /// Unit normal, pointing away from the particle; zero if there is no plane.
  WorldVector normal;
  /// Distance from the particle, >= 0, world units. Larger than the edge's where splats would else leave a corner
  /// between creases open.
  double distance = 0.0;
  /// Curvature of the edge along the surface, 1/world units, positive where it bends towards the plane's normal; 0 at
  /// creases with a small dihedral angle.
  double edgeCurvature = 0.0;
  /// Angle by which the surface turns at a crease, radians, see FaceJumps::dihedralAngles; pi at a boundary curve; 0 at
  /// an open plane.
  float dihedralAngle = 0.0f;
  /// Face of the particle's element in which the crease lies; -1: a boundary curve.
  int face = -1;

  bool exists() const { return dot(this->normal, this->normal) > 0.0; }
  bool isBoundary() const { return this->exists() && this->face < 0; }
  /// Whether no particle behind the crease covers what the plane would cut off.
  bool isOpen() const { return this->exists() && this->dihedralAngle == 0.0f; }
};

/// A border of a particle's element on the surface, where the surface passes a face of the element, as the particle
/// sees it: in its tangent plane, to which the border is projected along the normal.
struct CellBorder
{
  /// Number of borders that a particle keeps: a piece of surface in a hexahedron has four sides as a rule, in a
  /// tetrahedron four at most. More take memory; with fewer, colours reach over borders of elements below two spacings.
  static constexpr int Most = 4;

  /// From the particle to the nearest place of the border, which it is at right angles to; world units. Zero if there
  /// is no border, otherwise never: it is short where the particle stands on the border.
  glm::vec3 foot{ 0.0f };
  /// 1/world units, positive where the border bends towards its outer side.
  float curvature = 0.0f;

  bool exists() const { return this->foot != glm::vec3(0.0f); }
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
  /// h, the wanted distance to neighbours, world units.
  double spacing = 0.0;
  /// Near corners of the surface, and on strips of it, there are several planes: boundary curves first, then creases,
  /// near planes before far ones, see offerPlane().
  std::array<ClipPlane, 3> clips;
  /// Where the splat leaves the particle's element, nearest first: colours that differ from element to element end
  /// there.
  std::array<CellBorder, CellBorder::Most> borders;
  /// Of the surface around it (particleAreas()), world units squared; 0 where it was not computed.
  double area = 0.0;
  /// Of a mesh's particle on a crease, whose normal is the mean of all sides': the normal of its own side. Zero elsewhere.
  glm::vec3 sideNormal{ 0.0f };
  /// On a boundary curve where the field jumps between elements: F - c in the element behind the face. Zero elsewhere.
  double jump = 0.0;
  /// Ratio of the splat's radius to the spacing, 1 at most: less where the particle stands alone on a component of the
  /// surface smaller than the spacing.
  double radiusPerSpacing = 1.0;

  /// Fewest particles that have to stand around a tube for it to look round. Smaller: undersampled places stay
  /// unnoticed; larger: the user is warned of places that look right.
  static constexpr double FewestAround = 6.0;
  /// Whether fewer stand, at a spacing, around the tube that bends as the surface does where it bends most.
  bool wouldBeUndersampled(double atSpacing) const
  {
    return this->curvature.largest() * atSpacing * FewestAround > 2.0 * Pi;
  }
  bool isUndersampled() const { return this->wouldBeUndersampled(this->spacing); }
};

/// The particle of a place on the surface: without clip planes, jump and shrinking.
/// \param spacing h, world units
inline Particle particleAt(
  const Location& place, const FieldPoint& point, const Curvature& curvature, double spacing)
{
  Particle particle;
  particle.location = place;
  particle.position = point.map.position;
  particle.normal = surfaceNormal(point.gradient);
  particle.curvature = curvature;
  particle.residual = std::abs(point.value) / length(point.gradient);
  particle.spacing = spacing;
  return particle;
}

/// What a distribution cost and what it found.
struct DistributionReport
{
  /// Evaluations of an element at a point, with all its derivatives.
  std::int64_t evaluations = 0;
  /// Sweeps of the relaxation.
  std::int64_t iterations = 0;
  /// Number of boxes in which the surface may be (SurfaceBoxes.h), and of boxes among them that are not proven to
  /// hold one sheet.
  std::int64_t boxes = 0;
  std::int64_t boxesUndecided = 0;
  /// Input cells with undecided boxes, ascending, each once.
  std::vector<std::int64_t> undecidedCells;
  /// Points near undecided boxes where the gradient vanishes on the surface: tips of cones, isolated points,
  /// crossings of sheets.
  std::int64_t singularPoints = 0;
  /// Particles given up because they could not be put on the surface again.
  std::int64_t particlesRejected = 0;
  /// Particles for which Particle::isUndersampled() holds.
  std::int64_t particlesUndersampled = 0;
  /// Faces of elements that the surface reaches, counted from each side, and those of them at which it ends; Fast only.
  std::int64_t facesReached = 0;
  std::int64_t facesEnded = 0;
  /// Largest jump seen, see FaceJumps::largestJump; Fast only.
  double largestJump = 0.0;
  bool converged = true;
  bool aborted = false;
  /// Why nothing was computed; empty if all is well.
  std::string error;

  /// Whether the surface jumps from element to element by more than rounding.
  bool hasJumps() const
  {
    constexpr double rounding = 1e-3; // in spacings
    return this->largestJump > rounding;
  }
};

struct Distribution
{
  Buffer<Particle> particles;
  /// By the indices of the particles; Fast only.
  SurfaceEdges edges;
  /// Of meshes of discontinuous fields; else one.
  SurfacePieces pieces;
  DistributionReport report;
};

} // namespace hop
