#pragma once

#include "Edges/BoundaryChords.h"
#include "Edges/FaceCrossings.h"
#include "Surface/ActiveFaces.h"
#include "Surface/SurfaceWalker.h"

#include <functional>
#include <optional>

namespace hop
{

/// Follows boundary curves of the isosurface: curves {F = c} on faces, as far as the surface ends there.
/// Derivation: Documentation/algorithm.md, section Boundary curves and creases.
class BoundaryTracer
{
public:
  enum class Points
  {
    /// Nearer to the surface than its tolerance by one step of Newton's method, which is not evaluated at its end.
    Rough,
    /// On the surface to its tolerance, with Hessians.
    Exact
  };

  /// The spacing wanted at a point, world units.
  using SpacingAt = std::function<double(const BoundaryPoint&)>;

  BoundaryTracer(const Isosurface& surface, Points points)
    : Surface(surface)
    , IsRough(points == Points::Rough)
    , Walker(surface.endingWhereItMay(), points == Points::Exact)
    , Passer(surface)
  {
  }

  /// For a surface that is cut along creases: curves leave no face unnoticed, as the other side has to see the same.
  /// \param looksForMore whether walks around edges of the mesh look for creases along which the surface is not cut
  void followCuts(bool looksForMore)
  {
    this->HasCuts = true;
    this->LooksForCreases = looksForMore;
  }
  /// For a surface that ends along whole faces where the field jumps: curves are closed.
  /// \param looksForMore whether walks around edges of the mesh look for faces at which it ought to end
  void followEnds(bool looksForMore)
  {
    this->HasEnds = true;
    this->LooksForEnds = looksForMore;
  }
  /// The slots of the faces found on such walks, both sides.
  const std::vector<std::size_t>& overlookedFaces() const { return this->OverlookedFaces; }

  /// Whether the surface goes on at a crossing. Costs two evaluations at most.
  /// \param farthest distance from the surface, world units, within which the crossing tells
  /// \return false also for crossings farther off
  bool goesOnAt(const FaceCrossing& crossing, double farthest);

  /// Puts a place on a boundary face onto the surface, along the face.
  /// \param face of the place's element; -1 if it is not known
  std::optional<BoundaryPoint> project(const Location& start, int face, double maximumTravel);

  /// With second derivatives. Costs nothing at the point that an exact tracer evaluated last.
  const Jet& jetAt(const BoundaryPoint& point) { return this->Walker.jetAt(point.at.location); }

  /// Whether the surface ends at a point.
  bool isOnBoundary(const BoundaryPoint& point)
  {
    return this->Passer.endsAt(point.at, point.face);
  }

  /// Whether the surface crosses the face of a point at more than rounding's angle: otherwise the surface lies in the
  /// face, and there is no curve to follow.
  bool crosses(const BoundaryPoint& point) const
  {
    const WorldVector along = this->tangent(point);
    return dot(along, along) > 0.0;
  }

  /// Follows the boundary curve in direction n x w, n the surface's normal and w the inward normal of the
  /// boundary face, and from a dead end also the other way.
  /// Ends where it meets a boundary curve that was traced before: its own start, as a rule. (Where the field jumps
  /// between elements, two boundary curves can run into one.)
  /// Chords are three quarters of the spacing wanted where they begin, at most; less where the boundary curve bends.
  /// \param spacingAt asked once at each vertex
  /// \param parallelFor is asked at each chord whether to end early
  BoundaryTrace trace(
    const BoundaryPoint& start, const SpacingAt& spacingAt, const ParallelFor& parallelFor = {});

  /// Velocity in reference space that follows the boundary curve at speed one in the world, in direction n x w.
  ReferenceVector velocity(const BoundaryPoint& point) const;

  /// Whether a boundary curve was traced through a point.
  bool isTraced(const BoundaryPoint& point) const
  {
    return this->Chords.pass({ point, this->tangent(point) });
  }
  /// The same of a crossing. Costs nothing, but may overlook a curve.
  bool isTraced(const FaceCrossing& crossing) const
  {
    return this->Chords.cross(crossing.location.element, crossing.face, crossing.ends);
  }

  std::int64_t evaluations() const
  {
    return this->Walker.evaluations() + this->Passer.evaluations();
  }

private:
  /// What comes next on a boundary curve.
  struct Ahead
  {
    std::optional<BoundaryVertex> vertex;
    /// There is no vertex because the surface goes on there: the boundary curve ends.
    bool surfaceGoesOn = false;
  };

  /// Where a boundary curve was one vertex ago.
  struct Passed
  {
    int element = -1;
    int face = -1;
    WorldPoint position;
    /// See velocity().
    ReferenceVector velocity;
  };

  /// Where a boundary curve is, which way it is followed there, and where it was before, unless it begins here.
  struct Heading
  {
    const BoundaryPoint& here;
    ReferenceVector velocity;
    double direction = 1.0;
    std::optional<Passed> before;
    /// Whether the latest chord did not move.
    bool standsStill = false;
  };

  /// A place on an edge of the mesh, on the way around the edge from one element to the next.
  struct EdgeWalk
  {
    Location location;
    /// What was evaluated there, if anything was.
    std::optional<Evaluated> here;
    /// The face at the edge that is to be crossed next; -1 if none was found.
    int face = -1;
    /// Numbers of the edge's corners in the mesh, ascending.
    std::vector<std::int64_t> corners;
  };

  bool replacesStart(const BoundaryVertex& last, const BoundaryVertex& start) const;
  bool follow(const BoundaryVertex& start, const SpacingAt& spacingAt, double direction,
    std::vector<BoundaryVertex>& vertices, const ParallelFor& parallelFor);
  void addChord(
    const BoundaryPoint& from, const BoundaryPoint& to, const std::array<double, 2>& way);
  std::optional<BoundaryVertex> advanceAtMost(double& chord, double step, const Heading& heading);
  Ahead advance(const Heading& heading, double step);
  ReferenceVector predict(const Heading& heading, double step) const;
  bool runsAlong(int element, int face, const ReferenceVector& step) const;
  ActiveFaces facesAlong(const Heading& heading, const ReferenceVector& step) const;
  bool staysOnFace(const BoundaryPoint& from, const BoundaryPoint& to) const;
  bool entersAt(const BoundaryPoint& point, int edge, double direction) const;
  bool bendsEvenly(const BoundaryPoint& from, const BoundaryPoint& to);
  Ahead passEdge(const BoundaryPoint& from, const ReferencePoint& u, int otherFace, double step);
  std::optional<Evaluated> projectAlongEdge(
    const Location& start, int faceA, int faceB, double maximumTravel);
  void findOwnPlace(BoundaryPoint& point);
  std::optional<BoundaryPoint> walkAroundEdge(const Evaluated& at, int boundaryFace, int face);
  std::optional<BoundaryPoint> crossAtEdge(EdgeWalk& walk);
  void lookBehind(const Location& here, int face, const Location& there);
  Evaluated polished(Evaluated at, const ActiveFaces& held, double farthest);
  int boundaryFaceOf(const Location& location, int preferred) const;
  WorldVector tangent(const BoundaryPoint& point) const;

  Isosurface Surface;
  bool IsRough;
  /// Stays on boundary faces.
  SurfaceWalker Walker;
  /// Passes boundary faces where the surface goes on, and so tells where it ends.
  SurfaceWalker Passer;
  BoundaryChords Chords;
  /// Number of the trace at hand.
  int Trace = 0;
  bool HasCuts = false;
  bool LooksForCreases = false;
  bool HasEnds = false;
  bool LooksForEnds = false;
  /// Largest jump that the surface passes beside the curve at hand, world units.
  double PassedJump = 0.0;
  std::vector<std::size_t> OverlookedFaces;
};

} // namespace hop
