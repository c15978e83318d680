#include "Isolation/SurfaceProxy.h"

#include "Isolation/FaceSheets.h"
#include "Isolation/ProxyPolygons.h"
#include "Support/KeepMarked.h"
#include "Support/SpacingGrid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

namespace hop
{
namespace
{

/// A sample may be this far from the surface, in units of its box, or of its spacing.
constexpr double sampleOffset = 0.02;
constexpr double offsetPerSpacing = 0.2;
/// Corners of triangles are moved by at most this share of the radius to which the surface bends.
constexpr double largestShift = 0.3;
/// A patch is not believed to be steeper than this makes it.
constexpr double largestStretch = 2.0;
/// A sample tells about the surface this far from it, in units of its spacing and of the radius to which the
/// surface bends.
constexpr double guessReach = 1.5;
constexpr double guessTurn = 0.5;
/// How far a sample's spacing is felt, in units of its own, where spacings are looked up.
constexpr double lookUpReach = 4.0;
/// Of more than so many samples in a cell of a quarter to half of their spacings the one that wants the least
/// stands for all; where cells hold more than four on average, elements are finer than spacings, of any more
/// than one. What differs is the way from a place in the cell to another.
constexpr double cellPerSpacing = 0.25;
constexpr std::ptrdiff_t mostInCell = 16;
constexpr double fineAverage = 4.0;

/// A sample's map tells where places lie that are no farther from it, in units of its spacing.
constexpr double mapReach = 1.2;
/// Elements of more boxes are not looked through for the nearest sample: most particles in them do not come
/// near their faces.
constexpr std::size_t mostBoxesToSearch = 256;

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

/// Which samples tell others their spacings: all, unless they stand close together beside their spacings, when
/// each would be looked at from all others around.
std::vector<char> markStandIns(Span<glm::dvec3> positions, Span<float> spacings)
{
  const SpacingGrid cells(positions, spacings, cellPerSpacing);
  std::vector<SpacingGrid::Points> groups;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const SpacingGrid::Points mates = cells.cellMates(static_cast<int>(i));
    if (*mates.begin() == static_cast<int>(i))
    {
      groups.push_back(mates);
    }
  }
  const bool isFine =
    static_cast<double>(positions.size()) > fineAverage * static_cast<double>(groups.size());
  const auto lessSpacing = [&](int a, int b) { return spacings[a] < spacings[b]; };
  std::vector<char> marks(positions.size(), 1);
  for (const SpacingGrid::Points& group : groups)
  {
    if (group.end() - group.begin() > (isFine ? 1 : mostInCell))
    {
      for (const int one : group)
      {
        marks[one] = 0;
      }
      marks[*std::min_element(group.begin(), group.end(), lessSpacing)] = 1;
    }
  }
  return marks;
}

} // namespace

SurfaceProxy::SurfaceProxy(const Isosurface& surface, const SizingFunction& sizing,
  std::vector<SurfaceBox> boxes, const ParallelFor& parallelFor)
  : Surface(surface)
  , Sizing(sizing)
  , Boxes(giveFaceSheetsOnce(surface, std::move(boxes), parallelFor))
  , Samples(this->Boxes.size())
  , FirstBox(boxRanges(this->Boxes, surface.mesh->elements.size()))
{
  this->putOnSurface(parallelFor);
  for (Sample& sample : this->Samples)
  {
    sample.patch.spacing = static_cast<float>(sizing.at(sample.patch.curvatureMagnitude()));
  }
  if (sizing.angularDensity > 0.0)
  {
    this->collectSpacings();
    this->limitGradation(0, parallelFor);
  }
  this->findSmallestSpacing();
  this->sumWeights(parallelFor);
}

SurfaceProxy::SurfaceProxy(SurfaceProxy&&) noexcept = default;
SurfaceProxy::~SurfaceProxy() = default;

const SurfaceProxy::Sample* SurfaceProxy::nearestSample(
  const glm::dvec3& position, int element) const
{
  const Sample* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  const auto [first, last] = this->boxesOf(element);
  for (std::size_t b = first; b < last && last - first <= mostBoxesToSearch; ++b)
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
  const bool isThere = glm::distance(position, from) <= mapReach * patch.spacing &&
    insideMargin(this->Surface.mesh->elements[element].domain, u) >= 0.0;
  return isThere ? std::optional<Location>({ element, u }) : std::nullopt;
}

void SurfaceProxy::findSmallestSpacing()
{
  this->SmallestSpacing = this->Sizing.spacing;
  for (const Sample& sample : this->Samples)
  {
    this->SmallestSpacing = std::min<double>(
      this->SmallestSpacing, sample.found ? sample.patch.spacing : this->Sizing.spacing);
  }
}

void SurfaceProxy::limitSpacings(
  const std::vector<SpacingLimit>& limits, const ParallelFor& parallelFor)
{
  if (!limits.empty())
  {
    const std::size_t first = this->Spacings.size();
    for (const SpacingLimit& limit : limits)
    {
      this->Positions.push_back(limit.position);
      this->Spacings.push_back(limit.spacing);
    }
    this->limitGradation(first, parallelFor);
    this->findSmallestSpacing();
    this->sumWeights(parallelFor);
  }
}

bool SurfaceProxy::sampleAt(std::size_t box, const Location& place, const Jet& jet)
{
  Sample& sample = this->Samples[box];
  sample.found = anchorPatch(place, jet, this->Surface.isovalue, sample.anchor, sample.patch) &&
    std::abs(sample.anchor.offset) <=
      std::max(sampleOffset * this->Boxes[box].size,
        offsetPerSpacing * this->Sizing.at(sample.patch.curvatureMagnitude()));
  return sample.found;
}

/// Newton's method from the middle of the box's triangles, which is near the surface already: where the
/// first evaluation is not near enough, up to two more steps. All boxes of an element at once.
void SurfaceProxy::putOnSurface(const ParallelFor& parallelFor)
{
  constexpr int mostSteps = 3;
  const ElementMesh& mesh = *this->Surface.mesh;
  std::atomic<std::int64_t> evaluations{ 0 };
  std::vector<Location> places(this->Boxes.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Boxes.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::int64_t count = 0;
      std::vector<int> pending(end - begin);
      std::iota(pending.begin(), pending.end(), static_cast<int>(begin));
      for (const int b : pending)
      {
        const int element = this->Boxes[b].middle.element;
        places[b] = { element, proxyMiddle(mesh.elements[element].domain, this->Boxes[b]) };
      }
      std::vector<int> missed;
      for (int step = 0; step < mostSteps && !pending.empty(); ++step)
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
        count += static_cast<std::int64_t>(pending.size());
        pending = std::move(next);
      }
      missed.insert(missed.end(), pending.begin(), pending.end());
      for (const int b : missed)
      {
        this->samplePatiently(b, count);
      }
      evaluations += count;
    });
  this->Evaluations = evaluations;
}

/// Takes a place to where one Newton step leads from the sample there.
/// \return whether that is in the box
bool SurfaceProxy::stepInBox(std::size_t b, Location& place) const
{
  const Anchor& anchor = this->Samples[b].anchor;
  if (anchor.place.element < 0)
  {
    return false; // no patch could be had
  }
  const glm::vec3 step = anchor.pull * (anchor.offset * this->Samples[b].patch.normal);
  place.u.xyz += glm::dvec3(step);
  const Domain domain = this->Surface.mesh->elements[place.element].domain;
  return isAtBox(this->Boxes[b], place) && insideMargin(domain, place.u) >= 0.0;
}

/// A point between two corners of the box or, where that is not near enough yet or there is none, Newton's
/// method to the end.
bool SurfaceProxy::samplePatiently(std::size_t b, std::int64_t& evaluations)
{
  const SurfaceBox& box = this->Boxes[b];
  const ElementMesh& mesh = *this->Surface.mesh;
  const auto sample = [&](const Location& place)
  {
    ++evaluations;
    return this->sampleAt(b, place, evaluateHessian(mesh.form(place.element), place.u));
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
  roughly.tolerance = std::max(this->Surface.tolerance, 0.5 * sampleOffset * box.size);
  SurfaceWalker walker(roughly);
  Evaluated at;
  const bool found = walker.project(start, 2.0 * box.size, at);
  evaluations += walker.evaluations();
  return found && sample(at.location);
}

/// Fills the list of places where spacings are known. What lies in boxes that are neither certified nor
/// straddle may be no surface: it does not tell others their spacings.
void SurfaceProxy::collectSpacings()
{
  for (std::size_t b = 0; b < this->Samples.size(); ++b)
  {
    const bool isTrusted = this->Boxes[b].certified || this->Boxes[b].straddles;
    if (this->Samples[b].found && isTrusted)
    {
      this->Graded.push_back(static_cast<int>(b));
      this->Positions.push_back(this->Samples[b].patch.position);
      this->Spacings.push_back(this->Samples[b].patch.spacing);
    }
  }
  const std::vector<char> marks = markStandIns(this->Positions, this->Spacings);
  keepMarked(this->Graded, marks);
  keepMarked(this->Positions, marks);
  keepMarked(this->Spacings, marks);
}

/// Dijkstra's method: from the smallest spacing on, each place limits those around it.
/// \param first of the places that are new; those before are graded among themselves
void SurfaceProxy::limitGradation(std::size_t first, const ParallelFor& parallelFor)
{
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t i = first; i < this->Spacings.size(); ++i)
  {
    queue.emplace(this->Spacings[i], static_cast<int>(i));
  }
  const std::vector<float> before = this->Spacings;
  const SpacingGrid grid(this->Positions, before, lookUpReach);
  constexpr std::size_t someEntries = 256;
  for (std::size_t n = 1; !queue.empty(); ++n)
  {
    if (n % someEntries == 0)
    {
      askCaller(parallelFor);
    }
    const auto [spacing, i] = queue.top();
    queue.pop();
    if (spacing > this->Spacings[i])
    {
      continue;
    }
    grid.visitCoarser(this->Positions[i], spacing, GradationSlope,
      [&, h = spacing, from = i](int j)
      {
        const auto limit = static_cast<float>(
          h + GradationSlope * glm::distance(this->Positions[from], this->Positions[j]));
        if (limit < this->Spacings[j])
        {
          this->Spacings[j] = limit;
          queue.emplace(limit, j);
        }
      });
  }
  this->Grid = std::make_unique<SpacingGrid>(this->Positions, this->Spacings, lookUpReach);
  forAll(parallelFor, this->Samples.size(),
    [this](std::size_t b)
    {
      Patch& patch = this->Samples[b].patch;
      patch.spacing = this->Samples[b].found
        ? this->Grid->withGradation(patch.position, patch.spacing, GradationSlope)
        : patch.spacing;
    });
  for (std::size_t i = 0; i < this->Graded.size(); ++i)
  {
    this->Samples[this->Graded[i]].patch.spacing = this->Spacings[i];
  }
}

float SurfaceProxy::spacingAt(const glm::dvec3& position, float curvatureMagnitude) const
{
  const auto spacing = static_cast<float>(this->Sizing.at(curvatureMagnitude));
  return this->Grid ? this->Grid->withGradation(position, spacing, GradationSlope) : spacing;
}

void SurfaceProxy::sumWeights(const ParallelFor& parallelFor)
{
  this->Sums.resize(this->Boxes.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Boxes.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::vector<WeighedTriangle> triangles;
      for (std::ptrdiff_t b = begin; b < end; ++b)
      {
        this->Sums[b] = this->weigh(b, triangles);
      }
    });
  std::partial_sum(this->Sums.begin(), this->Sums.end(), this->Sums.begin());
}

/// The triangles of a box with the numbers of particles that they want. They are taken to the tangent
/// plane of the sample, by the map there; above a place t of it the sample's patch has sqrt(1 + |S t|^2)
/// times the area.
/// \return the sum of the numbers
double SurfaceProxy::weigh(std::size_t which, std::vector<WeighedTriangle>& weighed) const
{
  weighed.clear();
  const Sample& sample = this->Samples[which];
  if (!sample.found)
  {
    return 0.0;
  }
  const SurfaceBox& box = this->Boxes[which];
  std::vector<ReferenceTriangle> triangles;
  appendProxyTriangles(this->Surface.mesh->elements[box.middle.element].domain, box, triangles);
  const glm::dmat3 push = glm::inverse(glm::dmat3(sample.anchor.pull));
  double sum = 0.0;
  const Patch& patch = sample.patch;
  const auto tangents = tangentsOf(patch.normal);
  // Corners lie off the patch where it bends, by the square of the box's size: they are taken to it along
  // its normal there, which is (S t, 1).
  const auto onPatch = [&](const glm::vec3& corner)
  {
    const glm::dvec3 d = push * (glm::dvec3(corner) - sample.anchor.place.u.xyz);
    const glm::dvec2 t(glm::dot(d, glm::dvec3(tangents[0])), glm::dot(d, glm::dvec3(tangents[1])));
    const double off = glm::dot(d, glm::dvec3(patch.normal)) - sample.anchor.offset + patch.sink(t);
    const double farthest = largestShift / patch.curvatureMagnitude();
    return t - std::clamp(off, -farthest, farthest) * patch.slope(t);
  };
  for (const ReferenceTriangle& t : triangles)
  {
    const glm::dvec2 a = onPatch(t[0]);
    const glm::dvec2 b = onPatch(t[1]);
    const glm::dvec2 c = onPatch(t[2]);
    const glm::dvec2 middle = (a + b + c) / 3.0;
    const glm::dvec2 slope = patch.slope(middle);
    const double stretch = std::min(largestStretch, std::sqrt(1.0 + glm::dot(slope, slope)));
    const double footprint = 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    const glm::dvec3 position = patch.position + patch.step(glm::vec2(middle));
    const double h = this->spacingAt(position, patch.curvatureMagnitude());
    weighed.push_back({ t, stretch * footprint * 2.0 / (std::sqrt(3.0) * h * h) });
    sum += weighed.back().weight;
  }
  return sum;
}

/// The seeds first to last - 1 in the triangles of a box, at the sums of weights that are theirs.
void SurfaceProxy::seedBox(std::size_t box, std::int64_t first, std::int64_t last, double phase,
  double stride, std::vector<Seed>& seeds) const
{
  constexpr double goldenRatio = 0.61803398874989485;
  if (last - first == 1)
  {
    seeds[first] = { this->Samples[box].anchor.place, static_cast<int>(box) };
    return;
  }
  std::vector<WeighedTriangle> triangles;
  double sum = this->Sums[box] - this->weigh(box, triangles);
  std::size_t t = 0;
  for (std::int64_t k = first; k < last; ++k)
  {
    const double wanted = (static_cast<double>(k) + phase) * stride;
    while (t + 1 < triangles.size() && wanted >= sum + triangles[t].weight)
    {
      sum += triangles[t++].weight;
    }
    // (root, across) to barycentric coordinates keeps equal areas equal.
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
  // The first seed whose sum is not below a given one.
  const auto firstFrom = [&](double sum)
  { return std::clamp<std::int64_t>(std::llround(std::ceil(sum / stride - phase)), 0, count); };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Boxes.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t b = begin; b < end; ++b)
      {
        const std::int64_t first = b > 0 ? firstFrom(this->Sums[b - 1]) : 0;
        const bool isLast = this->Sums[b] == this->Sums.back();
        const std::int64_t last = isLast ? count : firstFrom(this->Sums[b]);
        if (first < last && (b == 0 || this->Sums[b] > this->Sums[b - 1]))
        {
          this->seedBox(b, first, last, phase, stride, seeds);
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
  if (distance > guessReach * sample.patch.spacing ||
    distance * sample.patch.curvatureMagnitude() > guessTurn)
  {
    return false;
  }
  patch.spacing = this->spacingAt(patch.position, patch.curvatureMagnitude());
  return true;
}

} // namespace hop
