#include "Fast/FastDistribution.h"

#include "Fast/FastSystem.h"
#include "Fast/GivenNumber.h"
#include "Fast/PackingRepair.h"
#include "Isolation/UndecidedBoxes.h"

#include <cmath>
#include <utility>

namespace hop
{
/// All stages but the last, one after the other.
/// \return whether there are particles
bool FastSystem::relax()
{
  if (!this->estimateCount())
  {
    return false;
  }
  if (this->countIsGiven())
  {
    this->matchSpacing(this->Parameters.particleCount);
  }
  else
  {
    this->prepareSurface();
  }
  reportUndecided(this->Surface,
    this->Part.isEverything() ? this->Proxy->boxes() : this->undecidedBoxes(), this->Result.report);
  this->Result.report.boxes = static_cast<std::int64_t>(this->Proxy->boxes().size());
  this->reach(ProgressAt::Prepared);
  const double count = this->Proxy->particleCount();
  if (count <= 0.0 || this->tooMany(count))
  {
    return false;
  }
  this->Work.expect(this->countIsGiven() ? static_cast<double>(this->Parameters.particleCount)
                                         : this->targetCount());
  this->makeSeeds(std::llround(count));
  this->relaxInRounds();
  return true;
}

std::vector<double> FastSystem::countsOfElements()
{
  std::vector<double> counts(this->Mesh.elements.size(), 0.0);
  if (counts.empty())
  {
    return counts;
  }
  this->prepareSurface();
  for (std::size_t e = 0; e < counts.size(); ++e)
  {
    counts[e] = this->Proxy->particleCount(static_cast<int>(e));
  }
  for (const BoundaryParticle& boundary : this->Curves.particles)
  {
    counts[boundary.particle.location.element] += OnBoundary::Count;
  }
  return counts;
}

Distribution FastSystem::run()
{
  if (!this->Mesh.elements.empty() && this->relax())
  {
    if (this->Parameters.quality != Quality::Draft)
    {
      repairPacking(*this->Moving, this->Parallel);
    }
    // Beside another sheet the last particle of a small component may have been deleted as one too many.
    this->coverBoxes({});
    if (this->countIsGiven())
    {
      DistributionParameters parameters = this->Parameters;
      parameters.particleCount = this->sizeForGivenNumber();
      matchGivenNumber(parameters, this->BoundaryPatches, *this->Moving, this->Parallel);
    }
    this->finish();
  }
  return this->takeResult();
}

/// The particles, and what they cost.
Distribution FastSystem::takeResult()
{
  DistributionReport& report = this->Result.report;
  report.evaluations = this->Evaluations + this->Locator.evaluations();
  if (this->Moving)
  {
    report.evaluations += this->Moving->evaluations();
    report.iterations = this->Moving->sweeps();
  }
  if (this->Parameters.boxes && this->Proxy)
  {
    *this->Parameters.boxes = this->Proxy->takeBoxes();
  }
  return std::move(this->Result);
}

Distribution distributeFast(const Isosurface& surface, const DistributionParameters& parameters,
  const Monitor& monitor, const ParallelFor& parallelFor)
{
  return unlessInterrupted(
    [&]() { return FastSystem(surface, parameters, monitor, parallelFor).run(); });
}

std::vector<double> particlesPerElement(const Isosurface& surface, const SizingFunction& sizing,
  const Monitor& monitor, const ParallelFor& parallelFor)
{
  DistributionParameters parameters;
  parameters.sizing = sizing;
  return FastSystem(surface, parameters, monitor, parallelFor).countsOfElements();
}

} // namespace hop
