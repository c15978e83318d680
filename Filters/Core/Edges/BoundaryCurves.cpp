#include "Edges/BoundaryCurves.h"

#include "Edges/BoundaryFinisher.h"
#include "Edges/BoundaryThinning.h"
#include "Edges/CurveSampling.h"
#include "Edges/CurveTracing.h"
#include "Support/DisjointSets.h"
#include "Support/KeepMarked.h"

#include <atomic>
#include <cmath>

namespace hop
{
namespace
{

/// Calls use(slot) for each face that the mesh joins.
template <class Use>
void visitJoined(const ElementMesh& mesh, std::size_t slots, const Use& use)
{
  for (std::size_t slot = 0; slot < slots; ++slot)
  {
    if (mesh.neighbor(static_cast<int>(slot / MaximumFaces), slot % MaximumFaces).element >= 0)
    {
      use(slot);
    }
  }
}

/// Sets jump tolerances with which the surface is cut along creases, unless it ends at faces where it is tangent to them:
/// pieces of surface that end at creases here and there would not close.
/// \return whether there are creases to cut along
bool cutAlongCreases(
  const ElementMesh& mesh, const FaceJumps& jumps, std::vector<float>& tolerances)
{
  bool isCut = false;
  bool ends = false;
  visitJoined(mesh, tolerances.size(),
    [&](std::size_t slot) { ends = ends || std::isfinite(tolerances[slot]); });
  visitJoined(mesh, ends ? 0 : tolerances.size(),
    [&](std::size_t slot)
    {
      if (jumps.dihedralAngles[slot] > CreaseAngle)
      {
        tolerances[slot] = -1.0f;
        isCut = true;
      }
    });
  return isCut;
}

/// Lets the surface of a discontinuous field end along all of each face at which it ends anywhere, be it at a jump or
/// because it turns by more than one sheet does: its curves then end where a jump fades no more, but go around an edge of
/// the mesh to the face's other side.
void endAlongFaces(const ElementMesh& mesh, FaceJumps& jumps)
{
  const double mostTurned = std::acos(SheetCosine);
  visitJoined(mesh, jumps.jumpTolerances.size(),
    [&](std::size_t slot)
    {
      float& tolerance = jumps.jumpTolerances[slot];
      const bool ends = std::isfinite(tolerance) || jumps.dihedralAngles[slot] > mostTurned;
      tolerance = ends ? 0.0f : tolerance;
    });
}

/// Makes particles of the places on curves.
class BoundaryParticles
{
public:
  BoundaryParticles(const Isosurface& surface, const FaceJumps& jumps, const SurfaceProxy& proxy,
    const SizingFunction& sizing, const SampledPlaces& sampled)
    : Surface(surface)
    , Jumps(jumps)
    , Proxy(proxy)
    , Sizing(sizing)
    , Sampled(sampled)
  {
  }

  /// \param pieces of the surface, where particles are thinned out for meshes of them
  BoundaryCurves make(ThinnedCurves wanted, SurfacePieces pieces, const ParallelFor& parallelFor);

private:
  std::vector<PlaceKind> finish(const ParallelFor& parallelFor);
  void meet(std::vector<char>& found);

  const Isosurface& Surface;
  const FaceJumps& Jumps;
  const SurfaceProxy& Proxy;
  const SizingFunction& Sizing;
  const SampledPlaces& Sampled;
  BoundaryCurves Result;
};

/// Puts a particle onto the curve at each place.
std::vector<PlaceKind> BoundaryParticles::finish(const ParallelFor& parallelFor)
{
  Buffer<BoundaryParticle>& particles = this->Result.particles;
  particles.resize(this->Sampled.places.size());
  std::vector<PlaceKind> kinds(particles.size());
  std::atomic<std::int64_t> evaluations{ 0 };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(particles.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      BoundaryFinisher finisher(this->Surface, this->Jumps, this->Proxy, this->Sizing);
      for (std::ptrdiff_t n = begin; n < end; ++n)
      {
        kinds[n] = finisher.finish(this->Sampled.places[n], particles[n]);
      }
      evaluations += finisher.evaluations();
    });
  this->Result.evaluations += evaluations;
  return kinds;
}

/// Puts the particles of all sides of a place on creases into the same place, to the last bit. Inside a crease there is
/// one on each side or none.
/// \param found marks the places with particles
void BoundaryParticles::meet(std::vector<char>& found)
{
  Buffer<BoundaryParticle>& particles = this->Result.particles;
  DisjointSets places(particles.size());
  for (const auto& [a, b] : this->Sampled.twins)
  {
    found[a] = found[b] = found[a] && found[b];
    places.unite(a, b);
  }
  for (const auto& [a, b] : this->Sampled.corners)
  {
    places.unite(a, b);
    particles[a].isOnCrease = particles[b].isOnCrease = true;
  }
  std::vector<int> first(particles.size(), -1);
  for (std::size_t n = 0; n < particles.size(); ++n)
  {
    int& one = first[places.root(static_cast<int>(n))];
    if (!found[n])
    {
      continue;
    }
    if (one >= 0)
    {
      particles[n].particle.position = particles[one].particle.position;
      particles[n].patch.position = particles[one].patch.position;
      this->Result.edges.coincident.push_back({ one, static_cast<int>(n) });
    }
    one = one < 0 ? static_cast<int>(n) : one;
  }
  renumber(this->Result.edges.coincident, found);
}

BoundaryCurves BoundaryParticles::make(
  ThinnedCurves wanted, SurfacePieces pieces, const ParallelFor& parallelFor)
{
  this->Result.pieces = std::move(pieces);
  const std::vector<PlaceKind> kinds = this->finish(parallelFor);
  Buffer<BoundaryParticle>& particles = this->Result.particles;
  std::vector<char> found(particles.size());
  for (std::size_t n = 0; n < particles.size(); ++n)
  {
    found[n] = kinds[n] == PlaceKind::OnCurve;
    particles[n].isOnCrease = this->Sampled.beginsCrease[n] != 0;
    particles[n].isCorner = this->Sampled.isCorner[n] != 0;
    particles[n].isNeeded = this->Sampled.isNeeded[n] != 0;
  }
  this->meet(found);
  std::vector<CurvePlace> outcomes(particles.size());
  int count = 0;
  for (std::size_t n = 0; n < particles.size(); ++n)
  {
    outcomes[n] = { found[n] ? count++ : -1, -1, kinds[n] == PlaceKind::Inside,
      this->Sampled.beginsCrease[n] != 0 };
  }
  keepMarked(particles, found);
  thinOut(*this->Surface.mesh, std::move(outcomes), this->Sampled.ranges, wanted, this->Result,
    parallelFor);
  return std::move(this->Result);
}

} // namespace

BoundaryCurves findBoundaryCurves(const Isosurface& surface, FaceJumps& jumps,
  const SurfaceProxy& proxy, const SizingFunction& sizing, SampledCurves sampled,
  const ParallelFor& parallelFor, const Slab& slab, const Slab& reach)
{
  const bool isForMesh = sampled == SampledCurves::ForMeshes;
  const bool endsAtFaces = isForMesh && jumps.isDiscontinuous;
  if (endsAtFaces)
  {
    endAlongFaces(*surface.mesh, jumps);
  }
  Isosurface cut = surface;
  std::vector<float> creases = jumps.jumpTolerances;
  const bool isCut = isForMesh && !endsAtFaces && cutAlongCreases(*surface.mesh, jumps, creases);
  if (isCut)
  {
    cut.jumpTolerances = &creases;
  }
  // Each time curves may show further faces beside them, where the surface passes corners of faces.
  constexpr int mostTimes = 8;
  std::int64_t evaluations = 0;
  for (int n = 1;; ++n)
  {
    CurveTracing tracing(cut, isCut || endsAtFaces, proxy, sizing, slab, reach);
    if (isCut)
    {
      tracing.followCreases(n < mostTimes);
    }
    else if (endsAtFaces)
    {
      tracing.followEnds(n < mostTimes);
    }
    const std::vector<std::size_t> overlooked = tracing.trace(parallelFor);
    if (overlooked.empty())
    {
      const SampledPlaces places = samplePlaces(
        cut, isCut || endsAtFaces, tracing.takeCurves(), tracing.interpolation(), parallelFor);
      const ThinnedCurves thinned = !isForMesh ? ThinnedCurves::OfSplats
        : endsAtFaces                          ? ThinnedCurves::OfPieces
                                               : ThinnedCurves::OfMesh;
      SurfacePieces pieces =
        endsAtFaces ? SurfacePieces(*surface.mesh, jumps.jumpTolerances) : SurfacePieces();
      BoundaryCurves curves = BoundaryParticles(cut, jumps, proxy, sizing, places)
                                .make(thinned, std::move(pieces), parallelFor);
      curves.evaluations += evaluations + tracing.evaluations();
      return curves;
    }
    evaluations += tracing.evaluations();
    for (const std::size_t slot : overlooked)
    {
      (isCut ? creases : jumps.jumpTolerances)[slot] = isCut ? -1.0f : 0.0f;
    }
  }
}

} // namespace hop
