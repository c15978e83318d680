#include "Fast/FastSystem.h"

#include "Edges/CurveSegments.h"
#include "Support/KeepMarked.h"
#include "Surface/SpacingSearch.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// Relative error of a given number up to which all spacings are scaled instead of isolating the surface anew: the boxes
/// are those of a spacing that is off by half of the error, and the angular density is off by as much. Chosen by
/// experiment. Larger: it is farther off; smaller: the surface is isolated more often.
constexpr double nearlyTheNumber = 0.3;

/// The proxy that guesses the spacing which goes with a given number, before the surface is isolated for it. Chosen by
/// experiment; they change what the guess costs, and how near it comes.
struct RoughProxy
{
  /// Area that the surface is taken to have before anything is known of it, in units of the squared diagonal of the
  /// mesh: a plane across it has about half of that.
  static constexpr double Area = 0.4;
  /// Width of its boxes in units of the usual one. Smaller: areas are more exact, and take more time.
  static constexpr double Width = 2.5;
  /// Least spacing, as a share of the diagonals of all boxes in a row over the number of particles: surfaces of no area,
  /// in flat cells, have boundary curves all the same. Chosen so that it does not matter elsewhere: a surface through n
  /// boxes of the size w with N > n particles has spacings of about w sqrt(n/N), above w n/N.
  static constexpr double LengthShare = 0.1;
  /// Largest spacing for which its boxes are kept, in units of the one that they are made for, where elements as small as
  /// boxes make them finer than the guess. Larger: more boxes than are needed; smaller: the surface is isolated twice.
  static constexpr double Kept = 2.0;
};

} // namespace

/// Number of particles that the surface takes at the sizing function.
double FastSystem::targetCount() const
{
  return this->Proxy->particleCount() + this->BoundaryCount;
}

/// Finds the spacing that goes with a given number of particles: first on a rough proxy, then on the surface itself. What
/// is missing to the number then is settled by scaling all spacings. A spacing is no larger than the mesh: beyond that
/// only boxes and corners count, which stay as many.
void FastSystem::matchSpacing(std::int64_t count)
{
  const auto given = static_cast<double>(count);
  findSpacing(
    count, this->guessSpacing(given),
    [this](double spacing)
    {
      this->Sizing.spacing = spacing;
      this->prepareSurface();
      return this->targetCount();
    },
    nearlyTheNumber, meshExtent(this->Mesh));
  const double inside = this->Proxy->particleCount();
  const double onBoundary = this->targetCount() - inside;
  const double error = this->targetCount() / given - 1.0;
  if (std::abs(error) > SpacingSearch::Tolerance && std::abs(error) < nearlyTheNumber)
  {
    // Spacings f times as large take inside/f^2 + onBoundary/f particles: the positive root of given f^2 - onBoundary f -
    // inside. It is near 1, as both numbers together are near the one that is given.
    const double factor =
      (onBoundary + std::sqrt(onBoundary * onBoundary + 4.0 * given * inside)) / (2.0 * given);
    this->Proxy->scaleSpacings(factor);
    this->Sizing.spacing *= factor;
    this->traceBoundaryCurves();
    this->Evaluations += this->Curves.evaluations;
  }
  if (this->placesOnCurves() > count)
  {
    this->CreasesFit = false;
    this->findJumps();
    this->traceBoundaryCurves();
  }
  this->keepOnBoundary(static_cast<std::size_t>(count));
}

/// About the spacing that goes with a number of particles, by a proxy whose boxes are wide.
double FastSystem::guessSpacing(double count)
{
  this->Sizing.spacing = meshExtent(this->Mesh) * std::sqrt(RoughProxy::Area / count);
  SizingFunction wide = this->Sizing;
  wide.spacing *= RoughProxy::Width;
  const SurfaceProxy proxy = this->proxyOfBoxesAt(wide, ProgressAt::Estimated);
  double length = 0.0;
  for (const SurfaceBox& box : proxy.boxes())
  {
    length += box.size;
  }
  const double spacing =
    std::max(proxy.spacingFor(count), RoughProxy::LengthShare * length / count);
  if (spacing < RoughProxy::Kept * wide.spacing)
  {
    this->RoughBoxes = proxy.boxes();
  }
  return spacing;
}

/// Thins out the particles on boundary curves where they are more than a given number: their corners stay at any
/// spacing.
void FastSystem::keepOnBoundary(std::size_t most)
{
  const std::size_t count = this->BoundaryPatches.size();
  if (this->placesOnCurves() <= static_cast<std::int64_t>(most))
  {
    return;
  }
  const std::size_t left = std::min(count, most);
  std::vector<char> kept(count, 0);
  for (std::size_t n = 0; n < left; ++n)
  {
    kept[n * count / left] = 1;
  }
  keepMarked(this->Curves.particles, kept);
  keepMarked(this->BoundaryPatches, kept);
  this->BoundaryCount = OnBoundary::Count * static_cast<double>(left);
  if (left < count)
  {
    this->Curves.edges.segments = withoutDropped(this->Curves.edges.segments, kept);
  }
}

/// Number of places with particles on boundary curves and creases. On creases several particles are in one.
std::int64_t FastSystem::placesOnCurves() const
{
  const std::vector<int> first = firstInPlace(this->Curves.edges, this->Curves.particles.size());
  std::int64_t places = 0;
  for (std::size_t n = 0; n < first.size(); ++n)
  {
    places += first[n] == static_cast<int>(n);
  }
  return places;
}

/// Number of particles that the relaxation sees when there are as many places as particles are asked for.
std::int64_t FastSystem::sizeForGivenNumber() const
{
  return this->Parameters.particleCount + static_cast<std::int64_t>(this->BoundaryPatches.size()) -
    this->placesOnCurves();
}

} // namespace hop
