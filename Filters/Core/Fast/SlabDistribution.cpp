#include "Fast/SlabDistribution.h"

#include "Fast/FastSystem.h"
#include "Fast/PackingRepair.h"
#include "Fast/PatchDistances.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <tuple>

namespace hop
{
namespace
{

/// Adds the particles in a slab to some.
void addThose(const Buffer<Anchor>& anchors, const Buffer<Patch>& patches, const Slab& where,
  SlabParticles& some)
{
  for (std::size_t i = 0; i < anchors.size(); ++i)
  {
    if (where.holds(patches[i].position))
    {
      some.anchors.push_back(anchors[i]);
      some.patches.push_back(patches[i]);
    }
  }
}

/// A particle where the particles of two slabs meet.
struct Meeting
{
  Anchor anchor;
  Patch patch;
  bool isOwn = false;

  bool operator<(const Meeting& other) const { return this->key() < other.key(); }

private:
  std::tuple<int, double, double, double> key() const
  {
    const Location& place = this->anchor.place;
    return { place.element, place.u.xyz.x, place.u.xyz.y, place.u.xyz.z };
  }
};

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
  void relaxStrip(const Slab& strip, const SlabParticles& before, const SlabParticles& inside);
  std::vector<char> takeMeeting(const Buffer<Anchor>& anchors, const Buffer<Patch>& patches,
    bool areOwn, std::vector<Meeting>& meeting) const;
  void arrangeCanonically(const SlabParticles& before);

  /// Particles of the next slab, which stay.
  SlabParticles Next;
};

std::string SlabDistribution::System::relaxAlone()
{
  const bool exist = !this->Mesh.elements.empty() && this->relax();
  if (exist && this->Parameters.quality != Quality::Draft)
  {
    repairPacking(*this->Moving, this->Parallel, this->Part);
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
  if (this->Moving)
  {
    addThose(this->Moving->anchors(), this->Moving->patches(), this->between(from, to), result);
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
  SlabParticles inside = this->particlesIn(strip.begin, end);
  addThose(next.anchors, next.patches, this->between(end, strip.end), inside);
  addThose(next.anchors, next.patches, this->between(strip.end, everything), this->Next);
  const SlabParticles before =
    this->particlesIn(strip.begin - this->overlap(SlabOverlap::Sight), strip.begin);
  this->keepIn(this->between(-everything, strip.begin));
  this->relaxStrip(strip, before, inside);
}

/// Relaxes the particles of the strip at the slab's end, among others that stay.
/// \param before particles before the strip
/// \param inside the particles of both slabs in it
void SlabDistribution::System::relaxStrip(
  const Slab& strip, const SlabParticles& before, const SlabParticles& inside)
{
  const Slab seen = strip.widened(this->overlap(SlabOverlap::Sight));
  Buffer<Patch> around;
  for (const Buffer<Patch>* some : std::initializer_list<const Buffer<Patch>*>{
         &before.patches, &this->Next.patches, &this->BoundaryPatches })
  {
    std::copy_if(some->begin(), some->end(), std::back_inserter(around),
      [&](const Patch& patch) { return seen.holds(patch.position); });
  }
  for (Patch& patch : around)
  {
    patch.fixed = true;
  }
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

/// Takes the particles where slabs meet out of some.
/// \return marks the others
std::vector<char> SlabDistribution::System::takeMeeting(const Buffer<Anchor>& anchors,
  const Buffer<Patch>& patches, bool areOwn, std::vector<Meeting>& meeting) const
{
  const double shift = this->overlap(SlabOverlap::Strip);
  const double reach = this->overlap(SlabOverlap::Meeting);
  std::vector<char> others(anchors.size(), 1);
  for (std::size_t i = 0; i < anchors.size(); ++i)
  {
    const double place = this->Part.placeOf(patches[i].position) - shift;
    if (std::abs(place - this->Part.begin) < reach || std::abs(place - this->Part.end) < reach)
    {
      meeting.push_back({ anchors[i], patches[i], areOwn });
      others[i] = 0;
    }
  }
  return others;
}

/// Puts the particles where slabs meet into an order on which their workers agree, behind all others: which of two that
/// are too near to each other stays depends on it.
void SlabDistribution::System::arrangeCanonically(const SlabParticles& before)
{
  std::vector<Meeting> meeting;
  this->Moving->keep(
    this->takeMeeting(this->Moving->anchors(), this->Moving->patches(), true, meeting));
  this->IsOwn.assign(this->Moving->count(), 1);
  for (const SlabParticles* some :
    std::initializer_list<const SlabParticles*>{ &before, &this->Next })
  {
    const std::vector<char> apart = this->takeMeeting(some->anchors, some->patches, false, meeting);
    this->Moving->add(marked(some->anchors, apart), marked(some->patches, apart));
  }
  this->IsOwn.resize(this->Moving->count(), 0);
  std::sort(meeting.begin(), meeting.end());
  SlabParticles sorted;
  for (const Meeting& one : meeting)
  {
    sorted.anchors.push_back(one.anchor);
    sorted.patches.push_back(one.patch);
    this->IsOwn.push_back(one.isOwn);
  }
  this->Moving->add(sorted.anchors, sorted.patches);
  this->Moving->replaceFixed(this->BoundaryPatches);
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
