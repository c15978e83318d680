#include "Run/SurfaceWorker.h"

#include "Classic/ClassicDistribution.h"
#include "Fast/FastDistribution.h"
#include "Run/MeshRepair.h"
#include "Run/ParticleLimit.h"
#include "Run/RunMesh.h"
#include "Run/RunMessages.h"
#include "Run/SpacingAdvice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace hop
{

SurfaceWorker::SurfaceWorker(const ElementMesh& mesh, const RankBlocks& blocks,
  const RunProperties& properties, const RunScale& scale, const RunCaller& caller,
  PreviousRun& previous)
  : Mesh(mesh)
  , Blocks(blocks)
  , Properties(properties)
  , Scale(scale)
  , Caller(caller)
  , Previous(previous)
{
}

void SurfaceWorker::distribute(
  double fieldIsovalue, std::size_t number, const Work& work, IsovalueParticles& some) const
{
  // The share of the work after which the particles are there; it only moves the progress bar.
  constexpr double distributed = 0.8;
  const RunOrigin origin = this->makeOrigin(some.isovalue);
  const bool continues = this->Properties.isWarmStart && !this->Properties.isClassic;
  DistributionParameters parameters = origin.parameters;
  if (continues)
  {
    parameters.start = this->Previous.startOf(number, origin, this->Mesh);
  }
  const auto method = this->Properties.isClassic ? distributeClassic : distributeFast;
  MeshedSurface surface{ { &this->Mesh, fieldIsovalue, this->Scale.tolerance }, {}, {} };
  if (parameters.onCreases)
  {
    parameters.boxes = &surface.boxes;
  }
  const Work first = work.part(0.0, distributed);
  Distribution& distribution = some.distribution;
  distribution = method(surface.surface, parameters, first.monitor, first.parallelFor);
  if (continues)
  {
    this->Previous.remember(number, origin, this->Mesh, distribution, work.parallelFor);
  }
  if (!distribution.report.aborted)
  {
    const bool isCut = !parameters.polygon.isEverything();
    addMesh(surface.surface, surface, this->Properties.outputType, this->Properties.order, isCut,
      some, work.part(distributed, 1.0));
    if (!this->Properties.isClassic && !isCut)
    {
      const Work last = work.part(1.0, 1.0);
      MeshRepair(surface, parameters, this->Properties, last).run(some);
    }
  }
  this->review(some.isovalue, fieldIsovalue, distribution, work.part(1.0, 1.0));
  if (!distribution.report.aborted)
  {
    this->Caller.tell(reviewMesh(this->Blocks, this->Mesh, some, this->Scale.unit));
  }
}

/// The sizing function with a spacing on flat surfaces, in units of the run. Nothing closer than the tolerance is told
/// apart, so that no smallest spacing is below it.
SizingFunction SurfaceWorker::sizingAt(double spacing) const
{
  const double smallest = this->Properties.smallestSpacing;
  return { spacing, this->Properties.angularDensity,
    smallest > 0.0 ? std::max(smallest / this->Scale.unit, this->Scale.tolerance) : 0.0 };
}

/// What an isosurface is made of.
RunOrigin SurfaceWorker::makeOrigin(double isovalue) const
{
  RunOrigin origin = this->Blocks.origin();
  origin.isovalue = isovalue;
  origin.averaged = this->Properties.averaged;
  origin.nodeSpacing = this->Properties.nodeSpacing;
  origin.unit = this->Scale.unit;
  origin.parameters.sizing = this->sizingAt(this->Scale.spacing);
  origin.parameters.quality = this->Properties.quality;
  origin.parameters.seed = this->Properties.seed;
  origin.parameters.onCreases = this->Properties.outputType != OutputType::Particles;
  origin.parameters.particleCount = this->Properties.numberOfParticles;
  origin.parameters.particleLimit = particlesThatFit();
  origin.parameters.polygon = this->polygonOf(isovalue);
  return origin;
}

/// To what an isosurface is cut, in units of the run.
PlanePolygon SurfaceWorker::polygonOf(double isovalue) const
{
  if (this->Properties.polygons.empty())
  {
    return {};
  }
  const std::vector<double>& isovalues = this->Properties.isovalues;
  const auto index = std::find(isovalues.begin(), isovalues.end(), isovalue) - isovalues.begin();
  return this->Properties.polygons[index].scaled(1.0 / this->Scale.unit);
}

void SurfaceWorker::review(
  double isovalue, double fieldIsovalue, const Distribution& distribution, const Work& work) const
{
  this->Caller.tell(
    reviewDistribution(this->Blocks, distribution, isovalue, this->Properties.numberOfParticles));
  if (!distribution.report.aborted && hasTooManyUndersampled(distribution))
  {
    this->reviewSpacing(isovalue, fieldIsovalue, distribution, work);
  }
}

/// Tells of places where the surface bends faster than the particles can follow, and what it takes to follow it.
void SurfaceWorker::reviewSpacing(
  double isovalue, double fieldIsovalue, const Distribution& distribution, const Work& work) const
{
  const std::int64_t number = this->Properties.numberOfParticles;
  const auto countAt = [&](double spacing)
  {
    const std::vector<double> counts =
      particlesPerElement({ &this->Mesh, fieldIsovalue, this->Scale.tolerance },
        this->sizingAt(spacing), work.monitor, work.parallelFor);
    return std::accumulate(counts.begin(), counts.end(), 0.0);
  };
  const SpacingAdvice advice = adviseSpacing(distribution,
    this->sizingAt(number > 0 ? 0.0 : this->Scale.spacing), this->Scale.unit, countAt);
  const int worst = distribution.particles[advice.worst].location.element;
  this->Caller.tell({ reviewUndersampled(
    this->Blocks, distribution, advice, this->Mesh.elements[worst].cell, isovalue, number) });
}

} // namespace hop
