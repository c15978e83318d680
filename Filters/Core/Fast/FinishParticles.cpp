#include "Fast/FinishParticles.h"

#include "Edges/CellBorders.h"
#include "Edges/FacePlanes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace hop
{
namespace
{

class Finish
{
public:
  Finish(MovingParticles& moving, const FaceJumps& jumps, const SizingFunction& sizing,
    const ParallelFor& parallelFor)
    : Moving(moving)
    , Jumps(jumps)
    , Sizing(sizing)
    , Parallel(parallelFor)
    , Pending(moving.count())
  {
    this->Result.particles.reserve(moving.size());
    this->Result.particles.resize(moving.count());
    this->Result.converged.resize(moving.count(), 0);
    std::iota(this->Pending.begin(), this->Pending.end(), 0);
  }

  FinishedParticles run()
  {
    // Newton steps for all at once. Chosen by experiment: few particles are left to follow one by one then, which takes
    // longer a particle.
    constexpr int passes = 3;
    for (int pass = 0; pass < passes; ++pass)
    {
      this->stepAll();
    }
    this->followSingly();
    this->Result.evaluations = this->Evaluations;
    return std::move(this->Result);
  }

private:
  void stepAll();
  void followSingly();
  bool finish(int i, const Location& place, const Jet& jet);

  MovingParticles& Moving;
  const FaceJumps& Jumps;
  const SizingFunction& Sizing;
  const ParallelFor& Parallel;
  std::vector<int> Pending;
  std::atomic<std::int64_t> Evaluations{ 0 };
  FinishedParticles Result;
};

/// Makes particle i of a place that lies on the surface to the tolerance.
/// \return whether the place does
bool Finish::finish(int i, const Location& place, const Jet& jet)
{
  const Isosurface& surface = this->Moving.surface();
  const FieldPoint point = fieldPoint(jet, surface.isovalue);
  const double slope = length(point.gradient);
  const double residual = std::abs(point.value) / slope;
  if (point.map.singular || !std::isfinite(residual) ||
    !surface.holds(point, this->Moving.patches()[i].spacing) || !isNearInReference(point))
  {
    return false;
  }
  const bool isSame =
    this->Sizing.angularDensity == 0.0 && this->Moving.proxy().spacingPlaces() == 0;
  const double spacing = isSame ? this->Sizing.spacing : this->Moving.patches()[i].spacing;
  this->Result.particles[i] =
    particleAt(place, point, curvature(point.gradient, worldHessian(jet, point)), spacing);
  offerFaces(surface, this->Jumps, jet, point, this->Result.particles[i]);
  markCellBorders(*surface.mesh, jet, point.map, this->Result.particles[i]);
  this->Result.converged[i] = 1;
  this->Moving.place(i, place, point);
  return true;
}

/// Evaluates the pending particles where Newton's method takes them. Particles on the surface to the tolerance are
/// finished, the others stay pending.
void Finish::stepAll()
{
  const ElementMesh& mesh = *this->Moving.surface().mesh;
  std::vector<int>& pending = this->Pending;
  std::vector<Location> places(pending.size());
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(pending.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::int64_t cost = 0;
      for (std::ptrdiff_t n = begin; n < end; ++n)
      {
        places[n] = this->Moving.onSurface(pending[n], cost);
      }
      this->Evaluations += cost;
    });
  const std::vector<int> order = orderByElement(places, mesh.elements.size(), this->Parallel);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(pending.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      evaluateInOrder(mesh, places, order, begin, end,
        [&](int n, const Jet& jet)
        {
          if (!this->finish(pending[n], places[n], jet))
          {
            this->Moving.renew(pending[n], places[n], jet);
          }
        });
      this->Evaluations += end - begin;
    });
  pending.erase(std::remove_if(pending.begin(), pending.end(),
                  [this](int i) { return this->Result.converged[i]; }),
    pending.end());
}

/// Follows the particles that are still pending, each on its own. Where the field jumps through the isovalue, each side
/// of a face sends Newton's method to the other side: a particle there goes to where the surface of its element ends.
void Finish::followSingly()
{
  if (this->Pending.empty())
  {
    return;
  }
  const Isosurface& surface = this->Moving.surface();
  const std::vector<float> noTolerances(faceSlot(surface.mesh->elements.size(), 0), 0.0f);
  Isosurface sealed = surface.endingWhereItMay();
  sealed.jumpTolerances = &noTolerances;
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(this->Pending.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      SurfaceWalker across(surface);
      SurfaceWalker inside(sealed);
      for (std::ptrdiff_t n = begin; n < end; ++n)
      {
        const int i = this->Pending[n];
        const Location& start = this->Moving.anchors()[i].place;
        const double reach = this->Moving.patches()[i].spacing;
        Evaluated at;
        if (across.project(start, reach, at) || inside.project(start, reach, at))
        {
          this->finish(i, at.location, exactHessian(*surface.mesh, at.location));
          ++this->Evaluations;
        }
      }
      this->Evaluations += across.evaluations() + inside.evaluations();
    });
}

} // namespace

FinishedParticles finishParticles(MovingParticles& moving, const FaceJumps& jumps,
  const SizingFunction& sizing, const ParallelFor& parallelFor)
{
  return Finish(moving, jumps, sizing, parallelFor).run();
}

} // namespace hop
