#pragma once

#include "Isolation/ProxyPolygons.h"
#include "Isolation/SurfaceBoxes.h"
#include "Surface/Anchor.h"
#include "Surface/SizingFunction.h"

#include <memory>
#include <optional>
#include <utility>

namespace hop
{

class SpacingGrid;

/// A rough picture of the surface: one point of it in each surface box, and triangles between the
/// box's corners that stand for the piece of surface in it. It says how many particles the surface
/// wants and where to put the first ones.
class SurfaceProxy
{
public:
  struct Sample
  {
    Anchor anchor;
    /// With the spacing that particles want here.
    Patch patch;
    bool found = false;
  };

  /// Puts a point near the surface in each box; costs one evaluation a box, more where the field is far from
  /// linear in it. Then no spacing exceeds another by more than GradationSlope times their
  /// distance: neighbours can only pack evenly if their spacings differ little.
  SurfaceProxy(const Isosurface& surface, const SizingFunction& sizing,
    std::vector<SurfaceBox> boxes, const ParallelFor& parallelFor);
  SurfaceProxy(SurfaceProxy&&) noexcept;
  ~SurfaceProxy();

  /// A place at which particles are to have that spacing at most.
  struct SpacingLimit
  {
    glm::dvec3 position{ 0.0 };
    float spacing = 0.0f;
  };

  /// Lowers the spacings at and, graded as between samples, around some places.
  void limitSpacings(const std::vector<SpacingLimit>& limits, const ParallelFor& parallelFor);

  /// Number of particles in hexagonal packing at the spacings wanted: the sum of 2 area/(sqrt(3) h^2).
  double particleCount() const { return this->Sums.empty() ? 0.0 : this->Sums.back(); }

  double particleCountOfBox(std::size_t box) const
  {
    return this->Sums[box] - (box > 0 ? this->Sums[box - 1] : 0.0);
  }

  /// Those of them in one element.
  double particleCount(int element) const
  {
    const auto before = [this](std::size_t box) { return box > 0 ? this->Sums[box - 1] : 0.0; };
    return before(this->FirstBox[element + 1]) - before(this->FirstBox[element]);
  }

  struct Seed
  {
    Location place;
    int box = -1;
  };

  /// `count` places on the triangles, by systematic sampling of the density of particles: the k-th
  /// stands where the sum of the weights reaches (k + phase) particleCount()/count. The only one in its box
  /// stands at the sample.
  /// \param phase in [0, 1)
  std::vector<Seed> seeds(std::int64_t count, double phase, const ParallelFor& parallelFor) const;

  /// What the box's sample says about the surface at a seed.
  /// \return whether the seed is near enough to the sample for it to be believed
  bool guess(const Seed& seed, Anchor& anchor, Patch& patch) const;

  /// The spacing that a particle wants: that of the sizing function at its own curvature, or less near places
  /// that want less. Graded like the samples.
  float spacingAt(const glm::dvec3& position, float curvatureMagnitude) const;

  const SizingFunction& sizing() const { return this->Sizing; }

  /// How many samples and limits tell the spacings around them; none where all want the same.
  std::size_t spacingPlaces() const { return this->Spacings.size(); }

  /// Of all samples.
  double smallestSpacing() const { return this->SmallestSpacing; }

  const std::vector<Sample>& samples() const { return this->Samples; }

  /// The first of an element's boxes, and the first behind them.
  std::pair<std::size_t, std::size_t> boxesOf(int element) const
  {
    return { this->FirstBox[element], this->FirstBox[element + 1] };
  }

  /// The sample in an element that is nearest to a position; nullptr if there is none, or too many to search.
  const Sample* nearestSample(const glm::dvec3& position, int element) const;

  /// Where a position near the surface lies in an element, by the map at the nearest sample there; nothing if
  /// that is too far off to tell, or the position lies outside.
  std::optional<Location> locate(const glm::dvec3& position, int element) const;

  const std::vector<SurfaceBox>& boxes() const { return this->Boxes; }
  std::int64_t evaluations() const { return this->Evaluations; }

  static constexpr double GradationSlope = 0.3;

private:
  struct WeighedTriangle
  {
    ReferenceTriangle corners;
    /// Number of particles.
    double weight = 0.0;
  };

  void putOnSurface(const ParallelFor& parallelFor);
  bool stepInBox(std::size_t box, Location& place) const;
  bool samplePatiently(std::size_t box, std::int64_t& evaluations);
  bool sampleAt(std::size_t box, const Location& place, const Jet& jet);
  void collectSpacings();
  void limitGradation(std::size_t first, const ParallelFor& parallelFor);
  void findSmallestSpacing();
  void sumWeights(const ParallelFor& parallelFor);
  void seedBox(std::size_t box, std::int64_t first, std::int64_t last, double phase, double stride,
    std::vector<Seed>& seeds) const;
  double weigh(std::size_t box, std::vector<WeighedTriangle>& triangles) const;

  Isosurface Surface;
  SizingFunction Sizing;
  std::vector<SurfaceBox> Boxes;
  std::vector<Sample> Samples;
  /// Where the boxes of each element begin; they come in the order of the elements.
  std::vector<std::size_t> FirstBox;
  /// Weights of the boxes, summed up.
  std::vector<double> Sums;
  std::int64_t Evaluations = 0;
  double SmallestSpacing = 0.0;
  // For looking up spacings, where they vary: those of samples, as many as tell them, then limits.
  std::vector<int> Graded;
  std::vector<glm::dvec3> Positions;
  std::vector<float> Spacings;
  std::unique_ptr<SpacingGrid> Grid;
};

} // namespace hop
