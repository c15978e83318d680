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

/// When a step is accepted; it is halved otherwise. Chosen by experiment, all of them: where they are stricter more
/// steps are halved, each for an evaluation; where they are laxer particles stray to other sheets.
struct AcceptedStep
{
  /// Largest distance from the surface at its end, in units of the spacing.
  static constexpr float Offset = 0.5f;
  /// Factor by which it has to shorten the distance to the surface at least, where it starts farther off than that.
  static constexpr float Progress = 0.7f;
  /// Least cosine between the normals at its ends.
  static constexpr float Cosine = 0.3f;
  /// Largest length, in units of the spacing.
  static constexpr double Length = 2.0;
  /// Number of halvings after which the particle stays where it is.
  static constexpr int Halvings = 3;
};

/// Relative error of steps in reference space: some ten roundings of single precision, in which anchors keep their map.
/// Larger: a particle that leaves its element by a little is held in it; smaller: the surface that lies in a face is
/// left by rounding.
constexpr double pullRounding = 1e-6;

/// Whether a step ends on the right sheet, near the surface or at least nearer than it started.
bool accepts(const Anchor& from, const Patch& before, const Anchor& to, const Patch& after)
{
  const float farthest =
    std::max(AcceptedStep::Offset * before.spacing, AcceptedStep::Progress * std::abs(from.offset));
  return std::abs(to.offset) <= farthest &&
    glm::dot(before.normal, after.normal) > AcceptedStep::Cosine &&
    glm::distance(before.position, after.position) <= AcceptedStep::Length * before.spacing;
}

} // namespace

MovingParticles::MovingParticles(const Isosurface& surface, const SurfaceProxy& proxy,
  Buffer<Patch> boundaryPatches, ParallelFor parallelFor)
  : Surface(surface)
  , Proxy(proxy)
  , Parallel(std::move(parallelFor))
  , Patches(std::move(boundaryPatches))
{
}

/// Makes room for `count` more particles that move, which are written in threads then.
/// \return index of the first of them
std::size_t MovingParticles::makeRoom(std::size_t count)
{
  const std::size_t first = this->count();
  const std::size_t size = this->size();
  // Rounds of relaxation insert a few, for which memory should not be allocated anew: an eighth more is enough.
  this->Anchors.reserve(this->count() + count + count / 8);
  this->Patches.reserve(size + count + count / 8);
  this->Anchors.resize(first + count);
  this->Patches.resize(size + count);
  const auto fixed = this->Patches.begin() + static_cast<std::ptrdiff_t>(first);
  std::copy_backward(
    fixed, this->Patches.begin() + static_cast<std::ptrdiff_t>(size), this->Patches.end());
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

/// Evaluates patches at places, and gives them to some particles.
/// \return for each particle whether it has a patch
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

void MovingParticles::append(const MovingParticles& others)
{
  const auto count = static_cast<std::ptrdiff_t>(others.count());
  this->Patches.insert(this->Patches.begin() + static_cast<std::ptrdiff_t>(this->count()),
    others.Patches.begin(), others.Patches.begin() + count);
  this->Anchors.insert(this->Anchors.end(), others.Anchors.begin(), others.Anchors.end());
  this->Evaluations += others.Evaluations;
  this->SweepCount += others.SweepCount;
}

void MovingParticles::replaceFixed(const Buffer<Patch>& patches)
{
  this->Patches.resize(this->count());
  this->Patches.insert(this->Patches.end(), patches.begin(), patches.end());
}

void MovingParticles::draw(std::int64_t count, std::uint64_t randomSeed)
{
  this->add(this->Proxy.seeds(count, Random(randomSeed).uniform(), this->Parallel));
}

/// Reorders the particles that move: order[0], order[1], ... Particles that are not in the order are dropped.
void MovingParticles::arrange(const std::vector<int>& order)
{
  const std::size_t before = this->count();
  const std::size_t fixed = this->size() - before;
  // More particles are added later.
  this->SpareAnchors.reserve(this->Anchors.capacity());
  this->SparePatches.reserve(this->Patches.capacity());
  this->SpareAnchors.resize(order.size());
  this->SparePatches.resize(order.size() + fixed);
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

/// Where a step in world space takes particle i: in its own element by its own map, in the next element by the map of a
/// sample there, else by walking.
Location MovingParticles::target(std::size_t i, const glm::dvec3& step, std::int64_t& cost) const
{
  const Anchor& anchor = this->Anchors[i];
  const Domain domain = this->Surface.mesh->elements[anchor.place.element].domain;
  const glm::dvec3 du = glm::dmat3(anchor.pull) * step;
  ReferencePoint u{ anchor.place.u.xyz + du };
  const double margin = insideMargin(domain, u);
  if (margin >= -pullRounding * glm::length(du))
  {
    // Where the surface lies in a face of the element, rounding may lead out of the element.
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
  // Only particles on boundary curves may stand on a wall.
  Location reached = walker.move(start, { step });
  const auto onWall = [&]() { return walker.endFaceCount(reached) > 0; };
  if (onWall())
  {
    reached = walker.move(start, { 0.5 * step });
  }
  const bool ends = onWall();
  cost += walker.evaluations();
  return ends ? anchor.place : reached;
}

/// World vector from the place where particle i was evaluated to a point of its patch.
glm::dvec3 MovingParticles::stepTo(std::size_t i, const glm::vec2& displacement) const
{
  const Patch& patch = this->Patches[i];
  return patch.step(displacement) +
    static_cast<double>(this->Anchors[i].offset) * glm::dvec3(patch.normal);
}

/// Where displacements take some of the particles.
/// \param displacements one for each particle
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

/// Tries half the step, a quarter of it, and so on.
/// \return whether one was accepted
bool MovingParticles::halveStep(
  std::size_t i, glm::dvec3 step, Anchor& anchor, Patch& patch, std::int64_t& cost) const
{
  for (int n = 0; n < AcceptedStep::Halvings; ++n)
  {
    step *= 0.5;
    const Location place = this->target(i, step, cost);
    const Jet jet = exactHessian(*this->Surface.mesh, place);
    ++cost;
    if (anchorPatch(place, jet, this->Surface.isovalue, anchor, patch) &&
      accepts(this->Anchors[i], this->Patches[i], anchor, patch))
    {
      return true;
    }
  }
  return false;
}

/// Moves some of the particles by displacements and Newton's method.
/// \param displacements one for each particle
/// \return for each particle of `which` whether its whole step was accepted
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
          if (arrived[n] ||
            this->halveStep(i, this->stepTo(i, displacements[i]), anchor, patch, cost))
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
  for (const Insertion& insertion : relaxed.insertions)
  {
    anchors.push_back(this->Anchors[insertion.beside]);
    patches.push_back(this->Patches[insertion.beside]);
    relaxed.displacements.push_back(insertion.displacement);
    relaxed.kept.push_back(1);
  }
  this->add(anchors, patches);
  // A hole into which no step leads lies beyond the end of the surface.
  const bool fillsHoles = balance.extent == Balance::Defects;
  this->commit(
    relaxed.displacements, std::move(relaxed.kept), fillsHoles ? relaxed.insertions.size() : 0);
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
