#include "Run/SurfaceWorker.h"

#include "Classic/ClassicDistribution.h"
#include "Fast/FastDistribution.h"
#include "Mesh/LiftedField.h"
#include "Run/ParticleLimit.h"
#include "Run/RunMesh.h"
#include "Run/RunMessages.h"
#include "Run/SpacingAdvice.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

namespace hop
{

namespace
{

/// Whether a lifted field seems to have sheets that the field itself has not, by the numbers of particles: two instead of
/// one where it touches the isovalue and does not cross it.
bool hasMoreSheets(const Distribution& lifted, const Distribution& own)
{
  // Two sheets have twice as many; particles that holes lack are some tenths.
  constexpr double more = 1.8;
  return static_cast<double>(lifted.particles.size()) >
    more * static_cast<double>(own.particles.size());
}

/// Whether a mesh has holes, or particles without a triangle.
bool isOpen(const ParticleMesh& mesh)
{
  return mesh.openLoops > 0 || mesh.unusedParticles > 0;
}

/// How bad a mesh is: what it lacks, and triangles that are turned away.
std::int64_t faultsOf(const ParticleMesh& mesh)
{
  // Turned triangles that are as bad as a hole; chosen by experiment. Larger: sheets that nearly cross come back through
  // each other; smaller: holes stay for the sake of few slivers.
  constexpr std::int64_t turnedPerHole = 10;
  return turnedPerHole * lackOf(mesh) + mesh.turnedTriangles;
}

/// Whether a mesh of a lifted surface is better than the surface's own, and of all of it.
bool isInPlaceOf(const IsovalueParticles& own, const IsovalueParticles& lifted)
{
  // Of the triangles, turned ones that look like noise rather than like a few slivers.
  constexpr std::int64_t onePercent = 100;
  const auto triangles =
    static_cast<std::int64_t>(lifted.mesh.nodes.size()) / lifted.mesh.nodesPerCell;
  return faultsOf(lifted.mesh) < faultsOf(own.mesh) &&
    lifted.mesh.turnedTriangles <= std::max(own.mesh.turnedTriangles, triangles / onePercent) &&
    !hasMoreSheets(lifted.distribution, own.distribution) &&
    isCoveredBy(
      own.distribution.particles, own.mesh.nodes, lifted.distribution.particles, lifted.mesh.nodes);
}

/// What was found of singular places is said of the surface itself, not of the lifted one.
void keepFindings(const DistributionReport& own, DistributionReport& lifted)
{
  lifted.boxesUndecided = own.boxesUndecided;
  lifted.undecidedCells = own.undecidedCells;
  lifted.singularPoints = own.singularPoints;
}

} // namespace

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
  const Isosurface surface{ &this->Mesh, fieldIsovalue, this->Scale.tolerance };
  const Work first = work.part(0.0, distributed);
  Distribution& distribution = some.distribution;
  distribution = method(surface, parameters, first.monitor, first.parallelFor);
  if (continues)
  {
    this->Previous.remember(number, origin, this->Mesh, distribution, work.parallelFor);
  }
  if (!distribution.report.aborted)
  {
    this->addMesh(surface, surface, parameters, work.part(distributed, 1.0), some);
    const bool isMesh = this->Properties.outputType != OutputType::Particles;
    if (isMesh && lackOf(some.mesh) > 0 && !this->Properties.isClassic &&
      parameters.polygon.isEverything())
    {
      this->meshLifted(surface, parameters, work.part(1.0, 1.0), some);
    }
  }
  this->review(some.isovalue, fieldIsovalue, distribution, work.part(1.0, 1.0));
  if (!distribution.report.aborted)
  {
    this->Caller.tell(reviewMesh(this->Blocks, this->Mesh, some, this->Scale.unit));
  }
}

/// Joins the particles to the mesh that is asked for.
/// \param own see hop::addMesh()
/// \return whether all particles are on the surface
bool SurfaceWorker::addMesh(const Isosurface& surface, const Isosurface& own,
  const DistributionParameters& parameters, const Work& work, IsovalueParticles& some) const
{
  return hop::addMesh(surface, own, this->Properties.outputType, this->Properties.order,
    !parameters.polygon.isEverything(), some, work.monitor, work.parallelFor);
}

/// Distributes and joins particles anew on a lifted surface: where nodes have the isovalue, or nearly so, by little, and by
/// more if holes are left; and if they are left still, all of the surface at values beside the isovalue.
/// \param some whose mesh lacks something; replaced where a new one lacks less and is of the same surface
void SurfaceWorker::meshLifted(const Isosurface& surface, const DistributionParameters& parameters,
  const Work& work, IsovalueParticles& some) const
{
  // Chosen by experiment, see liftedMesh(). In spacings of a fiftieth of an element particles do not find back from the
  // larger height; in spacings of an element the smaller one leaves holes.
  constexpr double heights[] = { 1e-3, 5e-3 };
  // The same for all of the surface, the smaller ones first. Larger: parts of the surface are lost, and triangles turn
  // over as particles are put back; smaller: sheets are nearer to each other than particles can tell apart.
  constexpr double beside[] = { 1e-4, -1e-4, 1e-3, -1e-3 };
  // Where the field jumps by more than rounding, meshes lack something for other reasons.
  constexpr double rounding = 1e-8;
  const Buffer<Particle>& particles = some.distribution.particles;
  if (std::any_of(particles.begin(), particles.end(),
        [](const Particle& particle) { return std::abs(particle.jump) > rounding; }))
  {
    return;
  }
  const bool wasOpen = isOpen(some.mesh);
  bool isBetter = true;
  for (std::size_t i = 0; i < std::size(heights) && isBetter && (i == 0 || isOpen(some.mesh)); ++i)
  {
    isBetter = this->meshBesideNodes(surface, heights[i], parameters, work, some);
  }
  Isosurface lifted = surface;
  const auto isLacking = [&some] { return isOpen(some.mesh) || some.mesh.turnedTriangles > 0; };
  for (std::size_t i = 0; i < std::size(beside) && wasOpen && isLacking(); ++i)
  {
    lifted.isovalue = surface.isovalue + beside[i];
    this->meshAnew(surface, lifted, parameters, work, some);
  }
}

/// The same by one height where nodes have the isovalue.
/// \return whether the mesh was replaced
bool SurfaceWorker::meshBesideNodes(const Isosurface& surface, double height,
  const DistributionParameters& parameters, const Work& work, IsovalueParticles& some) const
{
  const std::optional<ElementMesh> mesh = liftedMesh(this->Mesh, surface.isovalue,
    isOpen(some.mesh) ? LiftedValues::Near : LiftedValues::Isovalue, height);
  if (!mesh)
  {
    return false;
  }
  Isosurface lifted = surface;
  lifted.mesh = &*mesh;
  return this->meshAnew(surface, lifted, parameters, work, some);
}

/// The same on one lifted surface.
/// \return whether the mesh was replaced
bool SurfaceWorker::meshAnew(const Isosurface& surface, const Isosurface& lifted,
  const DistributionParameters& parameters, const Work& work, IsovalueParticles& some) const
{
  IsovalueParticles other;
  other.isovalue = some.isovalue;
  other.distribution = distributeFast(lifted, parameters, work.monitor, work.parallelFor);
  const bool isBetter = !other.distribution.report.aborted &&
    !other.distribution.particles.empty() &&
    this->addMesh(surface, lifted, parameters, work, other) && isInPlaceOf(some, other);
  if (isBetter)
  {
    keepFindings(some.distribution.report, other.distribution.report);
    some = std::move(other);
  }
  return isBetter;
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
