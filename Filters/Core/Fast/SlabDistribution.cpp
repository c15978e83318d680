#include "Fast/SlabDistribution.h"

#include "Fast/FastSystem.h"
#include "Fast/PackingRepair.h"
#include "Fast/PatchDistances.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <tuple>

namespace hop
{
namespace
{

void append(Buffer<Anchor>& anchors, Buffer<Patch>& patches, const SlabParticles& more)
{
  anchors.insert(anchors.end(), more.anchors.begin(), more.anchors.end());
  patches.insert(patches.end(), more.patches.begin(), more.patches.end());
}

/// Those of particles on boundary curves that a slab holds.
Buffer<BoundaryParticle> heldBy(const Slab& slab, const Buffer<BoundaryParticle>& particles)
{
  Buffer<BoundaryParticle> held;
  std::copy_if(particles.begin(), particles.end(), std::back_inserter(held),
    [&](const BoundaryParticle& some) { return slab.holds(some.patch.position); });
  return held;
}

/// Particles on boundary curves without those that are too near to the ones of the slab before.
Buffer<BoundaryParticle> apartFrom(const Buffer<BoundaryParticle>& before,
  const Buffer<BoundaryParticle>& behind, const ParallelFor& parallelFor)
{
  const auto patchesOf = [](const Buffer<BoundaryParticle>& particles)
  {
    Buffer<Patch> patches;
    for (const BoundaryParticle& some : particles)
    {
      patches.push_back(some.patch);
    }
    return patches;
  };
  return marked(behind,
    areFarFrom(
      patchesOf(behind), behind.size(), patchesOf(before), SlabOverlap::OnCurves, parallelFor));
}

} // namespace

class SlabDistribution::System : public FastSystem
{
public:
  using FastSystem::FastSystem;

  std::string relaxAlone();
  SlabParticles particlesIn(double from, double to) const;
  SlabParticles firstParticles() const;
  SlabParticles lastParticles() const;
  void settleEnd(const SlabParticles& next);
  Distribution finishAmong(const SlabParticles& before);

private:
  /// The part of space between two places.
  Slab between(double from, double to) const { return { this->Part.direction, from, to }; }
  void replaceCurves(const Slab& where, bool isBehind, const SlabParticles& by);
  void relaxStrip(const Slab& strip);
  std::vector<int> orderOf(const Buffer<Anchor>& anchors, std::size_t own) const;
  void arrangeCanonically(const SlabParticles& before);

  /// Particles of the next slab, which stay.
  SlabParticles Next;
};

std::string SlabDistribution::System::relaxAlone()
{
  const bool exist = !this->Mesh.elements.empty() && this->relax();
  if (exist && this->Parameters.quality != Quality::Draft)
  {
    repairPacking(*this->Moving, this->Parallel);
  }
  else if (!exist && this->Proxy)
  {
    this->startMoving();
  }
  return this->Result.report.error;
}

/// Particles between two places, without those on boundary curves that belong to the slab before `from`.
SlabParticles SlabDistribution::System::particlesIn(double from, double to) const
{
  SlabParticles result;
  const Slab slab = this->between(from, to);
  for (std::size_t i = 0; this->Moving && i < this->Moving->count(); ++i)
  {
    if (slab.holds(this->Moving->patches()[i].position))
    {
      result.anchors.push_back(this->Moving->anchors()[i]);
      result.patches.push_back(this->Moving->patches()[i]);
    }
  }
  return result;
}

SlabParticles SlabDistribution::System::firstParticles() const
{
  const double begin = this->Part.begin;
  const double end = begin + this->overlap(SlabOverlap::Strip + SlabOverlap::Sight);
  SlabParticles result = this->particlesIn(begin, end);
  const Slab onCurves = this->between(begin + this->overlap(SlabOverlap::OnPlane), end);
  result.onBoundary = heldBy(onCurves, this->Curves.particles);
  result.thinned = heldBy(onCurves, this->Curves.thinned);
  return result;
}

SlabParticles SlabDistribution::System::lastParticles() const
{
  constexpr double everything = std::numeric_limits<double>::infinity();
  const double end = this->Part.end;
  const double begin = end - this->overlap(SlabOverlap::Strip + SlabOverlap::Sight);
  // Particles of the strip may have moved out of it. They come behind those that stay.
  SlabParticles result = this->particlesIn(begin, everything);
  const Slab onCurves = this->between(begin, end + this->overlap(SlabOverlap::OnPlane));
  result.onBoundary = heldBy(onCurves, this->Curves.particles);
  result.thinned = heldBy(onCurves, this->Curves.thinned);
  return result;
}

/// Takes another worker's particles on boundary curves instead of one's own, behind the slab or before it. Of two
/// particles that are too near to each other the one in the slab before stays.
void SlabDistribution::System::replaceCurves(
  const Slab& where, bool isBehind, const SlabParticles& by)
{
  const auto isReplaced = [&](const BoundaryParticle& some)
  { return where.holds(some.patch.position); };
  Buffer<BoundaryParticle>& mine = this->Curves.particles;
  Buffer<BoundaryParticle>& thinned = this->Curves.thinned;
  mine.erase(std::remove_if(mine.begin(), mine.end(), isReplaced), mine.end());
  thinned.erase(std::remove_if(thinned.begin(), thinned.end(), isReplaced), thinned.end());
  Buffer<BoundaryParticle> others = by.onBoundary;
  (isBehind ? others : mine) =
    isBehind ? apartFrom(mine, others, this->Parallel) : apartFrom(others, mine, this->Parallel);
  mine.insert(mine.end(), others.begin(), others.end());
  thinned.insert(thinned.end(), by.thinned.begin(), by.thinned.end());
  this->BoundaryPatches.clear();
  for (const BoundaryParticle& some : mine)
  {
    this->BoundaryPatches.push_back(some.patch);
  }
}

void SlabDistribution::System::settleEnd(const SlabParticles& next)
{
  if (!this->Moving)
  {
    return;
  }
  constexpr double everything = std::numeric_limits<double>::infinity();
  const double end = this->Part.end;
  const double width = this->overlap(SlabOverlap::Strip);
  const Slab strip = this->between(end - width, end + width);
  this->replaceCurves(
    this->between(end + this->overlap(SlabOverlap::OnPlane), everything), true, next);
  this->keepIn(this->between(-everything, end));
  this->Moving->add(next.anchors, next.patches);
  this->Next = this->particlesIn(strip.end, everything);
  this->keepIn(this->between(-everything, strip.end));
  this->relaxStrip(strip);
}

/// Relaxes the particles of the strip at the slab's end, among others that stay.
void SlabDistribution::System::relaxStrip(const Slab& strip)
{
  const Slab seen = strip.widened(this->overlap(SlabOverlap::Sight));
  Buffer<Patch> around;
  SlabParticles before = this->particlesIn(seen.begin, strip.begin);
  for (const Buffer<Patch>* some : { &before.patches, &this->Next.patches, &this->BoundaryPatches })
  {
    std::copy_if(some->begin(), some->end(), std::back_inserter(around),
      [&](const Patch& patch) { return seen.holds(patch.position); });
  }
  for (Patch& patch : around)
  {
    patch.fixed = true;
  }
  SlabParticles inside = this->particlesIn(strip.begin, strip.end);
  this->keepIn(this->between(-std::numeric_limits<double>::infinity(), strip.begin));
  std::unique_ptr<MovingParticles> others = std::move(this->Moving);
  this->Moving = std::make_unique<MovingParticles>(
    this->Surface, *this->Proxy, std::move(around), this->Parallel);
  this->Moving->add(inside.anchors, inside.patches);
  this->Moving->keep(thinOut(this->Moving->patches(), std::vector<char>(this->Moving->count(), 1),
    MinimumSeparation, this->Parallel));
  this->TargetInSlab = this->TargetInStrip;
  this->relaxInRounds();
  if (this->Parameters.quality != Quality::Draft)
  {
    repairPacking(*this->Moving, this->Parallel);
  }
  others->append(*this->Moving);
  this->Moving = std::move(others);
}

/// The order of particles by their elements. In elements with particles of several workers it is that of their places.
/// \param own number of the particles of this worker, which come first
std::vector<int> SlabDistribution::System::orderOf(
  const Buffer<Anchor>& anchors, std::size_t own) const
{
  std::vector<int> order = orderByElement(anchors, this->Mesh.elements.size(), this->Parallel);
  std::vector<char> isShared(this->Mesh.elements.size(), 0);
  for (std::size_t i = own; i < anchors.size(); ++i)
  {
    isShared[anchors[i].place.element] = 1;
  }
  const auto comesBefore = [&](int a, int b)
  {
    const glm::dvec3& u = anchors[a].place.u.xyz;
    const glm::dvec3& v = anchors[b].place.u.xyz;
    return std::make_tuple(u.x, u.y, u.z, a) < std::make_tuple(v.x, v.y, v.z, b);
  };
  for (std::size_t first = 0; first < order.size();)
  {
    const int element = anchors[order[first]].place.element;
    std::size_t last = first + 1;
    while (last < order.size() && anchors[order[last]].place.element == element)
    {
      ++last;
    }
    if (isShared[element])
    {
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(first),
        order.begin() + static_cast<std::ptrdiff_t>(last), comesBefore);
    }
    first = last;
  }
  return order;
}

/// Puts the particles of all workers around into an order on which they agree: which of two that are too near to each
/// other stays depends on it.
void SlabDistribution::System::arrangeCanonically(const SlabParticles& before)
{
  Buffer<Anchor> anchors = this->Moving->anchors();
  Buffer<Patch> patches;
  patches.assign(this->Moving->patches().begin(),
    this->Moving->patches().begin() + static_cast<std::ptrdiff_t>(this->Moving->count()));
  const std::size_t own = anchors.size();
  append(anchors, patches, before);
  append(anchors, patches, this->Next);
  const std::vector<int> order = this->orderOf(anchors, own);
  Buffer<Anchor> sortedAnchors;
  Buffer<Patch> sortedPatches;
  sortedAnchors.reserve(order.size());
  sortedPatches.reserve(order.size());
  for (const int i : order)
  {
    sortedAnchors.push_back(anchors[i]);
    sortedPatches.push_back(patches[i]);
    this->IsOwn.push_back(static_cast<std::size_t>(i) < own);
  }
  this->startMoving();
  this->Moving->add(sortedAnchors, sortedPatches);
}

Distribution SlabDistribution::System::finishAmong(const SlabParticles& before)
{
  if (this->Moving)
  {
    const double width = this->overlap(SlabOverlap::Strip);
    constexpr double everything = std::numeric_limits<double>::infinity();
    this->keepIn(this->between(this->Part.begin + width, everything));
    this->replaceCurves(
      this->between(-everything, this->Part.begin + this->overlap(SlabOverlap::OnPlane)), false,
      before);
    this->arrangeCanonically(before);
    this->coverBoxes(this->Part.shifted(width));
    this->IsOwn.resize(this->Moving->count(), 1);
    this->finish();
  }
  return this->takeResult();
}

SlabDistribution::SlabDistribution(const Isosurface& surface,
  const DistributionParameters& parameters, const Slab& slab, const Monitor& monitor,
  const ParallelFor& parallelFor)
  : Worker(std::make_unique<System>(surface, parameters, monitor, parallelFor, slab))
{
}

SlabDistribution::~SlabDistribution() = default;

std::string SlabDistribution::relax()
{
  return this->Worker->relaxAlone();
}

SlabParticles SlabDistribution::firstParticles() const
{
  return this->Worker->firstParticles();
}

void SlabDistribution::settleEnd(const SlabParticles& next)
{
  this->Worker->settleEnd(next);
}

SlabParticles SlabDistribution::lastParticles() const
{
  return this->Worker->lastParticles();
}

Distribution SlabDistribution::finish(const SlabParticles& before)
{
  return this->Worker->finishAmong(before);
}

} // namespace hop
