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
  /// MaximumFaces entries an element: largest distance along the face between the curves in which the two elements'
  /// surfaces meet it, up to which the surface goes on there (SurfaceWalker::jumpBetween), world units. Infinite where
  /// the field is known to be continuous; zero where the surface ends in all places of the face; negative where it is
  /// cut. nullptr: infinite everywhere.
  const std::vector<float>* jumpTolerances = nullptr;
  /// Whether every face at which the surface may end counts as a boundary face.
  bool endsWhereItMay = false;

  /// Whether a place lies on the surface: |F - c| is within the tolerance, or within rounding errors of F - c, however
  /// small the tolerance. Rounding does not count where it is not small beside the field's change over `reach`.
  /// \param reach world units
  bool holds(const FieldPoint& point, double reach) const
  {
    // Rounding errors of F - c in epsilons of c; chosen by experiment. Larger: particles farther off are accepted;
    // smaller: particles are rejected where the field changes little beside its size.
    constexpr double epsilons = 16.0;
    // Largest rounding error that is accepted, in units of the field's change over `reach`; chosen by experiment.
    // Larger: points in regions of nearly constant field pass; smaller: particles are rejected.
    constexpr double farFromNoise = 1e-4;
    const double noise =
      epsilons * std::numeric_limits<double>::epsilon() * std::abs(this->isovalue);
    const double slope = length(point.gradient);
    const double floor = noise < farFromNoise * reach * slope ? noise : 0.0;
    return std::abs(point.value) <= std::max(this->tolerance * slope, floor);
  }

  /// The same surface, which ends at every face at which it may.
  Isosurface endingWhereItMay() const
  {
    Isosurface result = *this;
    result.endsWhereItMay = true;
    return result;
  }

  double jumpTolerance(int element, int face) const
  {
    return this->jumpTolerances ? (*this->jumpTolerances)[faceSlot(element, face)]
                                : std::numeric_limits<double>::infinity();
  }

  /// Whether the surface may go on behind a face at some places of the face, and end at others.
  bool isOpenToBoth(int element, int face) const
  {
    const bool joined = this->mesh->neighbor(element, face).element >= 0;
    const bool open = joined || (this->locator && this->locator->mayContinue(element, face));
    return open && !this->endsWhereItMay && this->mayEnd(element, face) &&
      this->jumpTolerance(element, face) > 0.0;
  }

  /// Whether the surface may meet a face, as far as that is known without a look at places on it.
  bool mayMeet(int element, int face) const
  {
    return !this->locator || this->mesh->neighbor(element, face).element >= 0 ||
      this->locator->mayMeet(element, face);
  }

  /// Whether the surface is cut along a face: it ends at all places of the face, though it goes on behind them.
  bool isCutAt(int element, int face) const { return this->jumpTolerance(element, face) < 0.0; }

  /// Whether there may be places on a face at which the surface ends.
  bool mayEnd(int element, int face) const
  {
    return this->mesh->neighbor(element, face).element < 0 ||
      std::isfinite(this->jumpTolerance(element, face));
  }
};

/// Cosine of the largest angle, 60 degrees, between the normals of two elements' surfaces that count as one sheet where
/// the field jumps; chosen by experiment. Surfaces with a larger angle end at boundary curves of their own, and their
/// particles do not repel each other. Larger: the surface is cut open at creases; smaller: sheets are joined that only
/// cross.
constexpr double SheetCosine = 0.5;

/// A place at which the field was evaluated.
struct Evaluated
{
  Location location;
  FieldPoint point;
  /// Of the field, in world space; zero where it was not asked for.
  glm::dmat3 hessian{ 0.0 };
};

/// Moves points through the mesh and onto the surface, and counts its evaluations. Each thread needs a walker of its
/// own. See Documentation/algorithm.md, section Walking on the surface.
class SurfaceWalker
{
public:
  /// \param curved whether evaluate() evaluates Hessians too
  explicit SurfaceWalker(const Isosurface& surface, bool curved = false)
    : Surface(surface)
    , Curved(curved)
  {
  }

  /// Value and gradient at a place.
  Evaluated evaluate(const Location& location);

  /// Value, gradient and Hessian at a place.
  Evaluated evaluateCurved(const Location& location);

  /// Value and derivatives to second order at a place. Free of cost if the last evaluation with a Hessian was there.
  const Jet& jetAt(const Location& location);

  /// A place behind a face.
  struct Behind
  {
    Evaluated at;
    /// The face of its element by which one enters the element.
    int face = -1;
  };

  /// The place behind a face if the surface goes on there: in the element that the mesh joins to the face or that the
  /// locator finds, if the jump is within the face's tolerance.
  /// \pre `here` lies on the face
  std::optional<Behind> behind(const Evaluated& here, int face);
  /// The same; the place is evaluated only where the surface may end at some places of the face.
  std::optional<Behind> behind(const Location& here, int face);

  /// Distance along a face between the two curves in which the elements' surfaces meet it, to first order: from a place
  /// on the one, the jump of the field over the slope along the face of the other. So it is the same from both sides.
  /// World units; infinite or NaN where the slope is zero.
  static double jumpBetween(const ElementMesh& mesh, const Evaluated& here, const Behind& there);

  /// Whether the surface goes on from a place on a face to a place behind it: the jump is within the face's tolerance,
  /// and the normals are those of one sheet.
  static bool continuesIn(
    const Isosurface& surface, const Evaluated& here, int face, const Behind& there);

  /// Whether a place lies on a face of its element, and the surface ends there.
  bool endsAt(const Evaluated& here, int face);

  /// Number of faces of its element for which endsAt() a place holds.
  int endFaceCount(const Location& location);

  /// Follows a world vector from a place through as many elements as it takes: at each face the rest of the vector,
  /// towards the same world target, is continued with the Jacobian of the next element. Where the surface ends at a
  /// face the rest slides along the face. Within an element the step is first order in u, so that the place reached
  /// lies near the target, not on it. Steps that would pass more than MaximumHops faces end at the last one.
  Location move(const Evaluated& start, const WorldVector& step);

  /// Newton's method u <- u - K F_x F/|F_x|^2 (Meyer et al. 2007, eq. 1), across faces, and along a face where the
  /// surface ends there.
  /// \param maximumTravel give up when the steps add up to more (world units)
  /// \param result receives the place on the surface if the method converged
  /// \param keepFace whether a start on a face at which the surface ends stays on that face
  /// \return whether the method converged: Isosurface::holds() at the result
  bool project(
    const Location& start, double maximumTravel, Evaluated& result, bool keepFace = false);

  std::int64_t evaluations() const { return this->Evaluations; }

  /// Faces that a step passes or is held back by, at most: steps are shorter than elements for the most part, so that
  /// one that needs more goes in circles. Larger: such steps cost more evaluations; smaller: steps through small
  /// elements end early.
  static constexpr int MaximumHops = 8;
  /// Newton's method converges in some five steps; where it takes more than these it is given up. Smaller: particles on
  /// strongly curved fields are rejected.
  static constexpr int MaximumNewtonSteps = 25;
  /// Steps in a row of Newton's method that do not halve the distance from the surface, at most: near a simple zero the
  /// distance is squared in each, near a double one halved. Larger: where the method fails, in flattened cells for
  /// instance, it takes longer to be given up; smaller: particles are rejected from where the first steps overshoot.
  static constexpr int MaximumStepsInVain = 5;

private:
  WorldVector newtonStep(const Evaluated& at, bool& alongFace);
  int onlyEnd(const Evaluated& here);
  std::optional<LocatedPlace> placeBehind(const Evaluated& here, int face);

  Isosurface Surface;
  bool Curved = false;
  Location LastPlace;
  Jet LastJet;
  std::int64_t Evaluations = 0;
};

} // namespace hop
