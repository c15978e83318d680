#include "Edges/SmallComponents.h"

#include "Common/SplatProfile.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace hop
{
namespace
{

/// When a component is small, and how small its splat becomes. Chosen by experiment, but for what is derived.
struct SmallComponent
{
  /// Smallest distance to the next particle of one that stands alone, in units of its spacing: on a surface that goes
  /// on the next one is nearer. A larger one overlooks small components beside others.
  static constexpr double Alone = 1.8;
  /// Smallest radius of a splat, in units of the spacing: splats do not vanish, though a component may be a point.
  static constexpr double LeastRadius = 0.02;
  /// A boundary curve nearer than this, in units of the spacing, passes through its particle.
  static constexpr double AtBoundary = 0.05;
  /// Smallest part of a splat between two boundary curves: a thinner sector would need too large a radius.
  static constexpr double LeastPart = 0.05;
};
static_assert(SmallComponent::Alone <= ParticleGrid::Reach);

/// The part of a splat that is drawn where the surface ends at its particle: half of it, or a sector between two
/// boundary curves.
double drawnPart(const Particle& particle)
{
  const auto isAtBoundary = [&](const ClipPlane& plane)
  { return plane.isBoundary() && plane.distance < SmallComponent::AtBoundary * particle.spacing; };
  const ClipPlane& first = particle.clips[0];
  const ClipPlane& second = particle.clips[1];
  if (isAtBoundary(first) && isAtBoundary(second))
  {
    return std::max(
      SmallComponent::LeastPart, 0.5 - 0.5 * angleBetween(first.normal, second.normal) / Pi);
  }
  return isAtBoundary(first) || isAtBoundary(second) ? 0.5 : 1.0;
}

/// The radius, in units of the spacing, of a splat whose drawn part is as large as a component. A particle stands for
/// an area of sqrt(3)/2 in squares of the spacing (hexagonal packing).
/// \param particleCount the component's area in particles
double radiusOfComponent(double particleCount, double part)
{
  return std::sqrt(0.5 * std::sqrt(3.0) * particleCount / (part * Pi)) / splatReach();
}

/// Whether no other particle is near. Particles near in space mostly come one after the other, so that a look at the
/// next ones in the list settles most.
bool isAlone(const ParticleGrid& all, const Buffer<Particle>& particles, int i)
{
  constexpr int nextOnes = 3; // changes the time only
  const Particle& particle = particles[i];
  const auto isNear = [&](int j)
  {
    return j != i &&
      glm::distance(all.position(j), particle.position.xyz) <
      SmallComponent::Alone * particle.spacing;
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

/// Fits the splats of particles that stand alone to the boxes around.
class SplatFitter
{
public:
  SplatFitter(const SurfaceProxy& proxy, const ParallelFor& parallelFor)
    : Proxy(proxy)
    , Found(foundSamples(proxy))
    , Points(
        this->Found.size(), [this](std::size_t n) { return this->patch(n).position; },
        [this](std::size_t n) { return this->patch(n).spacing; }, parallelFor)
    , Grid(this->Points.positions, this->Points.spacings, SmallComponent::Alone, CellsPerReach,
        parallelFor)
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
      [&](int n)
      {
        if (glm::distance(this->Points.positions[n], particle.position.xyz) <
          SmallComponent::Alone * particle.spacing)
        {
          hasBox = true;
          count += this->Proxy.particleCountOfBox(this->Found[n]);
        }
      });
    if (isKnown && hasBox)
    {
      particle.radiusPerSpacing =
        std::clamp(radiusOfComponent(count, drawnPart(particle)), SmallComponent::LeastRadius, 1.0);
    }
  }

private:
  /// Boxes without a sample have neither a place nor a spacing.
  static std::vector<int> foundSamples(const SurfaceProxy& proxy)
  {
    std::vector<int> found;
    for (std::size_t b = 0; b < proxy.samples().size(); ++b)
    {
      if (proxy.samples()[b].found)
      {
        found.push_back(static_cast<int>(b));
      }
    }
    return found;
  }
  const Patch& patch(std::size_t n) const { return this->Proxy.samples()[this->Found[n]].patch; }

  const SurfaceProxy& Proxy;
  /// Boxes with a sample, and the samples.
  std::vector<int> Found;
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
  const std::vector<int> alone = markedIndices(marks, particles.size());
  if (!alone.empty())
  {
    const SplatFitter fitter(proxy, parallelFor);
    forAll(parallelFor, alone.size(), [&](std::size_t n) { fitter.fit(particles[alone[n]]); });
  }
}

} // namespace hop
