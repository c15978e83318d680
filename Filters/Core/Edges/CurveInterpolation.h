#pragma once

#include "Edges/BoundaryTracer.h"
#include "Isolation/SurfaceProxy.h"

namespace hop
{

/// Places between the vertices of traced boundary curves, and the spacing wanted there.
class CurveInterpolation
{
public:
  /// \param surface its mesh, proxy and tracer outlive this
  CurveInterpolation(const Isosurface& surface, const SurfaceProxy& proxy,
    const SizingFunction& sizing, const BoundaryTracer& tracer)
    : Mesh(*surface.mesh)
    , Proxy(proxy)
    , Sizing(sizing)
    , Tracer(tracer)
    , Walker(surface.endingWhereItMay())
  {
  }

  /// The spacing wanted at a point, world units.
  double spacingAt(const Location& location);

  /// A place near the curve between two points that follow each other on it.
  /// \param t share of the way, 0 to 1
  BoundaryPlace placeBetween(const BoundaryPoint& from, const BoundaryPoint& to, double t);

  std::int64_t evaluations() const { return this->Walker.evaluations(); }

private:
  ReferencePoint onCubic(const BoundaryPoint& from, const BoundaryPoint& to, double t) const;

  const ElementMesh& Mesh;
  const SurfaceProxy& Proxy;
  SizingFunction Sizing;
  const BoundaryTracer& Tracer;
  SurfaceWalker Walker;
};

} // namespace hop
