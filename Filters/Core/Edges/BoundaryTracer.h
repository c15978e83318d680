#pragma once

#include "Edges/FaceCrossings.h"
#include "Surface/ActiveFaces.h"
#include "Surface/SurfaceWalker.h"

#include <optional>
#include <unordered_map>

namespace hop
{

/// A point of a boundary curve: a place on a boundary face.
struct BoundaryPoint
{
  Evaluated at;
  int face = -1;
};

/// A vertex of a traced boundary curve: on a mesh edge it is seen from two faces.
struct BoundaryVertex
{
  BoundaryPoint arriving;
  BoundaryPoint leaving;
  /// The boundary curve turns here.
  bool corner = false;

  const glm::dvec3& position() const { return this->arriving.at.point.map.position.xyz; }
};

struct BoundaryTrace
{
  std::vector<BoundaryVertex> vertices;
  /// The last vertex is followed by the first.
  bool closed = false;
};

/// Chords of boundary curves traced so far, by the face they run on.
class BoundaryChords
{
public:
  struct Chord
  {
    Chord(const BoundaryPoint& from, const BoundaryPoint& to);

    std::size_t face = 0; ///< slot
    /// In the world, and in the element's reference space.
    std::array<glm::dvec3, 2> positions;
    std::array<glm::dvec3, 2> places;
    /// The field's: two sheets close to each other have opposite ones.
    WorldVector gradient;
  };

  void add(const Chord& chord) { this->Chords[chord.face].push_back(chord); }

  /// Whether a chord of the same sheet on the same face passes a point, to a fifth of its length.
  bool pass(const BoundaryPoint& point) const;

  /// Whether a chord on a face crosses the line between two places on it.
  bool cross(int element, int face, const std::array<glm::dvec3, 2>& ends) const;

private:
  /// By the slots of the faces that they run on.
  std::unordered_map<std::size_t, std::vector<Chord>> Chords;
};

/// Follows boundary curves of the isosurface: curves {F = c} on faces, as far as the surface ends there.
class BoundaryTracer
{
public:
  enum class Points
  {
    /// One step of Newton's method nearer to the surface than its tolerance; that step is not evaluated.
    Rough,
    /// On the surface to its tolerance, with Hessians.
    Exact
  };

  BoundaryTracer(const Isosurface& surface, Points points)
    : Surface(surface)
    , IsRough(points == Points::Rough)
    , Walker(surface.withWalls(), points == Points::Exact)
    , Passer(surface)
  {
  }

  /// Whether the surface is seen to go on at a crossing that is nearer to it than that (world units); two
  /// evaluations.
  bool goesOnAt(const FaceCrossing& crossing, double nearest);

  /// Puts a place on a face at which the surface may end onto the surface, along the face.
  /// \param face of the place's element; -1 if it is not known
  std::optional<BoundaryPoint> project(const Location& start, int face, double maximumTravel);

  /// With second derivatives; costs nothing where the tracer was exact last.
  const Jet& jetAt(const BoundaryPoint& point) { return this->Walker.jetAt(point.at.location); }

  /// Whether the surface ends there.
  bool isOnBoundary(const BoundaryPoint& point)
  {
    return this->Passer.endsAt(point.at, point.face);
  }

  /// Follows the boundary curve in direction n x w, n the surface's normal and w the inward normal of the
  /// boundary, and from a dead end also the other way.
  /// Ends where it meets a boundary curve that was traced before: its own start, as a rule. (Where the field jumps
  /// between elements, two boundary curves can run into one.)
  /// \param step world length of the chords, at most; less where the boundary curve turns
  BoundaryTrace trace(const BoundaryPoint& start, double step);

  /// In which way the boundary curve goes on in reference space, n x w in the world, for a world distance of one.
  ReferenceVector velocity(const BoundaryPoint& point) const;

  /// Whether a boundary curve was traced through a point.
  bool hasPassed(const BoundaryPoint& point) const { return this->Chords.pass(point); }
  /// The same, of a crossing; may miss some, but costs nothing.
  bool hasPassed(const FaceCrossing& crossing) const
  {
    return this->Chords.cross(crossing.location.element, crossing.face, crossing.ends);
  }

  std::int64_t evaluations() const
  {
    return this->Walker.evaluations() + this->Passer.evaluations();
  }

private:
  bool follow(const BoundaryPoint& start, double step, double direction,
    std::vector<BoundaryVertex>& vertices);
  /// What comes next on a boundary curve.
  struct Ahead
  {
    std::optional<BoundaryVertex> vertex;
    /// There is none as the surface goes on there.
    bool fades = false;
  };

  /// Where a boundary curve was.
  struct Passed
  {
    int element = -1;
    int face = -1;
    WorldPoint position;
    /// See velocity().
    ReferenceVector velocity;
  };

  /// Where a boundary curve is, which way it is followed there, and where it was before, unless it begins.
  struct Heading
  {
    const BoundaryPoint& here;
    ReferenceVector velocity;
    double direction = 1.0;
    std::optional<Passed> before;
  };

  std::optional<BoundaryVertex> advanceAtMost(double& chord, double step, const Heading& heading);
  Ahead advance(const Heading& heading, double step);
  ReferenceVector predict(const Heading& heading, double step) const;
  Ahead passEdge(const BoundaryPoint& from, const ReferencePoint& u, int otherFace, double step);
  std::optional<Evaluated> projectAlongEdge(
    const Location& start, int faceA, int faceB, double maximumTravel);
  std::optional<BoundaryPoint> turnAroundEdge(const Evaluated& at, int wall, int face);
  Evaluated polished(Evaluated at, const ActiveFaces& walls);
  std::vector<std::int64_t> cornersOf(const Location& location, int face) const;
  int faceAtEdge(const Location& location, int entry, const std::vector<std::int64_t>& edge) const;
  int otherFaceAt(const Location& location, int one, double accuracy) const;
  Location ontoFace(const Location& location, int face) const;
  int wallOf(const Location& location, int preferred) const;
  WorldVector tangent(const BoundaryPoint& point) const;

  Isosurface Surface;
  bool IsRough;
  /// Stays on faces at which the surface may end.
  SurfaceWalker Walker;
  /// Tells whether it does.
  SurfaceWalker Passer;
  BoundaryChords Chords;
};

} // namespace hop
