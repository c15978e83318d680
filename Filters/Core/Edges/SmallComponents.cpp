#include "Edges/SmallComponents.h"

#include "Support/KeepMarked.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hop
{
namespace
{

/// So far off, in units of its spacing, the next particle on a surface that goes on is never.
constexpr double alone = 1.8;
static_assert(alone <= ParticleGrid::Reach);
/// Splats do not vanish, though a piece may be a point.
constexpr double leastRadius = 0.02;

/// Which part of a splat is drawn where the surface ends at its particle: between two boundary curves a sector.
double drawnPart(const Particle& particle)
{
  constexpr double atBoundary = 0.05;
  const auto isAtBoundary = [&](const ClipPlane& plane)
  { return plane.isBoundary() && plane.distance < atBoundary * particle.spacing; };
  const auto& [first, second] = particle.clips;
  if (isAtBoundary(first) && isAtBoundary(second))
  {
    constexpr double leastPart = 0.05;
    return std::max(leastPart, 0.5 - 0.5 * angleBetween(first.normal, second.normal) / Pi);
  }
  return isAtBoundary(first) || isAtBoundary(second) ? 0.5 : 1.0;
}

/// The radius, in units of the spacing, of a splat that is drawn as large as a piece with room for so few
/// particles. One stands for an area of sqrt(3)/2.
double radiusOfPiece(double particleCount, double part)
{
  constexpr double visible = 0.93;
  return std::sqrt(0.5 * std::sqrt(3.0) * particleCount / (part * Pi)) / visible;
}

/// Whether no other particle is near. Those that stand near in space mostly come one after the other: few are
/// left to be looked up.
bool isAlone(const ParticleGrid& all, const Buffer<Particle>& particles, int i)
{
  constexpr int nextOnes = 3;
  const Particle& particle = particles[i];
  const auto isNear = [&](int j)
  {
    return j != i &&
      glm::distance(all.position(j), particle.position.xyz) < alone * particle.spacing;
  };
  const int last = std::min(static_cast<int>(particles.size()) - 1, i + nextOnes);
  for (int j = std::max(0, i - nextOnes); j <= last; ++j)
  {
    if (isNear(j))
    {
      return false;
    }
  }
  bool found = false;
  all.visit(particle.position.xyz, particle.spacing, [&](int j) { found = found || isNear(j); });
  return !found;
}

/// Fits those particles that stand alone to the boxes around.
class PieceFitter
{
public:
  PieceFitter(const SurfaceProxy& proxy, const ParallelFor& parallelFor)
    : Proxy(proxy)
    , Points(
        proxy.samples().size(),
        [&](std::size_t b)
        { return proxy.samples()[b].found ? proxy.samples()[b].patch.position : glm::dvec3(0.0); },
        [&](std::size_t b)
        {
          return proxy.samples()[b].found ? proxy.samples()[b].patch.spacing
                                          : static_cast<float>(proxy.sizing().spacing);
        },
        parallelFor)
    , Grid(this->Points.positions, this->Points.spacings, alone, 0.5, parallelFor)
  {
  }

  void fit(Particle& particle) const
  {
    const auto& samples = this->Proxy.samples();
    // Boxes without a sample tell no area.
    const auto [first, last] = this->Proxy.boxesOf(particle.location.element);
    const bool isKnown = std::all_of(samples.begin() + first, samples.begin() + last,
      [](const SurfaceProxy::Sample& sample) { return sample.found; });
    bool hasBox = false;
    double count = 0.0;
    this->Grid.visit(particle.position.xyz, particle.spacing,
      [&](int b)
      {
        if (glm::distance(this->Points.positions[b], particle.position.xyz) <
          alone * particle.spacing)
        {
          hasBox = hasBox || samples[b].found;
          count += this->Proxy.particleCountOfBox(b);
        }
      });
    if (isKnown && hasBox)
    {
      particle.shrink = std::clamp(radiusOfPiece(count, drawnPart(particle)), leastRadius, 1.0);
    }
  }

private:
  const SurfaceProxy& Proxy;
  SpacedPoints Points;
  SpacingGrid Grid;
};

} // namespace

void fitSmallComponents(const SurfaceProxy& proxy, const ParticleGrid& all,
  Buffer<Particle>& particles, const ParallelFor& parallelFor)
{
  std::vector<char> marks(particles.size());
  forAll(parallelFor, particles.size(),
    [&](std::size_t i) { marks[i] = isAlone(all, particles, static_cast<int>(i)); });
  const std::vector<int> lonely = markedIndices(marks, particles.size());
  if (!lonely.empty())
  {
    const PieceFitter fitter(proxy, parallelFor);
    forAll(parallelFor, lonely.size(), [&](std::size_t n) { fitter.fit(particles[lonely[n]]); });
  }
}

} // namespace hop
