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
  /// Largest count of a piece: integers hold the sum of any number of them.
  static constexpr double MostUnits = 1e9;
  /// Size of the pieces of elements that are looked at, in units of the spacing, and how many there are along each axis
  /// at most. Smaller pieces, and more: the estimate is better, and takes longer.
  static constexpr double PieceSize = 8.0;
  static constexpr double MostPerAxis = 4.0;
};

/// Sums over all elements.
struct WorkSums
{
  /// In each part of the sweep, of all isovalues.
  std::vector<std::int64_t> ofParts;
  /// Of each isovalue.
  std::vector<std::int64_t> ofIsovalues;
};

/// What the middle of a piece of an element tells of the surfaces in the piece.
struct Piece
{
  /// F, and half the range of F, taken as linear.
  double value = 0.0;
  double halfRange = 0.0;
  /// The same along the sweep, world units.
  double place = 0.0;
  double halfExtent = 0.0;
  /// Particles, in units, of a surface that passes.
  std::int64_t count = 0;

  bool holds(double isovalue) const { return std::abs(this->value - isovalue) <= this->halfRange; }
};

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

/// Places in the middle of equal pieces of a domain, so many along each axis.
std::vector<ReferencePoint> middlesOf(Domain domain, int perAxis)
{
  std::vector<ReferencePoint> middles;
  const auto middle = [&](int i) { return (i + 0.5) / perAxis; };
  for (int i = 0; i < perAxis * perAxis * perAxis && perAxis > 1; ++i)
  {
    const ReferencePoint u{ glm::dvec3(
      middle(i % perAxis), middle(i / perAxis % perAxis), middle(i / perAxis / perAxis)) };
    if (insideMargin(domain, u) >= 0.0)
    {
      middles.push_back(u);
    }
  }
  return middles.empty() ? std::vector<ReferencePoint>{ middleOf(facts(domain)) } : middles;
}

/// \param volume of the piece in reference space
Piece pieceAt(const BernsteinForm& form, const ReferencePoint& middle, double volume,
  const glm::dvec3& direction, const SizingFunction& sizing)
{
  const Jet jet = evaluateHessian(form, middle);
  const FieldPoint point = fieldPoint(jet, 0.0);
  const double side = std::cbrt(volume);
  Piece piece;
  piece.value = point.value;
  for (int axis = 0; axis < 3; ++axis)
  {
    const glm::dvec3& column = point.map.jacobian[axis];
    piece.halfRange += 0.5 * side * std::abs(jet.first[axis].w);
    piece.halfExtent += 0.5 * side * std::abs(glm::dot(column, direction));
  }
  piece.place = glm::dot(point.map.position.xyz, direction);
  const double size = std::abs(glm::determinant(point.map.jacobian)) * volume;
  const double slope = length(point.gradient);
  if (point.map.singular || !(slope > 0.0) || !std::isfinite(slope))
  {
    return piece;
  }
  const double bend = curvature(point.gradient, worldHessian(jet, point)).magnitude;
  const double h = std::max(
    std::isfinite(bend) ? sizing.at(bend) : 0.0, Estimate::SmallestSpacing * sizing.spacing);
  const double area = 0.5 * size * slope / piece.halfRange;
  const double count = area * 2.0 / (std::sqrt(3.0) * h * h);
  piece.count = std::llround(std::min(Estimate::Units * count, Estimate::MostUnits));
  return piece;
}

std::vector<Piece> piecesOf(
  const BernsteinForm& form, const glm::dvec3& direction, const SizingFunction& sizing)
{
  const auto [first, last] = extentAlong(form, direction);
  const double wanted = (last - first) / (Estimate::PieceSize * sizing.spacing);
  const int perAxis = static_cast<int>(std::clamp(wanted, 1.0, Estimate::MostPerAxis));
  const std::vector<ReferencePoint> middles = middlesOf(form.domain, perAxis);
  const double volume = referenceVolume(form.domain) / static_cast<double>(middles.size());
  std::vector<Piece> pieces;
  pieces.reserve(middles.size());
  for (const ReferencePoint& middle : middles)
  {
    pieces.push_back(pieceAt(form, middle, volume, direction, sizing));
  }
  return pieces;
}

/// Spreads a count over the parts of the sweep between two places, in units of the parts.
void spread(std::int64_t count, double first, double last, std::vector<std::int64_t>& parts)
{
  const double most = static_cast<double>(parts.size()) - 1.0;
  const auto from = static_cast<std::size_t>(std::clamp(first, 0.0, most));
  const auto to = static_cast<std::size_t>(std::clamp(last, static_cast<double>(from), most));
  const auto number = static_cast<std::int64_t>(to - from + 1);
  for (std::size_t part = from; part <= to; ++part)
  {
    parts[part] += count / number;
  }
  parts[from] += count % number;
}

WorkSums sumOver(const std::vector<std::vector<Piece>>& pieces,
  const std::vector<double>& isovalues, const std::array<double, 2>& whole)
{
  WorkSums sums;
  sums.ofParts.resize(Estimate::Parts);
  sums.ofIsovalues.resize(isovalues.size());
  const double perPart = (whole[1] - whole[0]) / Estimate::Parts;
  for (const std::vector<Piece>& ofElement : pieces)
  {
    for (const Piece& piece : ofElement)
    {
      for (std::size_t i = 0; i < isovalues.size(); ++i)
      {
        if (piece.holds(isovalues[i]))
        {
          sums.ofIsovalues[i] += piece.count;
          const double place = (piece.place - whole[0]) / perPart;
          const double half = piece.halfExtent / perPart;
          spread(piece.count, place - half, place + half, sums.ofParts);
        }
      }
    }
  }
  return sums;
}

/// Sums as a message to other ranks.
Bytes written(const WorkSums& sums)
{
  Bytes bytes;
  for (const std::vector<std::int64_t>* some : { &sums.ofParts, &sums.ofIsovalues })
  {
    const auto* first = reinterpret_cast<const unsigned char*>(some->data());
    bytes.insert(bytes.end(), first, first + some->size() * sizeof(std::int64_t));
  }
  return bytes;
}

/// Adds what another rank has written.
void add(const Bytes& bytes, WorkSums& sums)
{
  const unsigned char* at = bytes.data();
  for (std::vector<std::int64_t>* some : { &sums.ofParts, &sums.ofIsovalues })
  {
    for (std::int64_t& sum : *some)
    {
      std::int64_t more = 0;
      std::memcpy(&more, at, sizeof(more));
      at += sizeof(more);
      sum += more;
    }
  }
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

/// What a rank knows of its own elements, along the sweep.
struct OwnWork
{
  std::array<double, 2> extent{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  std::vector<std::vector<Piece>> pieces;
};

OwnWork ownWork(
  const ElementMesh& mesh, const SizingFunction& sizing, const ParallelFor& parallelFor)
{
  OwnWork work;
  const glm::dvec3 direction = sweepDirection();
  work.pieces.resize(mesh.elements.size());
  std::vector<std::array<double, 2>> extents(mesh.elements.size());
  forAll(parallelFor, extents.size(),
    [&](std::size_t e)
    {
      const BernsteinForm form = mesh.form(static_cast<int>(e));
      extents[e] = extentAlong(form, direction);
      work.pieces[e] = piecesOf(form, direction, sizing);
    });
  for (const auto& [first, last] : extents)
  {
    work.extent = { std::min(work.extent[0], first), std::max(work.extent[1], last) };
  }
  return work;
}

/// \param particles that a worker is worth
std::vector<Slab> slabsFor(
  const WorkSums& sums, const std::array<double, 2>& whole, double spacing, double particles)
{
  const double most =
    static_cast<double>(*std::max_element(sums.ofIsovalues.begin(), sums.ofIsovalues.end()));
  const double thickness = SlabOverlap::Thickness * spacing;
  const double mostSlabs = std::max(1.0, (whole[1] - whole[0]) / thickness);
  auto count = static_cast<std::size_t>(
    std::clamp(most / (Estimate::Units * particles), 1.0, std::min(mostSlabs, 1e6)));
  std::vector<double> cuts = cutsFor(count, sums.ofParts, whole);
  while (!areThick(cuts, thickness))
  {
    cuts = cutsFor(--count, sums.ofParts, whole);
  }
  std::vector<Slab> slabs(count, Slab{ sweepDirection() });
  for (std::size_t n = 0; n < cuts.size(); ++n)
  {
    slabs[n].end = cuts[n];
    slabs[n + 1].begin = cuts[n];
  }
  return slabs;
}

} // namespace

SlabPlan planSlabs(Exchange& exchange, const ElementMesh& mine,
  const std::vector<double>& isovalues, const SizingFunction& sizing, double particles,
  const ParallelFor& parallelFor)
{
  SlabPlan plan;
  bool isSound = true;
  const auto attempt = [&](const auto& use)
  { return attemptOnAll(exchange, isSound, plan.failure, use); };
  OwnWork own;
  if (!attempt([&]() { own = ownWork(mine, sizing, parallelFor); }))
  {
    return plan;
  }
  std::array<double, 2> whole = own.extent;
  for (const auto& [first, last] : gatherFromAll(exchange, own.extent))
  {
    whole = { std::min(whole[0], first), std::max(whole[1], last) };
  }
  if (!(whole[0] < whole[1]))
  {
    plan.slabs.assign(1, Slab{ sweepDirection() });
    return plan;
  }
  WorkSums sums;
  Bytes message;
  const auto sumUp = [&]()
  {
    sums = sumOver(own.pieces, isovalues, whole);
    message = written(sums);
  };
  if (!attempt(sumUp))
  {
    return plan;
  }
  const std::vector<Bytes> messages = exchange.allGather(message);
  for (int rank = 0; rank < exchange.size(); ++rank)
  {
    if (rank != exchange.rank())
    {
      add(messages[rank], sums);
    }
  }
  if (!attempt([&]() { plan.slabs = slabsFor(sums, whole, sizing.spacing, particles); }))
  {
    plan.slabs = {};
  }
  return plan;
}

} // namespace hop
