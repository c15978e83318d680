#pragma once

#include "Isolation/ProxyPolygons.h"
#include "Isolation/SizingField.h"
#include "Isolation/SurfaceBoxes.h"
#include "Surface/Anchor.h"

#include <optional>
#include <utility>

namespace hop
{

/// A rough substitute for the surface: one sample of the surface in each surface box, triangles in the box that
/// approximate the surface there, and the sizing field. It says how many particles the surface wants and where to put
/// the first ones.
/// Derivation: Documentation/algorithm.md, section Fast distribution.
class SurfaceProxy
{
public:
  /// A point near the surface.
  struct Sample
  {
    Anchor anchor;
    /// With the spacing that particles want at the sample.
    Patch patch;
    /// False if no point of the surface was found for the box; anchor and patch then mean nothing.
    bool found = false;
  };

  /// Puts a sample near the surface in each box. This costs one evaluation a box, more where the field in the box is
  /// far from linear. Where the sizing depends on curvature, no spacing of a sample exceeds another one by more than
  /// SizingField::GradationSlope times the distance of the samples.
  SurfaceProxy(const Isosurface& surface, const SizingFunction& sizing,
    std::vector<SurfaceBox> boxes, const ParallelFor& parallelFor);

  /// The same of a surface that has a proxy, with other boxes: elements that have the boxes which they have there keep
  /// their samples.
  /// \param limits as in limitSpacings()
  SurfaceProxy(const SurfaceProxy& before, std::vector<SurfaceBox> boxes,
    const std::vector<SizingField::Limit>& limits, const ParallelFor& parallelFor);

  /// Multiplies all spacings by a factor near 1, so that the boxes still have the right size; particleCount() falls by
  /// its square. No evaluation is made.
  void scaleSpacings(double factor);

  /// The spacing s of the sizing function at which the surface takes about so many particles: each box's share of
  /// particleCount() goes with the inverse square of the sizing function at its sample. Creases and gradation, which
  /// lower spacings further, are taken to lower all of them in the same ratio as now.
  /// \param count > 0
  double spacingFor(double count) const;

  /// Limits the spacings at some places and, by gradation, around them.
  void limitSpacings(const std::vector<SizingField::Limit>& limits, const ParallelFor& parallelFor);

  /// Number of particles in hexagonal packing at the spacings h of the sizing field: the sum of 2 area/(sqrt(3) h^2)
  /// over the triangles.
  double particleCount() const { return this->Sums.empty() ? 0.0 : this->Sums.back(); }

  /// The share of one box in particleCount().
  double particleCountOfBox(std::size_t box) const
  {
    return this->Sums[box] - (box > 0 ? this->Sums[box - 1] : 0.0);
  }

  /// The share of one element in particleCount().
  double particleCount(int element) const
  {
    const auto before = [this](std::size_t box) { return box > 0 ? this->Sums[box - 1] : 0.0; };
    return before(this->FirstBox[element + 1]) - before(this->FirstBox[element]);
  }

  /// Where a particle is to start.
  struct Seed
  {
    Location place;
    /// Index among boxes().
    int box = -1;
  };

  /// Seeds on the triangles, by systematic sampling of the density of particles: seed k stands where the sum of the
  /// triangles' numbers of particles reaches (k + phase) particleCount()/count. A seed that is alone in its box stands
  /// at the sample.
  /// \param phase in [0, 1)
  /// \return `count` seeds
  std::vector<Seed> seeds(std::int64_t count, double phase, const ParallelFor& parallelFor) const;

  /// Continues the patch of the box's sample to a seed, without an evaluation.
  /// \return whether the seed is so near to the sample that the patch is accurate there
  bool guess(const Seed& seed, Anchor& anchor, Patch& patch) const;

  /// The spacing that a particle wants, by the sizing field.
  float spacingAt(const glm::dvec3& position, float curvatureMagnitude) const
  {
    return this->Field.at(position, curvatureMagnitude);
  }

  /// Before spacings were scaled.
  const SizingFunction& sizing() const { return this->Field.sizing(); }

  /// Number of samples and limits that limit the spacings around them; zero if all samples want the same spacing and
  /// there are no limits.
  std::size_t spacingPlaces() const { return this->Field.placeCount(); }

  /// Smallest spacing of all samples.
  double smallestSpacing() const { return this->SmallestSpacing; }

  const std::vector<Sample>& samples() const { return this->Samples; }

  /// Indices of the first box of an element and of the first box behind the element's.
  std::pair<std::size_t, std::size_t> boxesOf(int element) const
  {
    return { this->FirstBox[element], this->FirstBox[element + 1] };
  }

  /// The sample of an element that is nearest to a position; nullptr if the element has no samples, or too many boxes
  /// for a search.
  const Sample* nearestSample(const glm::dvec3& position, int element) const;

  /// Where in an element a position near the surface lies, by the linear map at the element's nearest sample; nothing
  /// if the sample is too far away for the map to be accurate, or the position lies outside of the element.
  std::optional<Location> locate(const glm::dvec3& position, int element) const;

  const std::vector<SurfaceBox>& boxes() const { return this->Boxes; }
  /// The boxes of a proxy that is of no use afterwards.
  std::vector<SurfaceBox> takeBoxes() { return std::move(this->Boxes); }
  std::int64_t evaluations() const { return this->Evaluations; }

private:
  struct WeighedTriangle
  {
    ReferenceTriangle corners;
    glm::dvec3 middle{ 0.0 };
    /// Number of particles that the triangle wants.
    double weight = 0.0;
  };

  /// Room for what is found of one box after the other.
  struct Weighing
  {
    std::vector<ReferenceTriangle> corners;
    std::vector<WeighedTriangle> triangles;
    SizingField::Ball spacings;
  };

  void sampleBoxes(const SurfaceProxy* before, const ParallelFor& parallelFor);
  void findSpacings(std::vector<SizingField::Limit> limits, const ParallelFor& parallelFor);
  std::vector<char> keepSamples(const SurfaceProxy& before);
  std::int64_t sampleSome(std::vector<int> pending, std::vector<Location>& places);
  bool stepInBox(std::size_t box, Location& place) const;
  bool samplePatiently(std::size_t box, std::int64_t& evaluations);
  bool sampleAt(std::size_t box, const Location& place, const Jet& jet);
  std::vector<SizingField::Limit> chooseRepresentatives() const;
  void limitSamples(const ParallelFor& parallelFor);
  void findSmallestSpacing();
  void sumWeights(const ParallelFor& parallelFor);
  void seedBox(std::size_t box, std::int64_t first, std::int64_t last, double phase, double stride,
    Weighing& weighing, std::vector<Seed>& seeds) const;
  double weigh(std::size_t box, Weighing& weighing) const;

  Isosurface Surface;
  SizingField Field;
  std::vector<SurfaceBox> Boxes;
  std::vector<Sample> Samples;
  /// Index of the first box of each element, then the number of boxes; boxes are in the order of the elements.
  std::vector<std::size_t> FirstBox;
  /// Numbers of particles of all boxes up to each one.
  std::vector<double> Sums;
  std::int64_t Evaluations = 0;
  double SmallestSpacing = 0.0;
};

} // namespace hop
