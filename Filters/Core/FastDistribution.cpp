#include "FastDistribution.h"

#include "ClipPlanes.h"
#include "FaceJumps.h"
#include "Interruptible.h"
#include "Random.h"
#include "RimCurves.h"
#include "SpacingGrid.h"
#include "SurfaceProxy.h"
#include "UnresolvedBoxes.h"

#include <atomic>
#include <cmath>
#include <functional>
#include <numeric>

namespace hop
{
namespace
{

/// Largest boxes of the proxy, in units of the spacing wanted: some five particles each. Tetrahedra fill
/// less of their bounds.
constexpr double hexahedronPerSpacing = 6.0;
constexpr double wedgePerSpacing = 7.0;
constexpr double tetrahedronPerSpacing = 9.0;
/// Spacing of the first look, in units of the mesh's diagonal. Where more is asked for, the number of
/// particles cannot get out of hand.
constexpr double coarseSpacingPerExtent = 0.001;
/// A step of relaxation is taken back by half while it ends farther from the surface than this, in
/// units of the spacing, or on a sheet that is turned away.
constexpr float largestOffset = 0.5f;
constexpr float smallestTurn = 0.3f;
constexpr int maximumHalvings = 3;
/// Seeds nearer to a rim's particle than this, in units of their spacing, are dropped: half the
/// distance of two rows of hexagonal packing. Those that a round of relaxation squeezed against the rim
/// are dropped after it.
constexpr double seedToRim = 0.433;
constexpr double squeezed = 0.6;
/// A patch runs through a box if it passes its sample nearer than this, in units of its spacing.
constexpr float coverOffset = 0.1f;

std::vector<int> sweepsOfRounds(Quality quality)
{
  switch (quality)
  {
    case Quality::Draft:
      return { 8 };
    case Quality::High:
      return { 5, 8, 8, 10 };
    default:
      return { 5, 9 };
  }
}

class FastSystem
{
public:
  FastSystem(const Isosurface& surface, const DistributionParameters& parameters,
    const Monitor& monitor, const ParallelFor& parallelFor)
    : Surface(surface)
    , Mesh(*surface.mesh)
    , Parameters(parameters)
    , Law(parameters.law)
    , Work(monitor, parallelFor)
    , Parallel([this](std::ptrdiff_t count, const auto& body) { this->Work(count, body); })
    , Locator(this->Mesh, surface.isovalue, parallelFor)
  {
    this->Surface.locator = &this->Locator;
  }

  Distribution run();

private:
  /// Reports how far the work is; may throw Interrupted.
  void reach(double fraction)
  {
    this->Work.setFraction(fraction);
    this->Work.ask();
  }
  SurfaceProxy proxyAt(double spacing);
  bool tooMany(double count);
  bool estimateCount();
  void makeProxy();
  void matchCount();
  void makeExactly(std::int64_t count);
  void findJumps();
  void makeRims();
  std::vector<char> farFromRims(double nearest);
  std::vector<char> standApart(double nearest);
  void dropNearRims(double nearest);
  void makeSeeds(std::int64_t count);
  bool countIsGiven() const { return this->Parameters.particleCount > 0; }
  void putNearSurface();
  void coverBoxes();
  bool isCovered(const SurfaceProxy::Sample& sample, const SpacingGrid& grid) const;
  void relax(int sweeps);
  void commit(const std::vector<glm::vec2>& displacements);
  Location target(std::size_t i, const glm::dvec3& step, std::int64_t& cost) const;
  glm::dvec3 stepTo(std::size_t i, const glm::vec2& displacement) const;
  std::vector<Location> targets(const std::vector<glm::vec2>& displacements);
  bool retry(
    std::size_t i, glm::dvec3 step, Anchor& anchor, Patch& patch, std::int64_t& cost) const;
  bool accepts(const Patch& before, const Anchor& anchor, const Patch& after) const;
  bool settle(const Location& place, const Jet& jet, Patch& patch, Particle& particle) const;
  void finishPass(
    std::vector<int>& pending, std::vector<Particle>& particles, std::vector<char>& settled);
  void finish();

  Isosurface Surface;
  const ElementMesh& Mesh;
  DistributionParameters Parameters;
  SpacingLaw Law;
  Interruptible Work;
  ParallelFor Parallel;
  FaceLocator Locator;
  std::unique_ptr<SurfaceProxy> Proxy;
  std::vector<Anchor> Anchors;
  /// Those of the particles that move, then those on rims.
  std::vector<Patch> Patches;
  RimCurves Rims;
  std::vector<Patch> RimPatches;
  FaceJumps Jumps;
  std::atomic<std::int64_t> Evaluations{ 0 };
  Distribution Result;
};

/// World vector of a displacement on a patch.
glm::dvec3 worldStep(const Patch& patch, const glm::vec2& t)
{
  const auto tangents = tangentsOf(patch.normal);
  return glm::dvec3(t.x * tangents[0] + t.y * tangents[1] - patch.sink(t) * patch.normal);
}

template <class T>
void keep(std::vector<T>& items, const std::vector<char>& kept)
{
  std::size_t next = 0;
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    if (kept[i])
    {
      items[next++] = items[i];
    }
  }
  items.resize(next);
}

SurfaceProxy FastSystem::proxyAt(double spacing)
{
  SpacingLaw law = this->Law;
  law.spacing = spacing;
  const auto isSmall = [&](const Location& middle, double size)
  {
    const Domain domain = this->Mesh.elements[middle.element].domain;
    const double perSpacing = domain == Domain::Hexahedron ? hexahedronPerSpacing
      : domain == Domain::Wedge                            ? wedgePerSpacing
                                                           : tetrahedronPerSpacing;
    const double largest = perSpacing * law.spacing;
    const double smallest = largest / (1.0 + law.angularDensity);
    if (law.angularDensity == 0.0 || size > largest || size <= smallest)
    {
      return size <= largest;
    }
    ++this->Evaluations;
    Anchor anchor;
    Patch patch;
    const Jet jet = evaluateHessian(this->Mesh.form(middle.element), middle.u);
    if (!anchorPatch(middle, jet, this->Surface.isovalue, anchor, patch))
    {
      return true;
    }
    return size <= perSpacing * law.at(patch.curvatureMagnitude());
  };
  SurfaceProxy proxy(this->Surface, law,
    findSurfaceBoxes(this->Mesh, this->Surface.isovalue, isSmall, this->Parallel), this->Parallel);
  this->Evaluations += proxy.evaluations();
  return proxy;
}

bool FastSystem::tooMany(double count)
{
  const auto limit = this->Parameters.particleLimit;
  if (count <= static_cast<double>(limit))
  {
    return false;
  }
  this->Result.report.error = "the spacing asks for about " + std::to_string(std::llround(count)) +
    " particles, more than the limit of " + std::to_string(limit);
  return true;
}

/// From a coarse look at the surface, before memory is asked for.
/// \return whether there are few enough
bool FastSystem::estimateCount()
{
  if (this->Parameters.particleCount > 0)
  {
    return !this->tooMany(static_cast<double>(this->Parameters.particleCount));
  }
  const double coarse = meshExtent(this->Mesh) * coarseSpacingPerExtent;
  const double ratio = coarse / this->Law.spacing;
  return ratio <= 1.0 || !this->tooMany(this->proxyAt(coarse).particleCount() * ratio * ratio);
}

void FastSystem::makeProxy()
{
  this->Proxy = std::make_unique<SurfaceProxy>(this->proxyAt(this->Law.spacing));
  this->matchCount();
  reportUnresolved(this->Surface, this->Proxy->boxes(), this->Result.report);
}

/// Where the number of particles is given, finds the spacing that goes with it.
void FastSystem::matchCount()
{
  constexpr int tries = 6;
  constexpr double closeEnough = 0.01;
  const auto wanted = static_cast<double>(this->Parameters.particleCount);
  for (int n = 0; n < tries && wanted > 0.0; ++n)
  {
    const double ratio = this->Proxy->particleCount() / wanted;
    if (!(ratio > 0.0) || std::abs(ratio - 1.0) < closeEnough)
    {
      return;
    }
    this->Law.spacing *= std::sqrt(ratio);
    this->Proxy = std::make_unique<SurfaceProxy>(this->proxyAt(this->Law.spacing));
  }
}

/// Draws that many first places.
void FastSystem::makeSeeds(std::int64_t count)
{
  const std::vector<Location> seeds =
    this->Proxy->seeds(count, Random(this->Parameters.seed).uniform(), this->Parallel);
  this->Anchors.resize(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    this->Anchors[i].place = seeds[i];
  }
  this->putNearSurface();
  this->dropNearRims(seedToRim);
  this->coverBoxes();
}

/// The first places of a given number of particles: more are drawn until those that rims push aside are
/// made up for, and those too many are taken away evenly.
void FastSystem::makeExactly(std::int64_t count)
{
  constexpr int tries = 8;
  std::int64_t drawn = count;
  for (int n = 0; n < tries; ++n)
  {
    this->makeSeeds(drawn);
    const auto missing = count - static_cast<std::int64_t>(this->Patches.size());
    if (missing <= 0)
    {
      break;
    }
    drawn += missing;
  }
  const auto moving = static_cast<std::int64_t>(this->Anchors.size());
  const auto surplus =
    std::clamp<std::int64_t>(static_cast<std::int64_t>(this->Patches.size()) - count, 0, moving);
  std::vector<char> kept(this->Patches.size(), 1);
  for (std::int64_t n = 0; n < surplus; ++n)
  {
    kept[n * moving / surplus] = 0;
  }
  keep(this->Patches, kept);
  kept.resize(moving);
  keep(this->Anchors, kept);
}

/// One Newton step for each seed, then its first patch.
void FastSystem::putNearSurface()
{
  this->Patches.assign(this->Anchors.size(), Patch());
  std::vector<Location> places;
  for (const Anchor& anchor : this->Anchors)
  {
    places.push_back(anchor.place);
  }
  const std::vector<int> order = orderByElement(places, this->Mesh.elements.size());
  std::vector<char> found(places.size(), 0);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(places.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      evaluateInOrder(this->Mesh, places, order, begin, end,
        [&](int i, const Jet& jet)
        {
          Patch& patch = this->Patches[i];
          found[i] = anchorPatch(places[i], jet, this->Surface.isovalue, this->Anchors[i], patch);
          patch.spacing = static_cast<float>(this->Law.spacing);
        });
      this->Evaluations += end - begin;
    });
  keep(this->Anchors, found);
  keep(this->Patches, found);
  this->commit(std::vector<glm::vec2>(this->Anchors.size(), glm::vec2(0.0f)));
}

/// From here on the surface ends where its two sides miss each other.
void FastSystem::findJumps()
{
  this->Jumps = findFaceJumps(this->Surface, *this->Proxy, this->Parallel);
  this->Evaluations += this->Jumps.evaluations;
  this->Surface.gaps = &this->Jumps.gaps;
}

void FastSystem::makeRims()
{
  this->Rims = findRimCurves(this->Surface, *this->Proxy, this->Law);
  this->Evaluations += this->Rims.evaluations;
  for (const RimParticle& rim : this->Rims.particles)
  {
    this->RimPatches.push_back(rim.patch);
  }
}

/// For each particle that moves, whether it keeps that distance, in units of its spacing, from all
/// particles on rims.
std::vector<char> FastSystem::farFromRims(double nearest)
{
  std::vector<char> far(this->Anchors.size(), 1);
  const std::vector<glm::dvec3> positions = positionsOf(this->RimPatches);
  const std::vector<float> spacings = spacingsOf(this->RimPatches);
  const SpacingGrid grid(positions, spacings, nearest, 0.5, this->Parallel);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(far.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        const Patch& patch = this->Patches[i];
        grid.visit(patch.position, patch.spacing,
          [&](int j)
          {
            const Patch& rim = this->RimPatches[j];
            const bool near =
              glm::distance(patch.position, rim.position) < nearest * patch.spacing &&
              glm::dot(patch.normal, rim.normal) > 0.0f;
            far[i] = far[i] && !near;
          });
      }
    });
  return far;
}

/// For each particle that moves, whether to keep it if any two are to be that far apart, in units of their
/// spacings: the first of two stays, and those on rims do.
std::vector<char> FastSystem::standApart(double nearest)
{
  const std::vector<glm::dvec3> positions = positionsOf(this->Patches);
  const std::vector<float> spacings = spacingsOf(this->Patches);
  const SpacingGrid grid(positions, spacings, nearest, 0.5, this->Parallel);
  const auto visitNear = [&](std::size_t i, const auto& use)
  {
    grid.visit(positions[i], spacings[i],
      [&](int j)
      {
        if (static_cast<std::size_t>(j) != i &&
          glm::distance(positions[i], positions[j]) <
            nearest * std::min(spacings[i], spacings[j]) &&
          glm::dot(this->Patches[i].normal, this->Patches[j].normal) > 0.0f)
        {
          use(j);
        }
      });
  };
  std::vector<char> kept(this->Patches.size(), 1);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(this->Anchors.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        visitNear(i, [&](int) { kept[i] = 0; });
      }
    });
  // The few that have a neighbour too near, one by one.
  for (std::size_t i = 0; i < this->Anchors.size(); ++i)
  {
    if (!kept[i])
    {
      bool alone = true;
      visitNear(i, [&](int j) { alone = alone && !kept[j]; });
      kept[i] = alone;
    }
  }
  kept.resize(this->Anchors.size());
  return kept;
}

/// Particles on rims are there first: others too near to one are dropped.
void FastSystem::dropNearRims(double nearest)
{
  this->Patches.resize(this->Anchors.size());
  const std::vector<char> far = this->farFromRims(nearest);
  keep(this->Anchors, far);
  keep(this->Patches, far);
  this->Patches.insert(this->Patches.end(), this->RimPatches.begin(), this->RimPatches.end());
}

/// Where a step in world space takes particle i: in its own element by its own map, else by walking.
Location FastSystem::target(std::size_t i, const glm::dvec3& step, std::int64_t& cost) const
{
  const Anchor& anchor = this->Anchors[i];
  const glm::dvec3 u = anchor.place.u.xyz + glm::dmat3(anchor.pull) * step;
  if (insideMargin(this->Mesh.elements[anchor.place.element].domain, { u }) >= 0.0)
  {
    return { anchor.place.element, { u } };
  }
  SurfaceWalker walker(this->Surface);
  Evaluated start{ anchor.place, {} };
  LocalMap& map = start.point.map;
  map.position = { this->Patches[i].position -
    static_cast<double>(anchor.offset) * glm::dvec3(this->Patches[i].normal) };
  map.inverse = glm::dmat3(anchor.pull);
  map.jacobian = glm::inverse(map.inverse);
  // Onto a wall only particles on rims may go.
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

bool FastSystem::accepts(const Patch& before, const Anchor& anchor, const Patch& after) const
{
  return std::abs(anchor.offset) <= largestOffset * before.spacing &&
    glm::dot(before.normal, after.normal) > smallestTurn &&
    glm::distance(before.position, after.position) <= 2.0 * before.spacing;
}

/// World vector from where particle i was evaluated to a displacement on its patch.
glm::dvec3 FastSystem::stepTo(std::size_t i, const glm::vec2& displacement) const
{
  const Patch& patch = this->Patches[i];
  return worldStep(patch, displacement) +
    static_cast<double>(this->Anchors[i].offset) * glm::dvec3(patch.normal);
}

std::vector<Location> FastSystem::targets(const std::vector<glm::vec2>& displacements)
{
  std::vector<Location> places(this->Anchors.size());
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(places.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::int64_t cost = 0;
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        places[i] = this->target(i, this->stepTo(i, displacements[i]), cost);
      }
      this->Evaluations += cost;
    });
  return places;
}

/// Half the step, a quarter of it, ...
bool FastSystem::retry(
  std::size_t i, glm::dvec3 step, Anchor& anchor, Patch& patch, std::int64_t& cost) const
{
  for (int n = 0; n < maximumHalvings; ++n)
  {
    step *= 0.5;
    const Location place = this->target(i, step, cost);
    const Jet jet = evaluateHessian(this->Mesh.form(place.element), place.u);
    ++cost;
    if (anchorPatch(place, jet, this->Surface.isovalue, anchor, patch) &&
      this->accepts(this->Patches[i], anchor, patch))
    {
      return true;
    }
  }
  return false;
}

/// Takes particles to where relaxation wants them, and to the surface; one evaluation each gives them
/// new patches there. Afterwards they are sorted by element.
void FastSystem::commit(const std::vector<glm::vec2>& displacements)
{
  const std::size_t count = this->Anchors.size();
  const std::vector<Location> places = this->targets(displacements);
  const std::vector<int> order = orderByElement(places, this->Mesh.elements.size());
  std::vector<int> rank(count);
  for (std::size_t n = 0; n < count; ++n)
  {
    rank[order[n]] = static_cast<int>(n);
  }
  std::vector<Anchor> anchors(count);
  std::vector<Patch> patches(count);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(count),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::int64_t cost = end - begin;
      evaluateInOrder(this->Mesh, places, order, begin, end,
        [&](int i, const Jet& jet)
        {
          Anchor& anchor = anchors[rank[i]];
          Patch& patch = patches[rank[i]];
          const Patch& before = this->Patches[i];
          const bool moved = (anchorPatch(places[i], jet, this->Surface.isovalue, anchor, patch) &&
                               this->accepts(before, anchor, patch)) ||
            this->retry(i, this->stepTo(i, displacements[i]), anchor, patch, cost);
          if (!moved)
          {
            anchor = this->Anchors[i];
            patch = before;
          }
          patch.spacing =
            this->Proxy->spacingAt(patch.position, patch.curvatureMagnitude(), before.spacing);
        });
      this->Evaluations += cost;
    });
  this->Anchors = std::move(anchors);
  std::copy(patches.begin(), patches.end(), this->Patches.begin());
}

/// One round. Particles for which there turns out to be no room are dropped.
void FastSystem::relax(int sweeps)
{
  Relaxed relaxed = relaxOnPatches(this->Patches, sweeps, this->Parallel);
  std::vector<char> kept(this->Patches.size());
  std::transform(relaxed.surplus.begin(), relaxed.surplus.end(), kept.begin(),
    [this](char surplus) { return !surplus || this->countIsGiven(); });
  keep(relaxed.displacements, kept);
  keep(this->Patches, kept);
  kept.resize(this->Anchors.size());
  keep(this->Anchors, kept);
  this->commit(relaxed.displacements);
  if (!this->countIsGiven())
  {
    this->dropNearRims(squeezed);
  }
  this->Result.report.iterations += sweeps;
}

/// Whether a particle stands on the piece of surface around a sample.
bool FastSystem::isCovered(const SurfaceProxy::Sample& sample, const SpacingGrid& grid) const
{
  bool covered = false;
  grid.visit(sample.patch.position, sample.patch.spacing,
    [&](int j)
    {
      const Patch& patch = this->Patches[j];
      const glm::vec3 d(sample.patch.position - patch.position);
      const float distance = glm::length(d);
      if (covered || distance > patch.spacing ||
        glm::dot(patch.normal, sample.patch.normal) <= 0.0f)
      {
        return;
      }
      const auto tangents = tangentsOf(patch.normal);
      const glm::vec2 t(glm::dot(d, tangents[0]), glm::dot(d, tangents[1]));
      const float bend = patch.curvatureMagnitude() * distance;
      covered = std::abs(glm::dot(d, patch.normal) + patch.sink(t)) <=
        (coverOffset + bend * bend) * patch.spacing;
    });
  return covered;
}

void FastSystem::coverBoxes()
{
  const std::vector<glm::dvec3> positions = positionsOf(this->Patches);
  const std::vector<float> spacings = spacingsOf(this->Patches);
  const auto& samples = this->Proxy->samples();
  std::vector<char> lonely(samples.size(), 0);
  {
    const SpacingGrid grid(positions, spacings, 1.0, 0.5, this->Parallel);
    runParallel(this->Parallel, static_cast<std::ptrdiff_t>(samples.size()),
      [&](std::ptrdiff_t begin, std::ptrdiff_t end)
      {
        for (std::ptrdiff_t b = begin; b < end; ++b)
        {
          lonely[b] = samples[b].found && !this->isCovered(samples[b], grid);
        }
      });
  }
  // Those added cover others in turn.
  std::vector<Patch> added;
  for (std::size_t b = 0; b < samples.size(); ++b)
  {
    if (!lonely[b])
    {
      continue;
    }
    const auto covers = [&](const Patch& patch)
    {
      return glm::distance(patch.position, samples[b].patch.position) <= 0.7 * patch.spacing &&
        glm::dot(patch.normal, samples[b].patch.normal) > 0.0f;
    };
    if (std::none_of(added.begin(), added.end(), covers))
    {
      added.push_back(samples[b].patch);
      this->Anchors.push_back(samples[b].anchor);
    }
  }
  const auto rims = static_cast<std::ptrdiff_t>(this->Rims.particles.size());
  this->Patches.insert(this->Patches.end() - rims, added.begin(), added.end());
}

/// What there is to say about a particle, if it lies on the surface to the tolerance.
bool FastSystem::settle(
  const Location& place, const Jet& jet, Patch& patch, Particle& particle) const
{
  const FieldPoint point = fieldPoint(jet, this->Surface.isovalue);
  const double slope = length(point.gradient);
  const double residual = std::abs(point.value) / slope;
  if (point.map.singular || !(residual <= this->Surface.tolerance) || !isNearInReference(point))
  {
    return false;
  }
  particle = { place, point.map.position, surfaceNormal(point.gradient),
    curvature(point.gradient, worldHessian(jet, point)), residual,
    this->Law.angularDensity == 0.0 ? this->Law.spacing : patch.spacing, {}, 0.0 };
  patch.position = particle.position.xyz;
  return true;
}

/// Evaluates the pending particles where Newton's method takes them. Those on the surface to the
/// tolerance are finished, the others stay pending.
void FastSystem::finishPass(
  std::vector<int>& pending, std::vector<Particle>& particles, std::vector<char>& settled)
{
  std::vector<Location> places(pending.size());
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(pending.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::int64_t cost = 0;
      for (std::ptrdiff_t n = begin; n < end; ++n)
      {
        places[n] = this->target(pending[n], this->stepTo(pending[n], glm::vec2(0.0f)), cost);
      }
      this->Evaluations += cost;
    });
  const std::vector<int> order = orderByElement(places, this->Mesh.elements.size());
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(pending.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      evaluateInOrder(this->Mesh, places, order, begin, end,
        [&](int n, const Jet& jet)
        {
          const int i = pending[n];
          Patch& patch = this->Patches[i];
          settled[i] = this->settle(places[n], jet, patch, particles[i]);
          Anchor anchor;
          Patch there = patch;
          if (!settled[i] && anchorPatch(places[n], jet, this->Surface.isovalue, anchor, there) &&
            this->accepts(patch, anchor, there))
          {
            this->Anchors[i] = anchor;
            patch = there;
          }
        });
      this->Evaluations += end - begin;
    });
  pending.erase(std::remove_if(pending.begin(), pending.end(), [&](int i) { return settled[i]; }),
    pending.end());
}

/// Newton's method to the tolerance: a few steps for all that need them at once, then one by one.
void FastSystem::finish()
{
  constexpr int passes = 3;
  const std::size_t count = this->Anchors.size();
  std::vector<Particle> particles(count);
  std::vector<char> settled(count, 0);
  std::vector<int> pending(count);
  std::iota(pending.begin(), pending.end(), 0);
  for (int pass = 0; pass < passes; ++pass)
  {
    this->finishPass(pending, particles, settled);
  }
  SurfaceWalker walker(this->Surface);
  for (const int i : pending)
  {
    Evaluated at;
    const float spacing = this->Patches[i].spacing;
    if (walker.project(this->Anchors[i].place, spacing, at))
    {
      const Jet jet = evaluateHessian(this->Mesh.form(at.location.element), at.location.u);
      ++this->Evaluations;
      settled[i] = this->settle(at.location, jet, this->Patches[i], particles[i]);
    }
  }
  this->Evaluations += walker.evaluations();
  const std::ptrdiff_t lost = std::count(settled.begin(), settled.end(), 0);
  if (!this->countIsGiven())
  {
    const std::vector<char> apart = this->standApart(squeezed);
    std::transform(
      settled.begin(), settled.end(), apart.begin(), settled.begin(), std::logical_and<>());
  }
  keep(particles, settled);
  DistributionReport& report = this->Result.report;
  report.particlesRejected += lost;
  this->Evaluations +=
    markClipPlanes(this->Mesh, this->Jumps, this->Rims.particles, particles, this->Parallel);
  for (const RimParticle& rim : this->Rims.particles)
  {
    particles.push_back(rim.particle);
  }
  report.particlesUndersampled = std::count_if(particles.begin(), particles.end(),
    [](const Particle& p) { return p.curvature.magnitude * p.spacing > 2.0; });
  this->Result.particles = std::move(particles);
}

Distribution FastSystem::run()
{
  if (this->Mesh.elements.empty())
  {
    return {};
  }
  try
  {
    if (!this->estimateCount())
    {
      return this->Result;
    }
    this->makeProxy();
    this->reach(0.25);
    const double wanted = this->Proxy->particleCount();
    if (wanted > 0.0 && !this->tooMany(wanted))
    {
      this->findJumps();
      this->makeRims();
      this->reach(0.35);
      if (this->countIsGiven())
      {
        this->makeExactly(this->Parameters.particleCount);
      }
      else
      {
        this->makeSeeds(std::llround(wanted));
      }
      this->reach(0.45);
      const std::vector<int> rounds = sweepsOfRounds(this->Parameters.quality);
      for (std::size_t n = 0; n < rounds.size(); ++n)
      {
        this->relax(rounds[n]);
        this->reach(0.45 + 0.45 * static_cast<double>(n + 1) / static_cast<double>(rounds.size()));
      }
      this->finish();
    }
  }
  catch (const Interrupted&)
  {
    this->Result.particles.clear();
    this->Result.report.aborted = true;
  }
  this->Result.report.evaluations = this->Evaluations + this->Locator.evaluations();
  return this->Result;
}

} // namespace

Distribution distributeFast(const Isosurface& surface, const DistributionParameters& parameters,
  const Monitor& monitor, const ParallelFor& parallelFor)
{
  return FastSystem(surface, parameters, monitor, parallelFor).run();
}

} // namespace hop
