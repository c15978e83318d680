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

/// Sets jump tolerances with which the surface is cut along creases, unless the field is discontinuous: pieces of surface
/// that end at creases here and at jumps there would not close.
/// \return whether there are creases to cut along
bool cutAlongCreases(
  const ElementMesh& mesh, const FaceJumps& jumps, std::vector<float>& tolerances)
{
  const auto isJoined = [&mesh](std::size_t slot) {
    return mesh.neighbor(static_cast<int>(slot / MaximumFaces), slot % MaximumFaces).element >= 0;
  };
  for (std::size_t slot = 0; slot < tolerances.size(); ++slot)
  {
    if (std::isfinite(tolerances[slot]) && isJoined(slot))
    {
      return false;
    }
  }
  bool isCut = false;
  for (std::size_t slot = 0; slot < tolerances.size(); ++slot)
  {
    if (jumps.dihedralAngles[slot] > CreaseAngle && isJoined(slot))
    {
      tolerances[slot] = -1.0f;
      isCut = true;
    }
  }
  return isCut;
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

  BoundaryCurves make(SampledCurves wanted, const ParallelFor& parallelFor);

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

BoundaryCurves BoundaryParticles::make(SampledCurves wanted, const ParallelFor& parallelFor)
{
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
  thinOut(std::move(outcomes), this->Sampled.ranges, wanted, this->Result, parallelFor);
  return std::move(this->Result);
}

} // namespace

BoundaryCurves findBoundaryCurves(const Isosurface& surface, const FaceJumps& jumps,
  const SurfaceProxy& proxy, const SizingFunction& sizing, SampledCurves sampled,
  const ParallelFor& parallelFor, const Slab& slab, const Slab& reach)
{
  Isosurface cut = surface;
  std::vector<float> tolerances = jumps.jumpTolerances;
  const bool isCut = sampled == SampledCurves::BoundaryAndCreases &&
    cutAlongCreases(*surface.mesh, jumps, tolerances);
  if (isCut)
  {
    cut.jumpTolerances = &tolerances;
  }
  // Each time creases may show further ones beside them, where the surface passes corners of faces.
  constexpr int mostTimes = 8;
  std::int64_t evaluations = 0;
  for (int n = 1;; ++n)
  {
    CurveTracing tracing(cut, isCut, proxy, sizing, slab, reach);
    if (isCut)
    {
      tracing.followCreases(n < mostTimes);
    }
    const std::vector<std::size_t> overlooked = tracing.trace(parallelFor);
    if (overlooked.empty())
    {
      const SampledPlaces places =
        samplePlaces(cut, isCut, tracing.takeCurves(), tracing.interpolation(), parallelFor);
      BoundaryCurves curves =
        BoundaryParticles(cut, jumps, proxy, sizing, places).make(sampled, parallelFor);
      curves.evaluations += evaluations + tracing.evaluations();
      return curves;
    }
    evaluations += tracing.evaluations();
    for (const std::size_t slot : overlooked)
    {
      tolerances[slot] = -1.0f;
    }
  }
}

} // namespace hop
