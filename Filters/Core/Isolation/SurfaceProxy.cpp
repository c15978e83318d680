#include "Isolation/SurfaceProxy.h"

#include "Isolation/FaceSheets.h"
#include "Isolation/ProxyPolygons.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace hop
{
namespace
{

/// How near samples come to the surface. The figures were chosen by experiment: smaller ones cost more evaluations,
/// larger ones make areas, spacings and guesses at seeds less exact.
struct Sampling
{
  /// Distance of a sample from the surface at most: the larger one of a share of the size of its box, and a share of
  /// the spacing there.
  static constexpr double OffsetPerSize = 0.02;
  static constexpr double OffsetPerSpacing = 0.2;
  /// Evaluations of a box, with a Newton step between one and the next, before it is sampled patiently.
  static constexpr int MaximumSteps = 3;
  /// Of samplePatiently: tolerance of Newton's method in units of the largest offset, and the farthest way to the
  /// surface in units of the size of the box.
  static constexpr double Tolerance = 0.5;
  static constexpr double Travel = 2.0;
};

/// Limits of the areas that a sample's patch gives to the triangles around it. They hold where the surface bends too
/// much for its box. Chosen by experiment: larger limits overestimate the number of particles there, smaller ones
/// underestimate it.
struct Areas
{
  /// Way of a triangle's corner along the normal to the patch, in units of the radius to which the surface bends.
  static constexpr double LargestShift = 0.3;
  /// Ratio of the area of the patch to the area in the tangent plane: 2 is a slope of 60 degrees.
  static constexpr double LargestStretch = 2.0;
};

/// Up to where a sample's patch stands for the surface around it. Chosen by experiment: larger limits put particles
/// farther from the surface, smaller ones cost evaluations at seeds.
struct Guesses
{
  /// Distance from the sample, in units of its spacing.
  static constexpr double Reach = 1.5;
  /// Angle by which the surface turns on the way, radians: distance times curvature.
  static constexpr double Turn = 0.5;
};

/// Finding places by the maps of samples. Chosen by experiment.
struct Locating
{
  /// Distance from the sample up to which its linear map tells where places lie, in units of its spacing. A larger one
  /// gives less exact places, a smaller one costs a search by Newton's method more often.
  static constexpr double Reach = 1.2;
  /// Boxes of an element above which the nearest sample is not searched: most particles in elements with more boxes do
  /// not come near the faces, where it is asked for. A search takes time in proportion to the number of boxes.
  static constexpr std::size_t MostBoxes = 256;
};

/// Index of the first box of each element, then the number of boxes.
std::vector<std::size_t> boxRanges(const std::vector<SurfaceBox>& boxes, std::size_t elements)
{
  std::vector<std::size_t> first(elements + 1, 0);
  for (const SurfaceBox& box : boxes)
  {
    ++first[box.middle.element + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

/// Maps a triangle's corners, in reference space, to the tangent plane of a sample, and tells areas on its patch.
class PatchAreas
{
public:
  explicit PatchAreas(const SurfaceProxy::Sample& sample)
    : Sampled(sample)
    , Push(glm::inverse(glm::dmat3(sample.anchor.pull)))
    , Tangents(tangentsOf(sample.patch.normal))
  {
  }

  /// Where in the tangent plane the patch is nearest to a corner. Where the surface bends, corners lie off the patch by
  /// the square of the size of their box: they move to the patch along its normal, which is (S t, 1) above a place t.
  glm::dvec2 inPlane(const glm::vec3& corner) const
  {
    const Patch& patch = this->Sampled.patch;
    const Anchor& anchor = this->Sampled.anchor;
    const glm::dvec3 d = this->Push * (glm::dvec3(corner) - anchor.place.u.xyz);
    const glm::dvec2 t(
      glm::dot(d, glm::dvec3(this->Tangents[0])), glm::dot(d, glm::dvec3(this->Tangents[1])));
    const double off = glm::dot(d, glm::dvec3(patch.normal)) - anchor.offset + patch.sink(t);
    const double farthest = Areas::LargestShift / patch.curvatureMagnitude();
    return t - std::clamp(off, -farthest, farthest) * patch.slope(t);
  }

  /// Area of the patch above a triangle of the tangent plane: sqrt(1 + |S t|^2) times the triangle's, t its middle.
  double area(
    const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& middle) const
  {
    const glm::dvec2 slope = this->Sampled.patch.slope(middle);
    const double stretch = std::min(Areas::LargestStretch, std::sqrt(1.0 + glm::dot(slope, slope)));
    const double footprint = 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    return stretch * footprint;
  }

private:
  const SurfaceProxy::Sample& Sampled;
  glm::dmat3 Push;
  std::array<glm::vec3, 2> Tangents;
};

} // namespace

SurfaceProxy::SurfaceProxy(const Isosurface& surface, const SizingFunction& sizing,
  std::vector<SurfaceBox> boxes, const ParallelFor& parallelFor)
  : Surface(surface)
  , Field(sizing)
  , Boxes(assignFaceSheets(surface, std::move(boxes), parallelFor))
  , Samples(this->Boxes.size())
  , FirstBox(boxRanges(this->Boxes, surface.mesh->elements.size()))
{
  this->sampleBoxes(nullptr, parallelFor);
  this->findSpacings({}, parallelFor);
}

SurfaceProxy::SurfaceProxy(const SurfaceProxy& before, std::vector<SurfaceBox> boxes,
  const std::vector<SizingField::Limit>& limits, const ParallelFor& parallelFor)
  : Surface(before.Surface)
  , Field(before.sizing())
  , Boxes(assignFaceSheets(before.Surface, std::move(boxes), parallelFor))
  , Samples(this->Boxes.size())
  , FirstBox(boxRanges(this->Boxes, before.Surface.mesh->elements.size()))
{
  this->sampleBoxes(&before, parallelFor);
  this->findSpacings(limits, parallelFor);
}

/// The sizing field of the samples and of further limits, and what follows from it.
void SurfaceProxy::findSpacings(
  std::vector<SizingField::Limit> limits, const ParallelFor& parallelFor)
{
  for (Sample& sample : this->Samples)
  {
    sample.patch.spacing = static_cast<float>(this->sizing().at(sample.patch.curvatureMagnitude()));
  }
  if (this->sizing().angularDensity > 0.0)
  {
    const std::vector<SizingField::Limit> ofSamples = this->chooseRepresentatives();
    limits.insert(limits.end(), ofSamples.begin(), ofSamples.end());
  }
  if (!limits.empty())
  {
    this->Field.add(std::move(limits), parallelFor);
    this->limitSamples(parallelFor);
  }
  this->findSmallestSpacing();
  this->sumWeights(parallelFor);
}

void SurfaceProxy::scaleSpacings(double factor)
{
  this->Field.scale(factor);
  this->SmallestSpacing *= factor;
  for (Sample& sample : this->Samples)
  {
    sample.patch.spacing *= static_cast<float>(factor);
  }
  for (double& sum : this->Sums)
  {
    sum /= factor * factor;
  }
}

double SurfaceProxy::spacingFor(double count) const
{
  // Each step multiplies the spacing by the square root of counted and wanted number. That is exact where the surface
  // is flat, and too little where it bends, so that the steps approach the spacing from one side. Chosen by experiment:
  // more steps change the spacing by less than the samples know it.
  constexpr int steps = 20;
  SizingFunction sizing = this->sizing();
  for (int n = 0; n<steps&& this->particleCount()> 0.0; ++n)
  {
    double counted = 0.0;
    for (std::size_t b = 0; b < this->Boxes.size(); ++b)
    {
      const double bend = this->Samples[b].patch.curvatureMagnitude();
      const double ratio = this->sizing().at(bend) / sizing.at(bend);
      counted += this->Samples[b].found ? ratio * ratio * this->particleCountOfBox(b) : 0.0;
    }
    sizing.spacing *= std::sqrt(counted / count);
  }
  return sizing.spacing;
}

const SurfaceProxy::Sample* SurfaceProxy::nearestSample(
  const glm::dvec3& position, int element) const
{
  const Sample* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  const auto [first, last] = this->boxesOf(element);
  for (std::size_t b = first; b < last && last - first <= Locating::MostBoxes; ++b)
  {
    const double distance = glm::distance(this->Samples[b].patch.position, position);
    if (this->Samples[b].found && distance < least)
    {
      least = distance;
      nearest = &this->Samples[b];
    }
  }
  return nearest;
}

std::optional<Location> SurfaceProxy::locate(const glm::dvec3& position, int element) const
{
  const Sample* sample = this->nearestSample(position, element);
  if (!sample)
  {
    return std::nullopt;
  }
  const Patch& patch = sample->patch;
  const glm::dvec3 from =
    patch.position - static_cast<double>(sample->anchor.offset) * glm::dvec3(patch.normal);
  const ReferencePoint u{ sample->anchor.place.u.xyz +
    glm::dmat3(sample->anchor.pull) * (position - from) };
  const bool isThere = glm::distance(position, from) <= Locating::Reach * patch.spacing &&
    insideMargin(this->Surface.mesh->elements[element].domain, u) >= 0.0;
  return isThere ? std::optional<Location>({ element, u }) : std::nullopt;
}

void SurfaceProxy::findSmallestSpacing()
{
  this->SmallestSpacing = this->sizing().spacing;
  for (const Sample& sample : this->Samples)
  {
    this->SmallestSpacing = std::min<double>(
      this->SmallestSpacing, sample.found ? sample.patch.spacing : this->sizing().spacing);
  }
}

void SurfaceProxy::limitSpacings(
  const std::vector<SizingField::Limit>& limits, const ParallelFor& parallelFor)
{
  if (!limits.empty())
  {
    this->Field.add(limits, parallelFor);
    this->limitSamples(parallelFor);
    this->findSmallestSpacing();
    this->sumWeights(parallelFor);
  }
}

/// Makes a sample of an evaluation.
/// \return whether it is near enough to the surface
bool SurfaceProxy::sampleAt(std::size_t box, const Location& place, const Jet& jet)
{
  Sample& sample = this->Samples[box];
  sample.found = anchorPatch(place, jet, this->Surface.isovalue, sample.anchor, sample.patch) &&
    std::abs(sample.anchor.offset) <=
      std::max(Sampling::OffsetPerSize * this->Boxes[box].size,
        Sampling::OffsetPerSpacing * this->sizing().at(sample.patch.curvatureMagnitude()));
  return sample.found;
}

/// Finds a sample for each box.
/// \param before the proxy from which samples may be taken; nullptr: there is none
void SurfaceProxy::sampleBoxes(const SurfaceProxy* before, const ParallelFor& parallelFor)
{
  std::atomic<std::int64_t> evaluations{ 0 };
  const std::vector<char> isKept =
    before ? this->keepSamples(*before) : std::vector<char>(this->Boxes.size(), 0);
  std::vector<Location> places(this->Boxes.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Boxes.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::vector<int> pending;
      for (auto b = static_cast<int>(begin); b < end; ++b)
      {
        if (!isKept[b])
        {
          pending.push_back(b);
        }
      }
      evaluations += this->sampleSome(std::move(pending), places);
    });
  this->Evaluations = evaluations;
}

/// Takes the samples of elements that have the boxes of before.
/// \return marks of the boxes that have one
std::vector<char> SurfaceProxy::keepSamples(const SurfaceProxy& before)
{
  std::vector<char> isKept(this->Boxes.size(), 0);
  for (std::size_t e = 0; e + 1 < this->FirstBox.size(); ++e)
  {
    const auto [first, last] = this->boxesOf(static_cast<int>(e));
    const auto [firstBefore, lastBefore] = before.boxesOf(static_cast<int>(e));
    const auto isSame = [](const SurfaceBox& a, const SurfaceBox& b)
    { return a.middle.u.xyz == b.middle.u.xyz && a.size == b.size; };
    if (std::equal(this->Boxes.begin() + first, this->Boxes.begin() + last,
          before.Boxes.begin() + firstBefore, before.Boxes.begin() + lastBefore, isSame))
    {
      std::copy(before.Samples.begin() + firstBefore, before.Samples.begin() + lastBefore,
        this->Samples.begin() + first);
      std::fill(isKept.begin() + first, isKept.begin() + last, 1);
    }
  }
  return isKept;
}

/// Samples some boxes by Newton's method from the middle of their triangles, which is near the surface already. Boxes of
/// one element are evaluated together. A box whose place is not near enough takes a Newton step and is evaluated again; if
/// the steps leave the box, or are too many, it is sampled patiently.
/// \param places room for one a box
/// \return number of evaluations
std::int64_t SurfaceProxy::sampleSome(std::vector<int> pending, std::vector<Location>& places)
{
  const ElementMesh& mesh = *this->Surface.mesh;
  std::int64_t evaluations = 0;
  for (const int b : pending)
  {
    const int element = this->Boxes[b].middle.element;
    places[b] = { element, proxyMiddle(mesh.elements[element].domain, this->Boxes[b]) };
  }
  std::vector<int> missed;
  for (int step = 0; step < Sampling::MaximumSteps && !pending.empty(); ++step)
  {
    std::vector<int> next;
    evaluateInOrder(mesh, places, pending, 0, static_cast<std::ptrdiff_t>(pending.size()),
      [&](int b, const Jet& jet)
      {
        if (!this->sampleAt(b, places[b], jet))
        {
          (this->stepInBox(b, places[b]) ? next : missed).push_back(b);
        }
      });
    evaluations += static_cast<std::int64_t>(pending.size());
    pending = std::move(next);
  }
  missed.insert(missed.end(), pending.begin(), pending.end());
  for (const int b : missed)
  {
    this->samplePatiently(b, evaluations);
  }
  return evaluations;
}

/// Moves a place by one Newton step from the sample there.
/// \return whether the place still is in the box, and in the element
bool SurfaceProxy::stepInBox(std::size_t b, Location& place) const
{
  const Anchor& anchor = this->Samples[b].anchor;
  if (anchor.place.element < 0)
  {
    return false; // The place has no patch.
  }
  const glm::vec3 step = anchor.pull * (anchor.offset * this->Samples[b].patch.normal);
  place.u.xyz += glm::dvec3(step);
  const Domain domain = this->Surface.mesh->elements[place.element].domain;
  return isAtBox(this->Boxes[b], place) && insideMargin(domain, place.u) >= 0.0;
}

/// Samples a box at a point between its two ends or, where it does not straddle or that point is not near enough, by
/// Newton's method across elements.
/// \return whether a sample was found
bool SurfaceProxy::samplePatiently(std::size_t b, std::int64_t& evaluations)
{
  const SurfaceBox& box = this->Boxes[b];
  const ElementMesh& mesh = *this->Surface.mesh;
  const auto sample = [&](const Location& place)
  {
    ++evaluations;
    return this->sampleAt(b, place, exactHessian(mesh, place));
  };
  Location start = box.middle;
  if (box.straddles)
  {
    start = findBetweenEnds(mesh, this->Surface.isovalue, box, evaluations);
    if (sample(start))
    {
      return true;
    }
  }
  Isosurface roughly = this->Surface;
  roughly.tolerance =
    std::max(this->Surface.tolerance, Sampling::Tolerance * Sampling::OffsetPerSize * box.size);
  SurfaceWalker walker(roughly);
  Evaluated at;
  const bool found = walker.project(start, Sampling::Travel * box.size, at);
  evaluations += walker.evaluations();
  return found && sample(at.location);
}

/// Samples whose spacings are places of the sizing field. Boxes that are neither certified nor straddle may hold no
/// surface: their samples do not limit spacings.
std::vector<SizingField::Limit> SurfaceProxy::chooseRepresentatives() const
{
  std::vector<int> representatives;
  std::vector<glm::dvec3> positions;
  std::vector<float> spacings;
  for (std::size_t b = 0; b < this->Samples.size(); ++b)
  {
    const bool isTrusted = this->Boxes[b].certified || this->Boxes[b].straddles;
    if (this->Samples[b].found && isTrusted)
    {
      representatives.push_back(static_cast<int>(b));
      positions.push_back(this->Samples[b].patch.position);
      spacings.push_back(this->Samples[b].patch.spacing);
    }
  }
  keepMarked(representatives, markRepresentatives(positions, spacings));
  std::vector<SizingField::Limit> chosen;
  for (const int sample : representatives)
  {
    const Patch& patch = this->Samples[sample].patch;
    chosen.push_back({ patch.position, patch.spacing });
  }
  return chosen;
}

/// Limits the spacings of all samples by the sizing field.
void SurfaceProxy::limitSamples(const ParallelFor& parallelFor)
{
  forAll(parallelFor, this->Samples.size(),
    [this](std::size_t b)
    {
      Patch& patch = this->Samples[b].patch;
      patch.spacing =
        this->Samples[b].found ? this->Field.limited(patch.position, patch.spacing) : patch.spacing;
    });
}

/// Sums up the numbers of particles of the boxes.
void SurfaceProxy::sumWeights(const ParallelFor& parallelFor)
{
  this->Sums.resize(this->Boxes.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Boxes.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      Weighing weighing;
      for (std::ptrdiff_t b = begin; b < end; ++b)
      {
        this->Sums[b] = this->weigh(b, weighing);
      }
    });
  std::partial_sum(this->Sums.begin(), this->Sums.end(), this->Sums.begin());
}

/// The triangles of a box with the numbers of particles that they want.
/// \return the sum of the numbers
double SurfaceProxy::weigh(std::size_t which, Weighing& weighing) const
{
  weighing.triangles.clear();
  weighing.corners.clear();
  const Sample& sample = this->Samples[which];
  if (!sample.found)
  {
    return 0.0;
  }
  const SurfaceBox& box = this->Boxes[which];
  appendProxyTriangles(
    this->Surface.mesh->elements[box.middle.element].domain, box, weighing.corners);
  const PatchAreas areas(sample);
  const Patch& patch = sample.patch;
  double radius = 0.0;
  for (const ReferenceTriangle& t : weighing.corners)
  {
    const glm::dvec2 a = areas.inPlane(t[0]);
    const glm::dvec2 b = areas.inPlane(t[1]);
    const glm::dvec2 c = areas.inPlane(t[2]);
    const glm::dvec2 middle = (a + b + c) / 3.0;
    const glm::dvec3 position = patch.position + patch.step(glm::vec2(middle));
    weighing.triangles.push_back({ t, position, areas.area(a, b, c, middle) * 2.0 });
    radius = std::max(radius, glm::distance(position, patch.position));
  }
  this->Field.lookAround(patch.position, radius, patch.curvatureMagnitude(), weighing.spacings);
  double sum = 0.0;
  for (WeighedTriangle& triangle : weighing.triangles)
  {
    const double h = weighing.spacings.at(triangle.middle);
    triangle.weight /= std::sqrt(3.0) * h * h;
    sum += triangle.weight;
  }
  return sum;
}

/// Puts the seeds first to last - 1 into the triangles of a box, where the sum of the numbers of particles reaches
/// each.
void SurfaceProxy::seedBox(std::size_t box, std::int64_t first, std::int64_t last, double phase,
  double stride, Weighing& weighing, std::vector<Seed>& seeds) const
{
  // (sqrt(5) - 1)/2: its multiples, less their whole parts, are the sequence in which any few next to each other are
  // spread most evenly. It places seeds across the triangles.
  constexpr double goldenRatio = 0.61803398874989485;
  if (last - first == 1)
  {
    seeds[first] = { this->Samples[box].anchor.place, static_cast<int>(box) };
    return;
  }
  double sum = this->Sums[box] - this->weigh(box, weighing);
  const std::vector<WeighedTriangle>& triangles = weighing.triangles;
  std::size_t t = 0;
  for (std::int64_t k = first; k < last; ++k)
  {
    const double wanted = (static_cast<double>(k) + phase) * stride;
    while (t + 1 < triangles.size() && wanted >= sum + triangles[t].weight)
    {
      sum += triangles[t++].weight;
    }
    // The square root keeps areas: equal steps of `wanted` enclose equal parts of the triangle.
    const auto& corners = triangles[t].corners;
    const double root = std::sqrt(std::clamp((wanted - sum) / triangles[t].weight, 0.0, 1.0));
    const double across = std::fmod(goldenRatio * static_cast<double>(k), 1.0);
    const glm::dvec3 u = (1.0 - root) * glm::dvec3(corners[0]) +
      root * (1.0 - across) * glm::dvec3(corners[1]) + root * across * glm::dvec3(corners[2]);
    seeds[k] = { { this->Boxes[box].middle.element, { u } }, static_cast<int>(box) };
  }
}

std::vector<SurfaceProxy::Seed> SurfaceProxy::seeds(
  std::int64_t count, double phase, const ParallelFor& parallelFor) const
{
  std::vector<Seed> seeds(count);
  const double stride = this->particleCount() / static_cast<double>(count);
  // The first seed that is not before a given sum.
  const auto firstFrom = [&](double sum)
  { return std::clamp<std::int64_t>(std::llround(std::ceil(sum / stride - phase)), 0, count); };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Boxes.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      Weighing weighing;
      for (std::ptrdiff_t b = begin; b < end; ++b)
      {
        const std::int64_t first = b > 0 ? firstFrom(this->Sums[b - 1]) : 0;
        const bool isLast = this->Sums[b] == this->Sums.back();
        const std::int64_t last = isLast ? count : firstFrom(this->Sums[b]);
        if (first < last && (b == 0 || this->Sums[b] > this->Sums[b - 1]))
        {
          this->seedBox(b, first, last, phase, stride, weighing, seeds);
        }
      }
    });
  seeds.erase(
    std::remove_if(seeds.begin(), seeds.end(), [](const Seed& seed) { return seed.box < 0; }),
    seeds.end());
  return seeds;
}

bool SurfaceProxy::guess(const Seed& seed, Anchor& anchor, Patch& patch) const
{
  const Sample& sample = this->Samples[seed.box];
  continuePatch(sample.anchor, sample.patch, seed.place, anchor, patch);
  const double distance = glm::distance(patch.position, sample.patch.position);
  if (distance > Guesses::Reach * sample.patch.spacing ||
    distance * sample.patch.curvatureMagnitude() > Guesses::Turn)
  {
    return false;
  }
  patch.spacing = this->spacingAt(patch.position, patch.curvatureMagnitude());
  return true;
}

} // namespace hop
