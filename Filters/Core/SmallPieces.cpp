#include "SmallPieces.h"

#include "SpacingGrid.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

namespace hop
{
namespace
{

/// So far off, in units of its spacing, the next particle on a surface that goes on is never.
constexpr double alone = 1.8;
/// Splats do not vanish, though a piece may be a point.
constexpr double leastRadius = 0.02;

/// Which part of a splat is drawn where the surface ends at its particle: between two rims a sector.
double drawnPart(const Particle& particle)
{
  constexpr double atRim = 0.05;
  const auto isAtRim = [&](const ClipPlane& plane)
  { return plane.turn == Pi && plane.distance < atRim * particle.spacing; };
  const auto& [first, second] = particle.clips;
  if (isAtRim(first) && isAtRim(second))
  {
    constexpr double leastPart = 0.05;
    return std::max(leastPart, 0.5 - 0.5 * angleBetween(first.normal, second.normal) / Pi);
  }
  return isAtRim(first) || isAtRim(second) ? 0.5 : 1.0;
}

/// The radius, in units of the spacing, of a splat that is drawn as large as a piece with room for so few
/// particles. One stands for an area of sqrt(3)/2.
double radiusOfPiece(double particleCount, double part)
{
  constexpr double visible = 0.93;
  return std::sqrt(0.5 * std::sqrt(3.0) * particleCount / (part * Pi)) / visible;
}

/// Those that stand near in space mostly come one after the other: few are left to be looked up.
std::vector<int> mayBeAlone(const Buffer<Particle>& particles)
{
  constexpr int nextOnes = 3;
  const auto count = static_cast<int>(particles.size());
  std::vector<int> found;
  for (int i = 0; i < count; ++i)
  {
    bool isNear = false;
    for (int j = std::max(0, i - nextOnes); j < std::min(count, i + nextOnes + 1) && !isNear; ++j)
    {
      isNear = j != i &&
        length(particles[j].position - particles[i].position) < alone * particles[i].spacing;
    }
    if (!isNear)
    {
      found.push_back(i);
    }
  }
  return found;
}

/// Points with spacings, to be found by place.
class Places
{
public:
  template <class Place>
  Places(std::size_t count, const ParallelFor& parallelFor, const Place& place)
    : Positions(count)
    , Spacings(count)
  {
    forAll(parallelFor, count,
      [&](std::size_t i) { std::tie(this->Positions[i], this->Spacings[i]) = place(i); });
    this->Grid =
      std::make_unique<SpacingGrid>(this->Positions, this->Spacings, alone, 0.5, parallelFor);
  }

  /// Calls use(j) for all that are as near to a particle as others are to it unless it stands alone.
  template <class Use>
  void visit(const Particle& particle, const Use& use) const
  {
    this->Grid->visit(particle.position.xyz, particle.spacing,
      [&](int j)
      {
        if (glm::distance(this->Positions[j], particle.position.xyz) < alone * particle.spacing)
        {
          use(j);
        }
      });
  }

private:
  Buffer<glm::dvec3> Positions;
  Buffer<float> Spacings;
  std::unique_ptr<SpacingGrid> Grid;
};

std::vector<int> findAlone(const Buffer<Particle>& particles, const ParallelFor& parallelFor)
{
  std::vector<int> found = mayBeAlone(particles);
  if (found.empty())
  {
    return found;
  }
  const Places places(particles.size(), parallelFor,
    [&](std::size_t i)
    { return std::pair(particles[i].position.xyz, static_cast<float>(particles[i].spacing)); });
  std::vector<char> hasNeighbor(found.size(), 0);
  forAll(parallelFor, found.size(),
    [&](std::size_t n)
    { places.visit(particles[found[n]], [&](int j) { hasNeighbor[n] |= j != found[n]; }); });
  std::size_t kept = 0;
  for (std::size_t n = 0; n < found.size(); ++n)
  {
    found[kept] = found[n];
    kept += !hasNeighbor[n];
  }
  found.resize(kept);
  return found;
}

} // namespace

void fitSmallPieces(
  const SurfaceProxy& proxy, Buffer<Particle>& particles, const ParallelFor& parallelFor)
{
  const std::vector<int> lonely = findAlone(particles, parallelFor);
  if (lonely.empty())
  {
    return;
  }
  const auto& samples = proxy.samples();
  const Places places(samples.size(), parallelFor,
    [&](std::size_t b)
    {
      const Patch& patch = samples[b].patch;
      return samples[b].found ? std::pair(glm::dvec3(patch.position), patch.spacing)
                              : std::pair(glm::dvec3(0.0), static_cast<float>(proxy.law().spacing));
    });
  forAll(parallelFor, lonely.size(),
    [&](std::size_t n)
    {
      Particle& particle = particles[lonely[n]];
      // Boxes without a sample tell no area.
      const auto [first, last] = proxy.boxesOf(particle.location.element);
      const bool isKnown = std::all_of(samples.begin() + first, samples.begin() + last,
        [](const SurfaceProxy::Sample& sample) { return sample.found; });
      bool hasBox = false;
      double count = 0.0;
      places.visit(particle,
        [&](int b)
        {
          hasBox = hasBox || samples[b].found;
          count += proxy.particleCountOfBox(b);
        });
      if (isKnown && hasBox)
      {
        particle.spacing *= std::clamp(radiusOfPiece(count, drawnPart(particle)), leastRadius, 1.0);
      }
    });
}

} // namespace hop
