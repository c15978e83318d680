#pragma once

#include "Surface/FaceLocator.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace hop
{

/// The isosurface {F = isovalue} of a mesh, and how exactly points have to lie on it.
struct Isosurface
{
  const ElementMesh* mesh = nullptr;
  double isovalue = 0.0;
  /// Largest distance |F - c|/|grad F| of a particle from the surface, world units.
  double tolerance = 0.0;
  /// Finds what lies behind faces that the mesh does not join; nullptr: nothing does.
  const FaceLocator* locator = nullptr;
  /// MaximumFaces entries an element: by how much the two sides of the surface may miss each other at
  /// that face and still count as one, world units; infinite where they are known to agree. nullptr:
  /// infinite everywhere.
  const std::vector<float>* jumpTolerances = nullptr;
  /// As if the surface ended at every face at which it might.
  bool walled = false;

  /// Whether a place lies on the surface: to the tolerance, or to what rounding leaves of F - c, however small the
  /// tolerance. Nothing is on a surface for rounding where the gradient itself is no more.
  /// \param reach world length that rounding has to be small beside
  bool holds(const FieldPoint& point, double reach) const
  {
    constexpr double farFromNoise = 1e-4;
    const double noise = 16.0 * std::numeric_limits<double>::epsilon() * std::abs(this->isovalue);
    const double slope = length(point.gradient);
    const double floor = noise < farFromNoise * reach * slope ? noise : 0.0;
    return std::abs(point.value) <= std::max(this->tolerance * slope, floor);
  }

  Isosurface withWalls() const
  {
    Isosurface result = *this;
    result.walled = true;
    return result;
  }

  double jumpTolerance(int element, int face) const
  {
    return this->jumpTolerances ? (*this->jumpTolerances)[faceSlot(element, face)]
                                : std::numeric_limits<double>::infinity();
  }

  /// Whether the surface may go on behind the face at some places, and end there at others.
  bool isUndecided(int element, int face) const
  {
    const bool joined = this->mesh->neighbor(element, face).element >= 0;
    const bool open = joined || (this->locator && this->locator->mayGoOn(element, face));
    return open && !this->walled && this->mayEnd(element, face);
  }

  /// Whether there are places on the face at which the surface may end.
  bool mayEnd(int element, int face) const
  {
    return this->mesh->neighbor(element, face).element < 0 ||
      std::isfinite(this->jumpTolerance(element, face));
  }
};

/// Cosine of the largest angle between normals of one sheet where the field jumps: particles on sheets that are
/// turned more do not keep each other off, and end at boundary curves of their own.
constexpr double SameSheet = 0.5;

/// A place that was evaluated.
struct Evaluated
{
  Location location;
  FieldPoint point;
  /// Zero unless asked for.
  glm::dmat3 hessian{ 0.0 };
};

/// Moves points through the mesh and onto the surface. Counts its evaluations. One a thread.
class SurfaceWalker
{
public:
  /// \param curved evaluates Hessians everywhere
  explicit SurfaceWalker(const Isosurface& surface, bool curved = false)
    : Surface(surface)
    , Curved(curved)
  {
  }

  /// Value and gradient at a place.
  Evaluated evaluate(const Location& location);

  /// Value, gradient and Hessian at a place.
  Evaluated evaluateCurved(const Location& location);

  /// Value and derivatives to second order at a place; costs nothing where Hessians were evaluated last.
  const Jet& jetAt(const Location& location);

  /// What lies behind a face, on which a place lies, where the surface goes on there: joined by the mesh or
  /// found by the locator, and no farther off than the face's gap.
  struct Behind
  {
    Evaluated at;
    /// The face of that element by which one enters it.
    int face = -1;
  };
  std::optional<Behind> behind(const Evaluated& here, int face);
  /// The same; the place is evaluated only if that matters.
  std::optional<Behind> behind(const Location& here, int face);

  /// Distance along the face between the two curves in which the surface comes to it from either side, by
  /// the field's values and slopes at a place; infinite or NaN where a slope is zero.
  static double jumpBetween(
    const ElementMesh& mesh, const Evaluated& here, int face, const Behind& there);

  /// Whether the surface goes on from a place to what lies behind a face there.
  static bool goesOn(
    const Isosurface& surface, const Evaluated& here, int face, const Behind& there);

  /// Whether a place lies on that face of its element, and the surface ends there.
  bool endsAt(const Evaluated& here, int face);

  /// How many faces of its element there are for which it does.
  int endCount(const Location& location);

  /// Follows a world vector from a place, through as many elements as it takes: at each face the
  /// rest of the vector, towards the same world target, is continued with the Jacobian of the next
  /// element. At a boundary the rest slides along it. Within an element the step is first order
  /// in u, so that the place reached lies near the target, not on it. Steps that would need more
  /// than MaximumHops elements end at the last face.
  Location move(const Evaluated& start, const WorldVector& step);

  /// Newton's method u <- u - K F_x F/|F_x|^2 (the paper's eq. 1), across faces, and along the
  /// boundary where the surface leaves the domain.
  /// \param maximumTravel give up when the steps add up to more (world units)
  /// \param result the place on the surface, if the method converged
  /// \return whether |F - c|/|grad F| fell to the tolerance
  /// \param keepWall a start on the boundary stays on it
  bool project(
    const Location& start, double maximumTravel, Evaluated& result, bool keepWall = false);

  std::int64_t evaluations() const { return this->Evaluations; }

  static constexpr int MaximumHops = 8;
  static constexpr int MaximumNewtonSteps = 25;

private:
  WorldVector newtonStep(const Evaluated& at, bool& alongWall);
  int onlyEnd(const Evaluated& here);
  std::optional<LocatedPlace> placeBehind(const Evaluated& here, int face);

  Isosurface Surface;
  bool Curved = false;
  Location LastPlace;
  Jet LastJet;
  std::int64_t Evaluations = 0;
};

} // namespace hop
