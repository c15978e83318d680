#pragma once

#include "Surface/Particles.h"

#include <optional>

namespace hop
{

/// A line on which a node of a curved triangle is sought.
struct NodeLine
{
  /// On the straight triangle.
  WorldPoint foot;
  /// Unit vector.
  WorldVector direction;
  /// Length of the triangle's edges, world units.
  double scale = 0.0;
};

/// Finds nodes of curved triangles. Each thread needs a finder of its own.
/// Derivation: Documentation/algorithm.md, section Curved triangles.
class NodeFinder
{
public:
  /// \param surface passes creases
  /// \param ending the same surface, which ends at faces with creases and jumps
  NodeFinder(const Isosurface& surface, const Isosurface& ending)
    : Ending(ending.endingWhereItMay())
    , Walker(surface)
    , EndWalker(this->Ending)
  {
  }

  /// The place where the surface meets a line.
  std::optional<Evaluated> onLine(const Location& start, const NodeLine& line);

  /// The place of a boundary curve or crease whose projection to its chord is the line's foot.
  /// \param start on the curve
  /// \param along unit vector of the chord
  std::optional<Evaluated> onCurve(
    const Location& start, const NodeLine& line, const WorldVector& along);

  /// The particle of a place on the surface.
  Particle particleOf(const Location& place, double spacing);

  /// The particle of a place that is not on the surface: the foot of a line.
  Particle straightParticle(const Location& start, const NodeLine& line, double spacing);

  /// Mean of the normals on both sides of the faces at which the surface may end; those of creases.
  WorldVector meanNormal(const Location& place);

  std::int64_t evaluations() const
  {
    return this->Walker.evaluations() + this->EndWalker.evaluations();
  }

private:
  /// How a curve runs at a place: unit vectors along it, and out of the face on which it runs.
  struct Tangent
  {
    WorldVector along;
    WorldVector outward;
  };
  std::optional<Tangent> tangentAt(const Evaluated& at, const WorldVector& along);

  Isosurface Ending;
  SurfaceWalker Walker;
  SurfaceWalker EndWalker;
};

} // namespace hop
