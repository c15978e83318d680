#include "Fast/MovingParticles.h"

#include "Support/KeepMarked.h"
#include "Support/Random.h"
#include "Surface/ActiveFaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hop
{
namespace
{

/// A step of relaxation is taken back by half while it ends farther from the surface than this, in
/// units of the spacing, or on a sheet that is turned away.
constexpr float largestOffset = 0.5f;
constexpr float leastCosine = 0.3f;
constexpr int maximumHalvings = 3;
/// Relative error of steps in reference space, as anchors keep their map in single precision.
constexpr double pullRounding = 1e-6;
/// Steps from farther off have to shorten the way by this factor.
constexpr float smallestProgress = 0.7f;

/// Whether a step leads to the surface, or nearer to it at least, and not astray.
bool accepts(const Anchor& from, const Patch& before, const Anchor& to, const Patch& after)
{
  const float farthest =
    std::max(largestOffset * before.spacing, smallestProgress * std::abs(from.offset));
  return std::abs(to.offset) <= farthest && glm::dot(before.normal, after.normal) > leastCosine &&
    glm::distance(before.position, after.position) <= 2.0 * before.spacing;
}

} // namespace

MovingParticles::MovingParticles(const Isosurface& surface, const SurfaceProxy& proxy,
  Buffer<Patch> boundaries, ParallelFor parallelFor)
  : Surface(surface)
  , Proxy(proxy)
  , Parallel(std::move(parallelFor))
  , Patches(std::move(boundaries))
{
}

/// For so many particles after those that move, to be written in threads.
/// \return the first one
std::size_t MovingParticles::makeRoom(std::size_t count)
{
  const std::size_t first = this->count();
  const std::size_t size = this->size();
  // Rounds of relaxation add some, and with them should not move all.
  this->Anchors.reserve(this->count() + count + count / 8);
  this->Patches.reserve(size + count + count / 8);
  this->Anchors.resize(first + count);
  this->Patches.resize(size + count);
  const auto boundaries = this->Patches.begin() + static_cast<std::ptrdiff_t>(first);
  std::copy_backward(
    boundaries, this->Patches.begin() + static_cast<std::ptrdiff_t>(size), this->Patches.end());
  return first;
}

void MovingParticles::add(const std::vector<Location>& places)
{
  std::vector<int> all(places.size());
  std::iota(all.begin(), all.end(), static_cast<int>(this->makeRoom(places.size())));
  this->keep(this->anchorAt(all, places));
}

void MovingParticles::add(const std::vector<SurfaceProxy::Seed>& seeds)
{
  const std::size_t first = this->makeRoom(seeds.size());
  std::vector<char> known(seeds.size());
  forAll(this->Parallel, seeds.size(),
    [&](std::size_t n) {
      known[n] = this->Proxy.guess(seeds[n], this->Anchors[first + n], this->Patches[first + n]);
    });
  std::vector<int> unknown;
  std::vector<Location> places;
  for (std::size_t n = 0; n < seeds.size(); ++n)
  {
    if (!known[n])
    {
      unknown.push_back(static_cast<int>(first + n));
      places.push_back(seeds[n].place);
    }
  }
  this->keep(this->anchorAt(unknown, places));
}

void MovingParticles::approach(float farthest)
{
  std::vector<int> far;
  for (std::size_t i = 0; i < this->count(); ++i)
  {
    if (std::abs(this->Anchors[i].offset) > farthest * this->Patches[i].spacing)
    {
      far.push_back(static_cast<int>(i));
    }
  }
  this->step(far, std::vector<glm::vec2>(this->count(), glm::vec2(0.0f)));
}

/// Gives some particles the patches that belong to places.
/// \return marks of all that have one
std::vector<char> MovingParticles::anchorAt(
  const std::vector<int>& which, const std::vector<Location>& places)
{
  std::vector<char> found(this->count(), 1);
  const std::vector<int> order =
    orderByElement(places, this->Surface.mesh->elements.size(), this->Parallel);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(places.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      evaluateInOrder(*this->Surface.mesh, places, order, begin, end,
        [&](int n, const Jet& jet)
        {
          const int i = which[n];
          Patch patch;
          found[i] = anchorPatch(places[n], jet, this->Surface.isovalue, this->Anchors[i], patch);
          patch.spacing = this->Proxy.spacingAt(patch.position, patch.curvatureMagnitude());
          this->Patches[i] = patch;
        });
    });
  this->Evaluations += static_cast<std::int64_t>(places.size());
  return found;
}

void MovingParticles::add(const Buffer<Anchor>& anchors, const Buffer<Patch>& patches)
{
  this->Patches.insert(this->Patches.begin() + static_cast<std::ptrdiff_t>(this->count()),
    patches.begin(), patches.end());
  this->Anchors.insert(this->Anchors.end(), anchors.begin(), anchors.end());
}

void MovingParticles::join(const MovingParticles& others)
{
  const auto count = static_cast<std::ptrdiff_t>(others.count());
  this->Patches.insert(this->Patches.begin() + static_cast<std::ptrdiff_t>(this->count()),
    others.Patches.begin(), others.Patches.begin() + count);
  this->Anchors.insert(this->Anchors.end(), others.Anchors.begin(), others.Anchors.end());
  this->Evaluations += others.Evaluations;
  this->SweepCount += others.SweepCount;
}

void MovingParticles::draw(std::int64_t count, std::uint64_t randomSeed)
{
  this->add(this->Proxy.seeds(count, Random(randomSeed).uniform(), this->Parallel));
}

/// Of those that move, puts order[0], order[1], ... first, and leaves out what is not in the order.
void MovingParticles::arrange(const std::vector<int>& order)
{
  const std::size_t before = this->count();
  const std::size_t boundaries = this->size() - before;
  // More is added later.
  this->SpareAnchors.reserve(this->Anchors.capacity());
  this->SparePatches.reserve(this->Patches.capacity());
  this->SpareAnchors.resize(order.size());
  this->SparePatches.resize(order.size() + boundaries);
  forAll(this->Parallel, this->SparePatches.size(),
    [&](std::size_t n)
    {
      const bool moves = n < order.size();
      this->SparePatches[n] = this->Patches[moves ? order[n] : n - order.size() + before];
      if (moves)
      {
        this->SpareAnchors[n] = this->Anchors[order[n]];
      }
    });
  this->Anchors.swap(this->SpareAnchors);
  this->Patches.swap(this->SparePatches);
}

void MovingParticles::keep(const std::vector<char>& kept)
{
  const std::vector<int> order = markedIndices(kept, this->count());
  if (order.size() < this->count())
  {
    this->arrange(order);
  }
}

/// Where a step in world space takes particle i: in its own element by its own map, in the next one by that
/// of a sample, else by walking.
Location MovingParticles::target(std::size_t i, const glm::dvec3& step, std::int64_t& cost) const
{
  const Anchor& anchor = this->Anchors[i];
  const Domain domain = this->Surface.mesh->elements[anchor.place.element].domain;
  const glm::dvec3 du = glm::dmat3(anchor.pull) * step;
  ReferencePoint u{ anchor.place.u.xyz + du };
  const double margin = insideMargin(domain, u);
  if (margin >= -pullRounding * glm::length(du))
  {
    // Where the surface lies in a face of the element, rounding leads out of it.
    return { anchor.place.element, margin >= 0.0 ? u : broughtInside(domain, u) };
  }
  SurfaceWalker walker(this->Surface);
  Evaluated start{ anchor.place, {} };
  LocalMap& map = start.point.map;
  map.position = { this->Patches[i].position -
    static_cast<double>(anchor.offset) * glm::dvec3(this->Patches[i].normal) };
  map.inverse = glm::dmat3(anchor.pull);
  map.jacobian = glm::inverse(map.inverse);
  const Exit exit = findExit(domain, anchor.place.u, map.pull({ step }), {});
  if (exit.face >= 0 && !this->Surface.mayEnd(anchor.place.element, exit.face))
  {
    const int next = this->Surface.mesh->neighbor(anchor.place.element, exit.face).element;
    if (const auto place = this->Proxy.locate(map.position.xyz + step, next))
    {
      return *place;
    }
  }
  // Onto a wall only particles on boundary curves may go.
  Location reached = walker.move(start, { step });
  const auto onWall = [&]() { return walker.endCount(reached) > 0; };
  if (onWall())
  {
    reached = walker.move(start, { 0.5 * step });
  }
  const bool ends = onWall();
  cost += walker.evaluations();
  return ends ? anchor.place : reached;
}

/// World vector from where particle i was evaluated to a displacement on its patch.
glm::dvec3 MovingParticles::stepTo(std::size_t i, const glm::vec2& displacement) const
{
  const Patch& patch = this->Patches[i];
  return patch.step(displacement) +
    static_cast<double>(this->Anchors[i].offset) * glm::dvec3(patch.normal);
}

/// Where displacements, one for each particle, take some of them.
std::vector<Location> MovingParticles::targets(
  const std::vector<int>& which, const std::vector<glm::vec2>& displacements)
{
  std::vector<Location> places(which.size());
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(which.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::int64_t cost = 0;
      for (std::ptrdiff_t n = begin; n < end; ++n)
      {
        places[n] = this->target(which[n], this->stepTo(which[n], displacements[which[n]]), cost);
      }
      this->Evaluations += cost;
    });
  return places;
}

/// Half the step, a quarter of it, ...
bool MovingParticles::retry(
  std::size_t i, glm::dvec3 step, Anchor& anchor, Patch& patch, std::int64_t& cost) const
{
  for (int n = 0; n < maximumHalvings; ++n)
  {
    step *= 0.5;
    const Location place = this->target(i, step, cost);
    const Jet jet = evaluateHessian(this->Surface.mesh->form(place.element), place.u);
    ++cost;
    if (anchorPatch(place, jet, this->Surface.isovalue, anchor, patch) &&
      accepts(this->Anchors[i], this->Patches[i], anchor, patch))
    {
      return true;
    }
  }
  return false;
}

/// Takes some particles where displacements, one for each particle, and Newton's method lead them.
/// \return for each of those some, whether it got there in one step
std::vector<char> MovingParticles::step(
  const std::vector<int>& which, const std::vector<glm::vec2>& displacements)
{
  std::vector<char> arrived(which.size());
  const std::vector<Location> places = this->targets(which, displacements);
  const std::vector<int> order =
    orderByElement(places, this->Surface.mesh->elements.size(), this->Parallel);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(which.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::int64_t cost = end - begin;
      evaluateInOrder(*this->Surface.mesh, places, order, begin, end,
        [&](int n, const Jet& jet)
        {
          const int i = which[n];
          Anchor anchor;
          Patch patch;
          arrived[n] = anchorPatch(places[n], jet, this->Surface.isovalue, anchor, patch) &&
            accepts(this->Anchors[i], this->Patches[i], anchor, patch);
          if (arrived[n] || this->retry(i, this->stepTo(i, displacements[i]), anchor, patch, cost))
          {
            patch.spacing = this->Proxy.spacingAt(patch.position, patch.curvatureMagnitude());
            this->Anchors[i] = anchor;
            this->Patches[i] = patch;
          }
        });
      this->Evaluations += cost;
    });
  return arrived;
}

void MovingParticles::relax(
  const Sweeps& sweeps, const Balance& balance, const std::function<void(double share)>& reached)
{
  Relaxed relaxed = relaxOnPatches(this->Patches, sweeps, balance, this->Parallel, reached);
  relaxed.displacements.resize(this->count());
  relaxed.kept.resize(this->count());
  Buffer<Anchor> anchors;
  Buffer<Patch> patches;
  for (const Split& split : relaxed.splits)
  {
    anchors.push_back(this->Anchors[split.particle]);
    patches.push_back(this->Patches[split.particle]);
    relaxed.displacements.push_back(split.displacement);
    relaxed.kept.push_back(1);
  }
  this->add(anchors, patches);
  // Holes that cannot be filled lie beyond the end of the surface.
  const bool fills = balance.extent == Balance::Defects;
  this->commit(relaxed.displacements, std::move(relaxed.kept), fills ? relaxed.splits.size() : 0);
  this->SweepCount += sweeps.count;
}

void MovingParticles::commit(
  const std::vector<glm::vec2>& displacements, std::vector<char> kept, std::size_t inserted)
{
  const std::vector<int> which = markedIndices(kept, this->count());
  const std::vector<char> arrived = this->step(which, displacements);
  for (std::size_t n = which.size() - inserted; n < which.size(); ++n)
  {
    kept[which[n]] = arrived[n];
  }
  std::vector<int> order =
    orderByElement(this->Anchors, this->Surface.mesh->elements.size(), this->Parallel);
  order.erase(
    std::remove_if(order.begin(), order.end(), [&](int i) { return !kept[i]; }), order.end());
  this->arrange(order);
}

Location MovingParticles::onSurface(std::size_t i, std::int64_t& cost) const
{
  return this->target(i, this->stepTo(i, glm::vec2(0.0f)), cost);
}

void MovingParticles::renew(std::size_t i, const Location& place, const Jet& jet)
{
  Anchor anchor;
  Patch patch = this->Patches[i];
  if (anchorPatch(place, jet, this->Surface.isovalue, anchor, patch) &&
    accepts(this->Anchors[i], this->Patches[i], anchor, patch))
  {
    this->Anchors[i] = anchor;
    this->Patches[i] = patch;
  }
}

} // namespace hop
