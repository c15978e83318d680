#include "Run/MeshRepair.h"

#include "Fast/FastDistribution.h"
#include "Mesh/LiftedField.h"
#include "Support/Interruptible.h"

#include <algorithm>
#include <functional>
#include <iterator>
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

/// Turned triangles that are as bad as a particle without a triangle; chosen by experiment. Larger: sheets that nearly cross
/// come back through each other; smaller: holes stay for the sake of few slivers.
constexpr std::int64_t turnedPerParticle = 10;

/// Particles without a triangle that are as bad as a hole, at which the mesh lacks an area; chosen by experiment.
constexpr std::int64_t particlesPerHole = 5;

/// How bad a mesh is: what it lacks, and triangles that are turned away.
std::int64_t faultsOf(const ParticleMesh& mesh)
{
  const std::int64_t lack = lackOf(mesh) + (particlesPerHole - 1) * mesh.openLoops;
  return turnedPerParticle * lack + mesh.turnedTriangles;
}

/// What was found of singular places is said of the surface itself, not of the lifted one.
void keepFindings(const DistributionReport& own, DistributionReport& lifted)
{
  lifted.boxesUndecided = own.boxesUndecided;
  lifted.undecidedCells = own.undecidedCells;
  lifted.singularPoints = own.singularPoints;
}

/// Whether a mesh has faults, and so few of them that they are places of their own: those of noise, and of surfaces that
/// bend faster than the spacing follows, are not mended by a few particles more.
bool hasFewFaults(const IsovalueParticles& some)
{
  constexpr std::int64_t few = 300;          // particles at faults
  constexpr std::int64_t particlesEach = 20; // all particles for each one of them
  const auto faults = static_cast<std::int64_t>(some.mesh.atFaults.size());
  return faults > 0 && (faults <= few || particlesEach * faults <= some.mesh.particles);
}

/// Asks for particles nearer to each other around the faults of a mesh than they are; elsewhere they stay.
/// \param least spacing
/// \param inPieces whether the surface is to end around the elements of the faults
/// \param around the parameters of these particles
void changeAroundFaults(
  const IsovalueParticles& some, double least, bool inPieces, DistributionParameters& around)
{
  // Of the spacings at faults. Larger: strips stay narrower than a spacing; smaller: new faults around them.
  constexpr double nearer = 0.5;
  const Buffer<Particle>& particles = some.distribution.particles;
  around.start.clear();
  for (const Particle& particle : particles)
  {
    around.start.push_back(particle.location);
  }
  around.changedAround.clear();
  for (const int p : some.mesh.atFaults)
  {
    const Particle& particle = particles[p];
    if (inPieces)
    {
      around.endedElements.push_back(particle.location.element);
    }
    Patch place;
    place.position = particle.position.xyz;
    place.normal = glm::vec3(particle.normal.xyz);
    place.spacing = static_cast<float>(std::max(nearer * particle.spacing, least));
    around.changedAround.push_back(place);
    around.spacingLimits.push_back({ place.position, place.spacing });
  }
}

} // namespace

void MeshRepair::run(IsovalueParticles& some)
{
  // Particles of all tries together. More: noise takes much longer than its particles do; fewer: holes stay.
  constexpr std::int64_t alwaysAllowed = 400000;
  constexpr std::int64_t timesOwn = 4;
  if (this->Properties.outputType == OutputType::Particles || lackOf(some.mesh) == 0)
  {
    return;
  }
  this->ParticlesLeft = std::max(alwaysAllowed, timesOwn * some.mesh.particles);
  const bool isDiscontinuous = some.distribution.report.hasJumps();
  const bool isLiftable = !isDiscontinuous && isOpen(some.mesh);
  // Around singular points more particles are of little use.
  const bool besideFirst = isLiftable && some.distribution.report.singularPoints > 0;
  if (!isDiscontinuous)
  {
    this->meshBesideNodes(some);
  }
  if (besideFirst)
  {
    this->meshBeside(some);
  }
  this->meshAroundFaults(isDiscontinuous, some);
  if (isLiftable && !besideFirst && this->meshBeside(some))
  {
    this->meshAroundFaults(isDiscontinuous, some);
  }
}

/// Distributes and joins particles anew on a surface that is lifted where nodes have the isovalue, or nearly so: by little,
/// and by more if holes are left.
/// \param some whose mesh lacks something; replaced where a new one lacks less and is of the same surface
void MeshRepair::meshBesideNodes(IsovalueParticles& some)
{
  // Chosen by experiment, see liftedMesh(). In spacings of a fiftieth of an element particles do not find back from the
  // larger height; in spacings of an element the smaller one leaves holes.
  constexpr double heights[] = { 1e-3, 5e-3 };
  bool isBetter = true;
  for (std::size_t i = 0; i < std::size(heights) && isBetter && (i == 0 || isOpen(some.mesh)); ++i)
  {
    isBetter = this->meshBesideNodes(heights[i], some);
  }
}

/// The same on surfaces of values beside the isovalue, as long as something is lacking or triangles are turned: above it,
/// then below.
/// \return whether one was taken
bool MeshRepair::meshBeside(IsovalueParticles& some)
{
  // How far beside. Chosen by experiment. Larger: particles do not find back, parts of the surface are lost, and triangles
  // turn over; smaller: sheets are nearer to each other than particles can tell apart. So a smaller one is next where
  // there is no mesh, as where spacings are small, or triangles are turned alone, and a larger one where it has holes.
  constexpr double height = 1e-4;
  constexpr double factor = 10.0;
  const auto isLacking = [&some] { return lackOf(some.mesh) > 0 || some.mesh.turnedTriangles > 0; };
  bool isTaken = false;
  for (const double side : { 1.0, -1.0 })
  {
    double beside = height;
    for (int n = 0; n < 2 && isLacking(); ++n)
    {
      auto lifted = std::make_unique<LiftedSurface>();
      lifted->surface = this->Surface;
      lifted->surface.isovalue += side * beside;
      const Try outcome = this->meshOn(std::move(lifted), some);
      isTaken = isTaken || outcome == Try::Better;
      const bool isTooFar = outcome == Try::None || lackOf(some.mesh) == 0;
      beside = isTooFar ? beside / factor : beside * factor;
    }
  }
  return isTaken;
}

/// The same by one height where nodes have the isovalue.
/// \return whether the mesh was replaced
bool MeshRepair::meshBesideNodes(double height, IsovalueParticles& some)
{
  auto lifted = std::make_unique<LiftedSurface>();
  lifted->mesh = liftedMesh(*this->Surface.mesh, this->Surface.isovalue,
    isOpen(some.mesh) ? LiftedValues::Near : LiftedValues::Isovalue, height);
  if (!lifted->mesh)
  {
    return false;
  }
  lifted->surface = this->Surface;
  lifted->surface.mesh = &*lifted->mesh;
  return this->meshOn(std::move(lifted), some) == Try::Better;
}

/// The same on a lifted surface.
MeshRepair::Try MeshRepair::meshOn(std::unique_ptr<LiftedSurface> lifted, IsovalueParticles& some)
{
  auto other = this->meshAnew(*lifted, this->Parameters, some.isovalue);
  if (!other)
  {
    return Try::None;
  }
  const bool isBetter = this->takeBetter(std::move(*other), true, some);
  if (isBetter)
  {
    this->Lifted = std::move(lifted);
  }
  return isBetter ? Try::Better : Try::Worse;
}

/// Distributes and joins particles anew, nearer to each other around the faults of a mesh, on the surface on which they
/// stand. That of a discontinuous field ends there at all faces of the elements: in pieces of one element no curve has to
/// find its way to another one.
/// \param inPieces whether the field is discontinuous
/// \param some whose mesh is open; replaced where a new one lacks less
void MeshRepair::meshAroundFaults(bool inPieces, IsovalueParticles& some)
{
  // Chosen by experiment. More: what stays is seldom mended later; fewer: holes stay that would be closed.
  constexpr int mostTimes = 5;
  MeshedSurface& own = this->Lifted ? *this->Lifted : this->Whole;
  DistributionParameters around = this->Parameters;
  // Nothing closer than the tolerance is told apart.
  const double least = std::max(this->Surface.tolerance, around.sizing.smallestSpacing);
  changeAroundFaults(some, least, inPieces, around);
  if (around.quality == Quality::Draft)
  {
    // Too uneven to be changed here and there.
    around.quality = Quality::Standard;
    around.start.clear();
    around.changedAround.clear();
    own.boxes.clear();
  }
  // Tries in a row that lack more than the best one. More: time; fewer: what the next one would close stays open.
  constexpr int mostRises = 2;
  std::int64_t leastLack = lackOf(some.mesh);
  int rises = 0;
  for (int n = 0; n < mostTimes && rises < mostRises && hasFewFaults(some); ++n)
  {
    auto other = this->meshAnew(own, around, some.isovalue);
    if (!other)
    {
      return;
    }
    changeAroundFaults(*other, least, inPieces, around);
    const std::int64_t lacks = lackOf(other->mesh);
    rises = lacks > leastLack ? rises + 1 : 0;
    leastLack = std::min(leastLack, lacks);
    this->takeBetter(std::move(*other), false, some);
  }
}

/// Distributes and joins particles anew.
/// \param own see hop::addMesh()
/// \return nothing if there are no particles, or not all of them are on the surface, or enough was tried
std::optional<IsovalueParticles> MeshRepair::meshAnew(
  MeshedSurface& own, DistributionParameters parameters, double isovalue)
{
  if (this->ParticlesLeft <= 0)
  {
    return std::nullopt;
  }
  parameters.boxes = this->Parameters.boxes ? &own.boxes : nullptr;
  IsovalueParticles some;
  some.isovalue = isovalue;
  some.distribution =
    distributeFast(own.surface, parameters, this->Task.monitor, this->Task.parallelFor);
  this->ParticlesLeft -= static_cast<std::int64_t>(some.distribution.particles.size());
  const bool isMeshed = !some.distribution.report.aborted && !some.distribution.particles.empty() &&
    addMesh(this->Surface, own, this->Properties.outputType, this->Properties.order, false, some,
      this->Task);
  return isMeshed ? std::optional<IsovalueParticles>(std::move(some)) : std::nullopt;
}

/// Takes another mesh in place of one if it is better.
/// \param onAnother whether the particles of the two stood on different surfaces, one of them lifted
/// \return whether it was taken
bool MeshRepair::takeBetter(IsovalueParticles other, bool onAnother, IsovalueParticles& some) const
{
  const bool isBetter = this->isInPlaceOf(some, other, onAnother);
  if (isBetter)
  {
    keepFindings(some.distribution.report, other.distribution.report);
    some = std::move(other);
  }
  return isBetter;
}

/// Whether another mesh, of a lifted surface or with particles nearer to each other, is better than one, and of all of it.
/// \param onAnother see takeBetter()
bool MeshRepair::isInPlaceOf(
  const IsovalueParticles& own, const IsovalueParticles& other, bool onAnother) const
{
  // Of the triangles, turned ones that look like noise rather than like a few slivers.
  constexpr std::int64_t onePercent = 100;
  const auto triangles =
    static_cast<std::int64_t>(other.mesh.nodes.size()) / other.mesh.nodesPerCell;
  Interruptible loops(this->Task.monitor, this->Task.parallelFor);
  return faultsOf(other.mesh) < faultsOf(own.mesh) &&
    other.mesh.openLength <= own.mesh.openLength &&
    other.mesh.turnedTriangles <=
    std::max({ own.mesh.turnedTriangles, triangles / onePercent, turnedPerParticle }) &&
    !(onAnother && hasMoreSheets(other.distribution, own.distribution)) &&
    isCoveredBy(own.distribution.particles, own.mesh.nodes, other.distribution.particles,
      other.mesh.nodes, std::ref(loops));
}

} // namespace hop
