#include "Run/SurfaceWorker.h"

#include "Classic/ClassicDistribution.h"
#include "Fast/FastDistribution.h"
#include "Run/ParticleLimit.h"
#include "Run/RunMessages.h"
#include "Run/SpacingAdvice.h"

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

Distribution SurfaceWorker::distribute(
  double isovalue, double fieldIsovalue, std::size_t number, const Work& work) const
{
  const RunOrigin origin = this->makeOrigin(isovalue);
  const bool continues = this->Properties.isWarmStart && !this->Properties.isClassic;
  DistributionParameters parameters = origin.parameters;
  if (continues)
  {
    parameters.start = this->Previous.startOf(number, origin, this->Mesh);
  }
  const auto method = this->Properties.isClassic ? distributeClassic : distributeFast;
  Distribution distribution = method({ &this->Mesh, fieldIsovalue, this->Scale.tolerance },
    parameters, work.monitor, work.parallelFor);
  if (continues)
  {
    this->Previous.remember(number, origin, this->Mesh, distribution, work.parallelFor);
  }
  this->review(isovalue, fieldIsovalue, distribution, work.part(1.0, 1.0));
  return distribution;
}

/// What an isosurface is made of.
RunOrigin SurfaceWorker::makeOrigin(double isovalue) const
{
  RunOrigin origin = this->Blocks.origin();
  origin.isovalue = isovalue;
  origin.nodeSpacing = this->Properties.nodeSpacing;
  origin.unit = this->Scale.unit;
  origin.parameters.sizing = { this->Scale.spacing, this->Properties.angularDensity };
  origin.parameters.quality = this->Properties.quality;
  origin.parameters.seed = this->Properties.seed;
  origin.parameters.particleCount = this->Properties.numberOfParticles;
  origin.parameters.particleLimit = particlesThatFit();
  return origin;
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
  const double density = this->Properties.angularDensity;
  const auto countAt = [&](double spacing)
  {
    const std::vector<double> counts =
      particlesPerElement({ &this->Mesh, fieldIsovalue, this->Scale.tolerance },
        { spacing, density }, work.monitor, work.parallelFor);
    return std::accumulate(counts.begin(), counts.end(), 0.0);
  };
  const SpacingAdvice advice = adviseSpacing(
    distribution, { number > 0 ? 0.0 : this->Scale.spacing, density }, this->Scale.unit, countAt);
  const int worst = distribution.particles[advice.worst].location.element;
  this->Caller.tell({ reviewUndersampled(
    this->Blocks, distribution, advice, this->Mesh.elements[worst].cell, isovalue, number) });
}

} // namespace hop
