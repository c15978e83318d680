#pragma once

#include "Edges/BoundaryCurves.h"
#include "Edges/BoundaryTracer.h"

#include <optional>

namespace hop
{

/// What a place on a boundary curve turns out to be.
enum class PlaceKind
{
  OnCurve,
  /// No point of the surface was found there.
  Lost,
  /// The surface goes on, so that there is no boundary curve.
  Inside
};

/// Makes particles of places; one finisher a thread.
class BoundaryFinisher
{
public:
  BoundaryFinisher(const Isosurface& surface, const FaceJumps& jumps, const SurfaceProxy& proxy,
    const SizingFunction& sizing);

  /// \param result written if the place is on a boundary curve
  PlaceKind finish(const BoundaryPlace& place, BoundaryParticle& result);

  std::int64_t evaluations() const
  {
    return this->Exact.evaluations() + this->Passer.evaluations();
  }

private:
  /// What lies behind the boundary faces of a point.
  struct Beyond
  {
    /// F - c on the other side; zero where there is none.
    double jump = 0.0;
    /// In a corner, the other face with nothing behind it; else -1.
    int otherFace = -1;
  };

  std::optional<Beyond> lookBehind(const BoundaryPoint& point);
  BoundarySide sideAt(int face, const Evaluated& at, const Jet& jet) const;

  const Isosurface& Surface;
  const FaceJumps& Jumps;
  const SurfaceProxy& Proxy;
  const SizingFunction& Sizing;
  BoundaryTracer Exact;
  /// Passes every face that has something behind it.
  SurfaceWalker Passer;
};

} // namespace hop
