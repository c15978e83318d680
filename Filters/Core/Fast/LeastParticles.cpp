#include "Fast/LeastParticles.h"

#include "Fast/PatchDistances.h"
#include "Support/KeepMarked.h"
#include "Support/SortedBy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hop
{
namespace
{

/// When a particle stands on the patch of a sample. All chosen by experiment. Where they are too strict, more samples
/// are followed for nothing; where they are too lax, particles of a sheet beside a small component are taken for its
/// own, and it keeps too few.
struct OnPatch
{
  /// Distance from the sample, in units of its spacing: hexagonal packing has 18 particles within two rings.
  static constexpr double Reach = 2.2;
  /// Distance from the patch, in units of the spacing.
  static constexpr double Height = 0.25;
  /// Least cosine between the normals of the patch and of the particle.
  static constexpr float Cosine = 0.8f;
};

/// How particles are put on a component. Chosen by experiment.
struct OnComponent
{
  /// Their number, in hexagonal packing. Larger: more than are needed; smaller: some components keep too few.
  static constexpr double Count = 12.0;
  /// Components whose spacings differ by less than this factor are distributed together. It changes the time, and the
  /// number of particles by its square.
  static constexpr double SameSpacing = 1.2;
  static constexpr int Rounds = 3;
  static constexpr int Sweeps = 10;
};

/// Whether a particle within the reach of a sample does.
bool standsOn(const Patch& sample, const Patch& particle)
{
  const glm::dvec2 t = sample.inPlane(particle.position);
  if (std::abs(sample.heightOf(particle.position)) > OnPatch::Height * sample.spacing)
  {
    return false;
  }
  const auto tangents = tangentsOf(sample.normal);
  const glm::vec2 slope = sample.slope(glm::vec2(t));
  const glm::vec3 normal =
    glm::normalize(sample.normal + slope.x * tangents[0] + slope.y * tangents[1]);
  return glm::dot(normal, particle.normal) > OnPatch::Cosine;
}

/// Indices of the boxes on whose samples' patches too few particles stand.
std::vector<int> sparseBoxes(
  const SurfaceProxy& proxy, const Buffer<Patch>& patches, const ParallelFor& parallelFor)
{
  const SpacedPoints points = spacedPoints(patches, parallelFor);
  // Cells as wide as the reach: many particles are looked at around each sample.
  const SpacingGrid grid(points.positions, points.spacings, OnPatch::Reach, 1.0, parallelFor);
  const auto& samples = proxy.samples();
  std::vector<char> sparse(samples.size(), 0);
  forAll(parallelFor, samples.size(),
    [&](std::size_t b)
    {
      const Patch& sample = samples[b].patch;
      std::size_t count = samples[b].found ? 0 : LeastParticles;
      if (count == 0)
      {
        grid.visit(sample.position, sample.spacing,
          [&](int j)
          {
            count += count < LeastParticles &&
              glm::distance(points.positions[j], sample.position) <
                OnPatch::Reach * sample.spacing &&
              standsOn(sample, patches[j]);
          });
      }
      sparse[b] = count < LeastParticles;
    });
  return markedIndices(sparse, sparse.size());
}

/// Finds what of boxes and particles is on components.
class ComponentSearch
{
public:
  ComponentSearch(const Isosurface& surface, const SurfaceProxy& proxy,
    const Buffer<Particle>& particles, const ParallelFor& parallelFor)
    : Proxy(proxy)
    , Particles(particles)
    , Tracer(*surface.mesh, surface.isovalue, parallelFor)
    , InElement(groupedBy(
        particles, surface.mesh->elements.size(),
        [](const Particle& particle) { return particle.location.element; }, parallelFor))
  {
  }

  std::vector<SparseComponent> run(const std::vector<int>& boxes)
  {
    std::vector<int> elements(boxes.size());
    std::transform(boxes.begin(), boxes.end(), elements.begin(),
      [this](int b) { return this->placeOf(b).element; });
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    this->Tracer.prepare(elements);
    std::vector<SparseComponent> found;
    for (const int b : boxes)
    {
      const PieceNumber piece = this->Tracer.pieceAt(this->placeOf(b));
      if (piece.second >= 0 && this->Seen.count(piece) == 0)
      {
        this->follow(piece, found);
      }
    }
    return found;
  }

private:
  const Location& placeOf(int box) const { return this->Proxy.samples()[box].anchor.place; }

  /// Lists the component of a piece if it is closed, and has too few particles.
  void follow(const PieceNumber& start, std::vector<SparseComponent>& found)
  {
    SparseComponent component;
    const std::vector<PieceNumber> pieces = this->Tracer.closedComponent(start,
      [&](const PieceNumber& piece)
      {
        this->Seen.insert(piece);
        this->addParticles(piece, component.particles);
        return component.particles.size() < LeastParticles;
      });
    for (const PieceNumber& piece : pieces)
    {
      this->addBoxes(piece, component);
    }
    if (component.area > 0.0)
    {
      std::sort(component.boxes.begin(), component.boxes.end());
      std::sort(component.particles.begin(), component.particles.end());
      found.push_back(std::move(component));
    }
  }

  void addParticles(const PieceNumber& piece, std::vector<int>& particles)
  {
    for (int n = this->InElement.start[piece.first]; n < this->InElement.start[piece.first + 1];
         ++n)
    {
      const int i = this->InElement.order[n];
      if (this->Tracer.pieceAt(this->Particles[i].location) == piece)
      {
        particles.push_back(i);
      }
    }
  }

  void addBoxes(const PieceNumber& piece, SparseComponent& component)
  {
    const auto [first, last] = this->Proxy.boxesOf(piece.first);
    for (std::size_t b = first; b < last; ++b)
    {
      const SurfaceProxy::Sample& sample = this->Proxy.samples()[b];
      if (sample.found && this->Tracer.pieceAt(sample.anchor.place) == piece)
      {
        component.boxes.push_back(static_cast<int>(b));
        component.area += 0.5 * std::sqrt(3.0) * this->Proxy.particleCountOfBox(b) *
          sample.patch.spacing * sample.patch.spacing;
      }
    }
  }

  const SurfaceProxy& Proxy;
  const Buffer<Particle>& Particles;
  ComponentTracer Tracer;
  Grouping InElement;
  std::set<PieceNumber> Seen;
};

/// Distributes particles on the surface in some boxes at one spacing.
FinishedParticles distributeInBoxes(const Isosurface& surface, const FaceJumps& jumps,
  std::vector<SurfaceBox> boxes, double spacing, std::uint64_t seed, const ParallelFor& parallelFor)
{
  const SizingFunction sizing{ spacing, 0.0 };
  const SurfaceProxy proxy(surface, sizing, std::move(boxes), parallelFor);
  MovingParticles moving(surface, proxy, {}, parallelFor);
  moving.draw(std::llround(proxy.particleCount()), seed);
  moving.approach();
  const std::vector<int> uncovered = chooseUncovered(
    proxy.samples(), findUncovered(proxy.samples(), moving.patches(), parallelFor), parallelFor);
  Buffer<Anchor> anchors;
  Buffer<Patch> patches;
  for (const int b : uncovered)
  {
    anchors.push_back(proxy.samples()[b].anchor);
    patches.push_back(proxy.samples()[b].patch);
  }
  moving.add(anchors, patches);
  for (int n = 0; n < OnComponent::Rounds; ++n)
  {
    moving.relax({ OnComponent::Sweeps }, {});
  }
  FinishedParticles finished = finishParticles(moving, jumps, sizing, parallelFor);
  finished.evaluations += proxy.evaluations() + moving.evaluations();
  keepMarked(finished.particles, finished.converged);
  return finished;
}

} // namespace

std::vector<SparseComponent> findSparseComponents(const Isosurface& surface,
  const SurfaceProxy& proxy, const Buffer<Patch>& patches, const Buffer<Particle>& particles,
  const ParallelFor& parallelFor)
{
  const std::vector<int> boxes = sparseBoxes(proxy, patches, parallelFor);
  return boxes.empty() ? std::vector<SparseComponent>{}
                       : ComponentSearch(surface, proxy, particles, parallelFor).run(boxes);
}

FinishedParticles distributeOnComponents(const Isosurface& surface, const SurfaceProxy& proxy,
  const FaceJumps& jumps, const std::vector<SparseComponent>& components, double finest,
  std::uint64_t seed, const ParallelFor& parallelFor)
{
  // By the logarithm of the spacing, rounded down.
  std::map<int, std::vector<int>> boxesOfSpacing;
  for (const SparseComponent& component : components)
  {
    const double spacing = std::sqrt(component.area / (0.5 * std::sqrt(3.0) * OnComponent::Count));
    const double level = std::log(spacing / finest) / std::log(OnComponent::SameSpacing);
    std::vector<int>& boxes = boxesOfSpacing[static_cast<int>(std::max(0.0, std::floor(level)))];
    boxes.insert(boxes.end(), component.boxes.begin(), component.boxes.end());
  }
  FinishedParticles result;
  for (auto& [level, boxes] : boxesOfSpacing)
  {
    std::sort(boxes.begin(), boxes.end());
    std::vector<SurfaceBox> taken;
    for (const int b : boxes)
    {
      taken.push_back(proxy.boxes()[b]);
    }
    const FinishedParticles some = distributeInBoxes(surface, jumps, std::move(taken),
      finest * std::pow(OnComponent::SameSpacing, level), seed, parallelFor);
    result.particles.insert(result.particles.end(), some.particles.begin(), some.particles.end());
    result.evaluations += some.evaluations;
  }
  return result;
}

} // namespace hop
