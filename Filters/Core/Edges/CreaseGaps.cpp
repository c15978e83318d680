#include "Edges/CreaseGaps.h"

#include "Common/SplatProfile.h"
#include "Edges/FaceJumps.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace hop
{
namespace
{

/// What a splat covers at a crease: lengths in units of its particle's spacing. Chosen by experiment.
struct Cover
{
  /// Share of a splat's reach up to which it surely covers the surface: a margin, as splats may be bent. A larger one
  /// leaves holes, a smaller one moves planes in vain.
  static constexpr double SureShare = 0.98;
  /// Distance behind the plane of a crease up to which a splat still fills gaps.
  static constexpr double BehindPlane = 0.05;
  /// The same behind a plane at which the surface is almost smooth, along the splat: what the renderer fills, less a
  /// margin, as splats may be bent. A larger one leaves holes, a smaller one moves planes in vain.
  static constexpr double BehindSmoothPlane = SplatOverlap::Smooth - 0.1;
  /// Largest distance of a place that a splat covers from the plane of the splat.
  static constexpr double Height = 0.4;
  /// Largest distance from what it covers behind a crease at which a splat stands off: more is seen beside the crease.
  static constexpr double StandOff = 0.25;
  /// Distance aside, and above or below, up to which a particle tells where the surface is behind a crease. With larger
  /// ones bent surfaces and other sheets are taken for a step, with smaller ones steps are overlooked.
  static constexpr double Beside = 0.5;
  static constexpr double Above = 1.0;
};

/// Distance from its particle up to which a splat covers the surface, in units of the spacing.
const double coverReach = Cover::SureShare * splatReach();

/// Distance of the places looked at, along the crease and away from it, in units of the spacing. Chosen by experiment:
/// smaller gaps may be overlooked; a smaller one costs time.
constexpr double placeStep = 0.1;

/// Dihedral angle of the sharpest crease whose planes may be moved, radians: 80 degrees. Behind a sharper one a splat
/// stands off at once.
constexpr double sharpestCrease = 1.4;

/// Largest cosine between the directions of two creases that count as different: 26 degrees. Chosen by experiment:
/// nearer to 1 bent creases are taken for corners.
constexpr double sameCrease = 0.9;

/// Smallest distance between two creases that are parallel, in units of the spacing. Of nearer ones the sliver in between
/// is covered by the overlaps of its sides; with a smaller distance one crease is taken for two where it bends.
constexpr double leastSliver = 0.1;

/// Whether splats are cut off at a plane, or a little behind it.
bool cuts(const ClipPlane& plane)
{
  return plane.exists() && !plane.isOpen();
}

/// Whether a plane is that of a crease, or of a face at which the surface is almost smooth, and may be moved.
bool mayMove(const ClipPlane& plane)
{
  return cuts(plane) && plane.dihedralAngle < sharpestCrease;
}

bool isAlmostSmooth(const ClipPlane& plane)
{
  return cuts(plane) && plane.dihedralAngle <= CreaseAngle;
}

/// Cosine of the angle between a plane's normal and the disk of its particle.
double aslantOf(const Particle& particle, const ClipPlane& plane)
{
  const double cosine = dot(plane.normal, particle.normal);
  return std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

/// How far behind a plane at which the surface is almost smooth a splat fills gaps, along the splat; 0 at other planes.
/// World units.
double filledAlong(const Particle& particle, const ClipPlane& plane)
{
  return isAlmostSmooth(plane) ? Cover::BehindSmoothPlane * particle.spacing : 0.0;
}

/// How far a place lies behind what a splat fills behind a plane, across the plane, world units; negative before it.
/// \param filledAtCreases how far it fills gaps behind creases
double beyondFilled(
  const Particle& particle, const ClipPlane& plane, const glm::dvec3& place, double filledAtCreases)
{
  const double filled = isAlmostSmooth(plane)
    ? filledAlong(particle, plane) * aslantOf(particle, plane)
    : (mayMove(plane) ? filledAtCreases : 0.0);
  return glm::dot(place - particle.position.xyz, plane.normal.xyz) - plane.distance - filled;
}

/// How far around a place on the surface nearby a splat would reach everything, were it whole; world units. Negative if
/// it does not reach the place.
double reachAround(const Particle& particle, const glm::dvec3& place)
{
  const glm::dvec3 offset = place - particle.position.xyz;
  const double height = glm::dot(offset, particle.normal.xyz);
  const double aside = std::sqrt(std::max(glm::dot(offset, offset) - height * height, 0.0));
  return std::min(
    Cover::Height * particle.spacing - std::abs(height), coverReach * particle.spacing - aside);
}

/// Whether a place is above or below the surface around a particle: farther than splats may stand off.
bool isAStepOff(const Particle& particle, const glm::dvec3& place)
{
  const glm::dvec3 offset = place - particle.position.xyz;
  const double height = std::abs(glm::dot(offset, particle.normal.xyz)) / particle.spacing;
  const double square = glm::dot(offset, offset) / (particle.spacing * particle.spacing);
  return height > Cover::StandOff && height < Cover::Above &&
    square - height * height < Cover::Beside * Cover::Beside;
}

/// How readily a particle's splat goes on to a place, the smaller the better: whether the place lies behind a crease, and
/// how far it lies behind the farthest plane, or behind what is filled there where the surface is almost smooth, world
/// units; infinite if it lies behind a plane that may not be moved.
std::pair<bool, double> behindPlanes(const Particle& particle, const glm::dvec3& place)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::pair<bool, double> result{ false, -infinity };
  for (const ClipPlane& plane : particle.clips)
  {
    if (cuts(plane))
    {
      const double behind = beyondFilled(particle, plane, place, 0.0);
      const bool isBehind = behind > 0.0;
      result.first = result.first || (isBehind && !isAlmostSmooth(plane));
      result.second = std::max(result.second, isBehind && !mayMove(plane) ? infinity : behind);
    }
  }
  return result;
}

/// How far around a place a splat is not cut off, world units; a little is filled behind planes. Negative if the place
/// is cut off itself.
double uncutAround(const Particle& particle, const glm::dvec3& place)
{
  double least = std::numeric_limits<double>::infinity();
  for (const ClipPlane& plane : particle.clips)
  {
    if (cuts(plane))
    {
      const double filled = Cover::BehindPlane * particle.spacing;
      least = std::min(least, -beyondFilled(particle, plane, place, filled));
    }
  }
  return least;
}

/// Whether a place lies clearly behind a boundary curve.
bool isBehindBoundary(const Particle& particle, const glm::dvec3& place)
{
  return std::any_of(particle.clips.begin(), particle.clips.end(),
    [&](const ClipPlane& plane)
    {
      return plane.isBoundary() &&
        glm::dot(place - particle.position.xyz, plane.normal.xyz) >
        plane.distance + Cover::BehindPlane * particle.spacing;
    });
}

class CreaseGaps
{
public:
  CreaseGaps(const ParticleGrid& all, const ParallelFor& parallelFor)
    : All(all)
    , Parallel(parallelFor)
  {
  }

  void close();

private:
  /// The line in which a plane cuts the disk of its particle.
  struct Cut
  {
    /// From the particle to the nearest place of the line.
    glm::dvec3 foot{ 0.0 };
    /// Unit vectors of the disk, across the line and along it.
    glm::dvec3 away{ 0.0 };
    glm::dvec3 along{ 0.0 };
    /// Cosine of the angle between `away` and the plane's normal.
    double cosine = 0.0;
  };

  static Cut cutOf(const Particle& particle, const ClipPlane& plane);
  bool hasAnotherNear(int i, int plane, const std::vector<int>& around) const;
  std::vector<int> findAround(int i) const;
  double coveredAround(int i, const glm::dvec3& place, std::vector<int>& around) const;
  bool isBehindAStep(const glm::dvec3& place, const std::vector<int>& around) const;
  double openBehind(int i, int plane, std::vector<int>& around) const;
  double openFrom(int i, int plane, const glm::dvec3& start, const glm::dvec3& away,
    std::vector<int>& around) const;

  const ParticleGrid& All;
  const ParallelFor& Parallel;
};

CreaseGaps::Cut CreaseGaps::cutOf(const Particle& particle, const ClipPlane& plane)
{
  const glm::dvec3& normal = particle.normal.xyz;
  const glm::dvec3 aslant = plane.normal.xyz - glm::dot(plane.normal.xyz, normal) * normal;
  const double cosine = glm::length(aslant);
  const glm::dvec3 away = aslant / cosine;
  return { plane.distance / cosine * away, away, glm::cross(normal, away), cosine };
}

/// Particles whose splats may overlap the splat of particle i.
std::vector<int> CreaseGaps::findAround(int i) const
{
  const Particle& particle = this->All.at(i);
  std::vector<int> found;
  this->All.visit(particle.position.xyz, particle.spacing,
    [&](int j)
    {
      const Particle& other = this->All.at(j);
      if (j != i && dot(other.normal, particle.normal) > 0.0 &&
        length(other.position - particle.position) <
          coverReach * (particle.spacing + other.spacing))
      {
        found.push_back(j);
      }
    });
  return found;
}

/// Whether a crease, or a face at which the surface is almost smooth, is beside another one, or a boundary curve, or meets
/// it, near particle i. Along a single one gaps are smaller than what a plane that is moved over it draws with the wrong
/// brightness.
/// \param plane of the crease: its number
bool CreaseGaps::hasAnotherNear(int i, int plane, const std::vector<int>& around) const
{
  const Particle& particle = this->All.at(i);
  const ClipPlane& crease = particle.clips[plane];
  const Cut cut = cutOf(particle, crease);
  const auto isAnother = [&](const Particle& other, const ClipPlane& clip)
  {
    if (!cuts(clip))
    {
      return false;
    }
    const Cut there = cutOf(other, clip);
    const glm::dvec3 offset = other.position.xyz + there.foot - particle.position.xyz - cut.foot;
    const double along = glm::dot(offset, cut.along);
    const double beside = glm::dot(offset, cut.away) - 0.5 * crease.edgeCurvature * along * along;
    return std::abs(glm::dot(there.along, cut.along)) < sameCrease ||
      std::abs(beside) > leastSliver * particle.spacing;
  };
  const auto hasAnother = [&](int j)
  {
    const Particle& other = this->All.at(j);
    return std::any_of(other.clips.begin(), other.clips.end(),
      [&](const ClipPlane& clip) { return &clip != &crease && isAnother(other, clip); });
  };
  return hasAnother(i) || std::any_of(around.begin(), around.end(), hasAnother);
}

/// How far around a place behind its plane particle i has nothing to cover, world units: another splat covers it all.
/// Zero if the place alone is none of its own: another plane is nearer to it, or it lies beyond a boundary curve.
/// Negative if particle i is to cover it.
/// \param around in any order; one that says no comes first afterwards, as it mostly says so of the next place, too
double CreaseGaps::coveredAround(int i, const glm::dvec3& place, std::vector<int>& around) const
{
  const auto own = behindPlanes(this->All.at(i), place);
  for (int& j : around)
  {
    const Particle& other = this->All.at(j);
    const double reach = reachAround(other, place);
    if (reach <= 0.0)
    {
      continue;
    }
    const double uncut = uncutAround(other, place);
    const auto behind = behindPlanes(other, place);
    if (uncut >= 0.0 || behind < own || (behind == own && j < i) || isBehindBoundary(other, place))
    {
      std::swap(j, around.front());
      return std::max(0.0, std::min(reach, uncut));
    }
  }
  return -1.0;
}

/// Whether the surface is a step higher or lower at a place behind a crease, as where the field jumps as well: a splat
/// that went on to the place would hide it, or hide the gap.
bool CreaseGaps::isBehindAStep(const glm::dvec3& place, const std::vector<int>& around) const
{
  return std::any_of(
    around.begin(), around.end(), [&](int j) { return isAStepOff(this->All.at(j), place); });
}

/// How far a plane leaves the surface open behind one place of its cut, world units. What lies right behind may be
/// covered, and be open farther off.
/// \param start from the particle to that place
double CreaseGaps::openFrom(
  int i, int plane, const glm::dvec3& start, const glm::dvec3& away, std::vector<int>& around) const
{
  const Particle& particle = this->All.at(i);
  const auto isBeyondOther = [&](const glm::dvec3& offset)
  {
    return std::any_of(particle.clips.begin(), particle.clips.end(),
      [&](const ClipPlane& other)
      {
        return &other != &particle.clips[plane] && cuts(other) &&
          beyondFilled(particle, other, particle.position.xyz + offset, 0.0) > 0.0;
      });
  };
  const double step = placeStep * particle.spacing;
  const double farthest = Cover::StandOff / std::sin(particle.clips[plane].dihedralAngle);
  const auto offsetTo = [&](int count) { return start + count * step * away; };
  double open = 0.0;
  int withoutStep =
    0; // places up to this one have no step behind them; looked at where one is open
  for (int count = 1; count * placeStep <= farthest; ++count)
  {
    const glm::dvec3 offset = offsetTo(count);
    if (!(glm::length(offset) <= coverReach * particle.spacing) || isBeyondOther(offset))
    {
      break;
    }
    const double covered = this->coveredAround(i, particle.position.xyz + offset, around);
    if (covered >= 0.0)
    {
      count += static_cast<int>(covered / step);
      continue;
    }
    for (; withoutStep < count; ++withoutStep)
    {
      if (this->isBehindAStep(particle.position.xyz + offsetTo(withoutStep + 1), around))
      {
        return open;
      }
    }
    open = (count + 0.5) * step;
  }
  return open;
}

/// How far a plane of particle i is to be moved, world units: as far as it leaves the surface open anywhere.
double CreaseGaps::openBehind(int i, int plane, std::vector<int>& around) const
{
  if (!this->hasAnotherNear(i, plane, around))
  {
    return 0.0;
  }
  const Particle& particle = this->All.at(i);
  const Cut cut = cutOf(particle, particle.clips[plane]);
  const double reach = coverReach * particle.spacing;
  const double half = std::sqrt(std::max(0.0, reach * reach - glm::dot(cut.foot, cut.foot)));
  const double step = placeStep * particle.spacing;
  const auto most = static_cast<int>(half / step);
  const glm::dvec3 first = cut.foot + filledAlong(particle, particle.clips[plane]) * cut.away;
  double farthest = 0.0;
  for (int n = -most; n <= most; ++n)
  {
    farthest =
      std::max(farthest, this->openFrom(i, plane, first + n * step * cut.along, cut.away, around));
  }
  return farthest * cut.cosine;
}

/// Moves all planes, each by what the planes were before.
void CreaseGaps::close()
{
  const std::size_t count = this->All.size();
  constexpr std::size_t planes = std::tuple_size_v<decltype(Particle::clips)>;
  std::vector<std::array<double, planes>> moves(count);
  forAll(this->Parallel, count,
    [&](std::size_t n)
    {
      const auto i = static_cast<int>(n);
      const auto isCut = [&](const ClipPlane& plane)
      { return mayMove(plane) && plane.distance < coverReach * this->All.at(i).spacing; };
      const auto& clips = this->All.at(i).clips;
      if (std::none_of(clips.begin(), clips.end(), isCut))
      {
        return;
      }
      std::vector<int> around = this->findAround(i);
      for (std::size_t plane = 0; plane < planes; ++plane)
      {
        moves[n][plane] =
          isCut(clips[plane]) ? this->openBehind(i, static_cast<int>(plane), around) : 0.0;
      }
    });
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t plane = 0; plane < planes; ++plane)
    {
      this->All.at(i).clips[plane].distance += moves[i][plane];
    }
  }
}

} // namespace

void closeCreaseGaps(const ParticleGrid& all, const ParallelFor& parallelFor)
{
  std::atomic<bool> hasCreases{ false };
  forAll(parallelFor, all.size(),
    [&](std::size_t i)
    {
      const auto& clips = all.at(i).clips;
      if (std::any_of(clips.begin(), clips.end(), mayMove))
      {
        hasCreases = true;
      }
    });
  if (hasCreases)
  {
    CreaseGaps(all, parallelFor).close();
  }
}

} // namespace hop
