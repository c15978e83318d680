#include "Fast/SlabPlan.h"

#include "Elements/CanonicalOrder.h"
#include "Elements/SlabElements.h"
#include "Fast/SlabDistribution.h"
#include "Surface/SurfaceGeometry.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace hop
{
namespace
{

/// How the work is estimated. Chosen by experiment.
struct Estimate
{
  /// Parts of the sweep in which it is summed up. More: cuts are finer, and more is sent.
  static constexpr int Parts = 1024;
  /// Smallest spacing, in units of the one on flat surfaces, that is believed: the middle of an element may be where the
  /// gradient vanishes. Smaller: few elements outweigh all others.
  static constexpr double SmallestSpacing = 0.3;
  /// Counts are integers, so that sums do not depend on their order: this many to a particle.
  static constexpr double Units = 64.0;
};

/// Sums over all elements.
struct WorkSums
{
  /// In each part of the sweep, of all isovalues.
  std::vector<std::int64_t> ofParts = std::vector<std::int64_t>(Estimate::Parts, 0);
  /// Of each isovalue.
  std::vector<std::int64_t> ofIsovalues;
};

/// The smallest and the largest value of an element's control points.
std::array<double, 2> valueRange(const BernsteinForm& form)
{
  std::array<double, 2> range{ controlPoint(form, 0).w, controlPoint(form, 0).w };
  const int count = static_cast<int>(coefficientCount(form.domain, form.degrees));
  for (int i = 1; i < count; ++i)
  {
    const double value = controlPoint(form, i).w;
    range = { std::min(range[0], value), std::max(range[1], value) };
  }
  return range;
}

double referenceVolume(Domain domain)
{
  switch (domain)
  {
    case Domain::Hexahedron:
      return 1.0;
    case Domain::Wedge:
      return 1.0 / 2.0;
    case Domain::Tetrahedron:
      return 1.0 / 6.0;
  }
  unknownDomain();
}

/// Number of particles, in units, that surfaces take in an element that they pass.
std::int64_t countIn(const BernsteinForm& form, double range, const SizingFunction& sizing)
{
  const ReferencePoint middle = middleOf(facts(form.domain));
  const Jet jet = evaluateHessian(form, middle);
  const FieldPoint point = fieldPoint(jet, 0.0);
  const double slope = length(point.gradient);
  if (point.map.singular || !(slope > 0.0) || !std::isfinite(slope))
  {
    return 1;
  }
  const double volume =
    std::abs(glm::determinant(point.map.jacobian)) * referenceVolume(form.domain);
  const double bend = curvature(point.gradient, worldHessian(jet, point)).magnitude;
  const double h = std::max(
    std::isfinite(bend) ? sizing.at(bend) : 0.0, Estimate::SmallestSpacing * sizing.spacing);
  const double area = volume * slope / range;
  // More than a face of a cube of the same volume, times a few, is an error of the estimate.
  constexpr double mostFaces = 4.0;
  const double most = mostFaces * std::cbrt(volume) * std::cbrt(volume);
  const double count = std::min(area, most) * 2.0 / (std::sqrt(3.0) * h * h);
  // Integers hold it on any number of elements.
  constexpr double mostUnits = 1e9;
  return 1 + std::llround(std::min(Estimate::Units * count, mostUnits));
}

/// Spreads a count over the parts of the sweep between two places, in units of the parts.
void spread(std::int64_t count, double first, double last, std::vector<std::int64_t>& parts)
{
  const int most = static_cast<int>(parts.size()) - 1;
  const int from = std::clamp(static_cast<int>(first), 0, most);
  const int to = std::clamp(static_cast<int>(last), from, most);
  const std::int64_t share = count / (to - from + 1);
  for (int part = from; part <= to; ++part)
  {
    parts[part] += share;
  }
  parts[from] += count - share * (to - from + 1);
}

WorkSums sumOver(const ElementMesh& mesh, const std::vector<double>& isovalues,
  const SizingFunction& sizing, const std::vector<std::array<double, 2>>& extents,
  const std::array<double, 2>& whole, const ParallelFor& parallelFor)
{
  const std::size_t count = mesh.elements.size();
  std::vector<std::array<double, 2>> ranges(count);
  std::vector<std::int64_t> counts(count);
  forAll(parallelFor, count,
    [&](std::size_t e)
    {
      const BernsteinForm form = mesh.form(static_cast<int>(e));
      ranges[e] = valueRange(form);
      counts[e] = countIn(form, ranges[e][1] - ranges[e][0], sizing);
    });
  WorkSums sums;
  const double perPart = (whole[1] - whole[0]) / Estimate::Parts;
  for (const double isovalue : isovalues)
  {
    std::int64_t& sum = sums.ofIsovalues.emplace_back(0);
    for (std::size_t e = 0; e < count; ++e)
    {
      if (ranges[e][0] <= isovalue && isovalue <= ranges[e][1])
      {
        sum += counts[e];
        spread(counts[e], (extents[e][0] - whole[0]) / perPart,
          (extents[e][1] - whole[0]) / perPart, sums.ofParts);
      }
    }
  }
  return sums;
}

/// Adds up the sums of all ranks.
WorkSums sumOfAll(Exchange& exchange, const WorkSums& mine)
{
  const auto sumUp = [&](const std::vector<std::int64_t>& some)
  {
    Bytes bytes(some.size() * sizeof(std::int64_t));
    std::memcpy(bytes.data(), some.data(), bytes.size());
    std::vector<std::int64_t> sum(some.size(), 0);
    for (const Bytes& theirs : exchange.allGather(bytes))
    {
      for (std::size_t i = 0; i < sum.size(); ++i)
      {
        std::int64_t value = 0;
        std::memcpy(&value, theirs.data() + i * sizeof(value), sizeof(value));
        sum[i] += value;
      }
    }
    return sum;
  };
  return { sumUp(mine.ofParts), sumUp(mine.ofIsovalues) };
}

/// Places that cut the sweep into slabs of equal work.
std::vector<double> cutsFor(
  std::size_t slabs, const std::vector<std::int64_t>& parts, const std::array<double, 2>& whole)
{
  const double perPart = (whole[1] - whole[0]) / static_cast<double>(parts.size());
  const std::int64_t all = std::accumulate(parts.begin(), parts.end(), std::int64_t(0));
  std::vector<double> cuts;
  std::size_t part = 0;
  double before = 0.0;
  for (std::size_t n = 1; n < slabs; ++n)
  {
    const double wanted =
      static_cast<double>(all) * static_cast<double>(n) / static_cast<double>(slabs);
    while (part + 1 < parts.size() && before + static_cast<double>(parts[part]) < wanted)
    {
      before += static_cast<double>(parts[part++]);
    }
    const double share = (wanted - before) / std::max(1.0, static_cast<double>(parts[part]));
    cuts.push_back(whole[0] + perPart * (static_cast<double>(part) + std::clamp(share, 0.0, 1.0)));
  }
  return cuts;
}

/// Whether slabs between cuts are thick enough.
bool areThick(const std::vector<double>& cuts, double thickness)
{
  for (std::size_t n = 1; n < cuts.size(); ++n)
  {
    if (cuts[n] - cuts[n - 1] < thickness)
    {
      return false;
    }
  }
  return true;
}

/// The box around all elements, along the sweep.
std::array<double, 2> extentOfAll(
  Exchange& exchange, const std::vector<std::array<double, 2>>& extents)
{
  std::array<double, 2> whole{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  const auto include = [&](const std::array<double, 2>& extent)
  { whole = { std::min(whole[0], extent[0]), std::max(whole[1], extent[1]) }; };
  std::for_each(extents.begin(), extents.end(), include);
  const auto all = gatherFromAll(exchange, whole);
  std::for_each(all.begin(), all.end(), include);
  return whole;
}

} // namespace

std::vector<Slab> planSlabs(Exchange& exchange, const ElementMesh& mine,
  const std::vector<double>& isovalues, const SizingFunction& sizing, double particles,
  const ParallelFor& parallelFor)
{
  const glm::dvec3 direction = sweepDirection();
  std::vector<std::array<double, 2>> extents(mine.elements.size());
  forAll(parallelFor, extents.size(),
    [&](std::size_t e) { extents[e] = extentAlong(mine.form(static_cast<int>(e)), direction); });
  const std::array<double, 2> whole = extentOfAll(exchange, extents);
  if (!(whole[0] < whole[1]))
  {
    return { { direction } };
  }
  const WorkSums sums = sumOfAll(
    exchange, sumOver(mine, isovalues, sizing, extents, whole, parallelFor));
  const double most = static_cast<double>(
    *std::max_element(sums.ofIsovalues.begin(), sums.ofIsovalues.end()));
  // Even thin slabs are no more than this.
  const double thickness = SlabOverlap::Thickness * sizing.spacing;
  const double thinnest = std::max(1.0, (whole[1] - whole[0]) / thickness);
  auto slabs = static_cast<std::size_t>(
    std::clamp(most / (Estimate::Units * particles), 1.0, std::min(thinnest, 1e6)));
  std::vector<double> cuts = cutsFor(slabs, sums.ofParts, whole);
  while (!areThick(cuts, thickness))
  {
    cuts = cutsFor(--slabs, sums.ofParts, whole);
  }
  std::vector<Slab> result(slabs, Slab{ direction });
  for (std::size_t n = 0; n < cuts.size(); ++n)
  {
    result[n].end = cuts[n];
    result[n + 1].begin = cuts[n];
  }
  return result;
}

} // namespace hop
