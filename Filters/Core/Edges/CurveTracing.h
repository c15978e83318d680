#pragma once

#include "Edges/CreaseArcs.h"
#include "Edges/CurveInterpolation.h"
#include "Edges/SampleComparison.h"
#include "Support/Slab.h"

#include <vector>

namespace hop
{

/// Boundary curves of the surface, cut at their corners, and creases along which the surface is cut.
struct TracedCurves
{
  std::vector<BoundaryTrace> traces;
  /// In the order of the traces and along them.
  std::vector<CurveStretch> stretches;
  /// For each stretch the number of the same crease as its other side sees it; -1: there is none.
  std::vector<int> partners;
};

/// Traces the boundary curves that the boxes of a proxy show.
class CurveTracing
{
public:
  /// \param surface, proxy outlive this
  /// \param isForMesh whether the surface is cut along creases, or ends along whole faces: its curves are to be closed
  /// \param slab curves get corners where they pass one of its planes
  /// \param reach where curves are sought
  CurveTracing(const Isosurface& surface, bool isForMesh, const SurfaceProxy& proxy,
    const SizingFunction& sizing, const Slab& slab, const Slab& reach);

  /// For a surface that is cut along creases.
  /// \param looksForMore whether trace() is to find further ones
  void followCreases(bool looksForMore) { this->Tracer.followCuts(looksForMore); }
  /// For a surface that ends along whole faces where the field jumps.
  /// \param looksForMore as above
  void followEnds(bool looksForMore) { this->Tracer.followEnds(looksForMore); }

  /// Traces all curves.
  /// \return slots of faces along which the surface ought to be cut, or to end
  std::vector<std::size_t> trace(const ParallelFor& parallelFor);

  /// The curves that were traced.
  TracedCurves takeCurves();

  CurveInterpolation& interpolation() { return this->Between; }
  std::int64_t evaluations() const
  {
    return this->Tracer.evaluations() + this->Between.evaluations();
  }

private:
  /// Where the surface may end, as far as the samples on both sides tell.
  struct Hint
  {
    FaceCrossing crossing;
    /// Wanted nearby, world units.
    double spacing = 0.0;
  };

  std::vector<std::vector<Hint>> findHints(const ParallelFor& parallelFor) const;
  BoundaryTrace traceFrom(const BoundaryPoint& start, const ParallelFor& parallelFor);
  void follow(const Hint& hint, const ParallelFor& parallelFor);
  bool isInReach(const Location& place) const;
  std::optional<BoundaryPoint> passageBetween(
    const BoundaryVertex& from, const BoundaryVertex& to, double plane);
  void cutAtPlane(double plane, BoundaryTrace& trace);
  void followOtherSide(std::size_t stretch, const ParallelFor& parallelFor);
  bool standsStill(const BoundaryTrace& trace, double spacing) const;
  void keep(BoundaryTrace trace, double spacing);
  void cutAtCorners(const BoundaryTrace& trace);
  void dropOneSided();
  std::vector<int> findPartners() const;

  const Isosurface& Surface;
  const SurfaceProxy& Proxy;
  SizingFunction Sizing;
  Slab Part;
  Slab Reach;
  SampleComparison Samples;
  BoundaryTracer Tracer;
  CurveInterpolation Between;
  TracedCurves Found;
  /// Wanted near each trace, world units.
  std::vector<double> Spacings;
};

} // namespace hop
