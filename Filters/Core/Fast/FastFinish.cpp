#include "Fast/FastSystem.h"

#include "Edges/ClipPlanes.h"
#include "Edges/SmallComponents.h"
#include "Fast/LeastParticles.h"
#include "Fast/PatchDistances.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace hop
{
namespace
{

/// Least distance between particles of drafts, in units of their spacing; see MinimumSeparation. Pairs are many in one
/// round without a repair. Chosen by experiment. Larger: holes where particles were dropped; smaller: pairs that crowd.
constexpr double draftSeparation = 0.4;

/// Smallest spacing on components that would have too few particles, in units of the tolerance: where particles are as
/// near as that, they do not tell the surface from its neighbourhood.
constexpr double finestPerTolerance = 100.0;

} // namespace

/// Takes all particles to the tolerance, and evaluates there what belongs to a finished particle. In a slab the particles
/// of other slabs are there as neighbours, and are dropped at last.
void FastSystem::finish()
{
  FinishedParticles finished =
    finishParticles(*this->Moving, this->Jumps, this->Sizing, this->Parallel);
  this->Evaluations += finished.evaluations;
  DistributionReport& report = this->Result.report;
  std::vector<char>& kept = finished.converged;
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    report.particlesRejected += !kept[i] && (this->IsOwn.empty() || this->IsOwn[i]);
  }
  this->dropBeyondPolygon(finished.particles, kept);
  if (!this->countIsGiven())
  {
    const bool isDraft = this->Parameters.quality == Quality::Draft;
    kept = thinOut(
      this->Moving->patches(), kept, isDraft ? draftSeparation : MinimumSeparation, this->Parallel);
  }
  Buffer<Particle>& particles = this->Result.particles;
  particles = std::move(finished.particles);
  particles.resize(closeGaps(particles, particles.size(), kept));
  this->IsOwn.resize(closeGaps(this->IsOwn, this->IsOwn.size(), kept));
  this->fillSparseComponents();
  const ParticleGrid all(particles, this->Curves.particles, this->Parallel);
  markClipPlanes(this->Surface, all, this->Curves.thinned, this->Parallel);
  const int first = static_cast<int>(particles.size());
  const auto addAll = [first](const std::vector<std::array<int, 2>>& pairs)
  {
    std::vector<std::array<int, 2>> result;
    result.reserve(pairs.size());
    for (const auto& [a, b] : pairs)
    {
      result.push_back({ first + a, first + b });
    }
    return result;
  };
  const SurfaceEdges& edges = this->Curves.edges;
  this->Result.edges = { addAll(edges.segments), addAll(edges.directed), addAll(edges.coincident) };
  this->Result.pieces = std::move(this->Curves.pieces);
  for (const BoundaryParticle& boundary : this->Curves.particles)
  {
    particles.push_back(boundary.particle);
  }
  const FacePassages faces =
    countFacePassages(this->Mesh, *this->Proxy, this->Jumps, this->Parallel);
  report.facesReached = faces.reached;
  report.facesEnded = faces.ended;
  report.largestJump = this->Jumps.largestJump;
  fitSmallComponents(*this->Proxy, all, particles, this->Parallel);
  this->dropOthers();
  report.particlesUndersampled = std::count_if(
    particles.begin(), particles.end(), [](const Particle& p) { return p.isUndersampled(); });
}

/// Which worker distributes particles on a component of few: the one in whose slab it begins, unless it reaches so far
/// across a plane between two slabs that not both workers know all of its particles.
FastSystem::ComponentHome FastSystem::homeOf(const SparseComponent& component) const
{
  if (this->Part.isEverything())
  {
    return ComponentHome::Here;
  }
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (const int b : component.boxes)
  {
    const double place = this->Part.placeOf(this->Proxy->samples()[b].patch.position);
    first = std::min(first, place);
    last = std::max(last, place);
  }
  // Where the particles of two slabs meet.
  const Slab meeting = this->Part.shifted(this->overlap(SlabOverlap::Strip));
  for (const double plane : { meeting.begin, meeting.end })
  {
    if (first <= plane && last > plane + this->overlap(SlabOverlap::Sight))
    {
      return ComponentHome::Unknown;
    }
  }
  return meeting.begin < first && first <= meeting.end ? ComponentHome::Here
                                                       : ComponentHome::Elsewhere;
}

/// Replaces the finished particles of closed components that have too few.
void FastSystem::fillSparseComponents()
{
  Buffer<Particle>& particles = this->Result.particles;
  // Particles that are changed in places were filled in before.
  if (this->countIsGiven() || !this->Parameters.changedAround.empty())
  {
    return;
  }
  std::vector<SparseComponent> own;
  std::vector<char> kept(particles.size(), 1);
  for (SparseComponent& component : findSparseComponents(
         this->Surface, *this->Proxy, this->Moving->patches(), particles, this->Parallel))
  {
    const ComponentHome home = this->homeOf(component);
    if (home != ComponentHome::Unknown)
    {
      std::for_each(
        component.particles.begin(), component.particles.end(), [&](int i) { kept[i] = 0; });
    }
    if (home == ComponentHome::Here)
    {
      own.push_back(std::move(component));
    }
  }
  keepMarked(particles, kept);
  keepMarked(this->IsOwn, kept);
  if (own.empty())
  {
    return;
  }
  const double finest =
    std::max(finestPerTolerance * this->Surface.tolerance, this->Sizing.smallestSpacing);
  const FinishedParticles added = distributeOnComponents(
    this->Surface, *this->Proxy, this->Jumps, own, finest, this->Parameters.seed, this->Parallel);
  particles.insert(particles.end(), added.particles.begin(), added.particles.end());
  this->IsOwn.resize(this->Part.isEverything() ? 0 : particles.size(), 1);
  this->Evaluations += added.evaluations;
}

/// Drops finished particles that are at home in other slabs.
void FastSystem::dropOthers()
{
  if (this->Part.isEverything())
  {
    return;
  }
  Buffer<Particle>& particles = this->Result.particles;
  const Slab own = this->Part.shifted(this->overlap(SlabOverlap::OnPlane));
  std::vector<char> kept = this->IsOwn;
  for (std::size_t i = kept.size(); i < particles.size(); ++i)
  {
    kept.push_back(own.holds(particles[i].position.xyz));
  }
  keepMarked(particles, kept);
}

} // namespace hop
