#include "Edges/CreaseCorners.h"

#include "Edges/FaceJumps.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

/// Splats end so far from their particles, in units of their spacing: a little farther off they count too little
/// to be seen alone, and they may be bent.
constexpr double splatReach = 0.91;
static_assert(2.0 * splatReach <= ParticleGrid::Reach);
/// A little behind a crease's plane a splat still fills gaps; also that is in units of the spacing.
constexpr double filledBehind = 0.05;
/// Distance of the places looked at, along the crease and away from it, in units of the spacing.
constexpr double placeStep = 0.1;
/// 80 degrees.
constexpr double sharpestCrease = 1.4;
/// A splat stands off that far at most from what it covers behind a crease, in units of its spacing.
constexpr double farthestOff = 0.25;

bool isCrease(const ClipPlane& plane)
{
  return plane.exists() && plane.dihedralAngle > CreaseAngle &&
    plane.dihedralAngle < sharpestCrease;
}

bool cuts(const ClipPlane& plane)
{
  return plane.exists() && plane.dihedralAngle > CreaseAngle;
}

/// Unit vector along the edge that a plane touches, either way: the same from both sides of it.
glm::dvec3 alongEdge(const Particle& particle, const ClipPlane& plane)
{
  return glm::normalize(glm::cross(particle.normal.xyz, plane.normal.xyz));
}

/// Whether a splat, were it whole, would reach a place on the surface nearby.
bool reaches(const Particle& particle, const glm::dvec3& place)
{
  constexpr double highest = 0.4;
  const glm::dvec3 offset = place - particle.position.xyz;
  const double height = glm::dot(offset, particle.normal.xyz);
  const double h = particle.spacing;
  return std::abs(height) < highest * h &&
    glm::dot(offset, offset) - height * height < splatReach * splatReach * h * h;
}

/// How far a place lies behind a particle's planes; infinitely where no crease may give way.
double behindCreases(const Particle& particle, const glm::dvec3& place)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double farthest = -infinity;
  for (const ClipPlane& plane : particle.clips)
  {
    if (cuts(plane))
    {
      const double behind =
        glm::dot(place - particle.position.xyz, plane.normal.xyz) - plane.distance;
      farthest = std::max(farthest, behind > 0.0 && !isCrease(plane) ? infinity : behind);
    }
  }
  return farthest;
}

/// Whether a place lies behind a boundary curve, clearly.
bool isBehindBoundary(const Particle& particle, const glm::dvec3& place)
{
  return std::any_of(particle.clips.begin(), particle.clips.end(),
    [&](const ClipPlane& plane)
    {
      return plane.isBoundary() &&
        glm::dot(place - particle.position.xyz, plane.normal.xyz) >
        plane.distance + filledBehind * particle.spacing;
    });
}

class CreaseCorners
{
public:
  CreaseCorners(const ParticleGrid& all, const ParallelFor& parallelFor)
    : All(all)
    , Parallel(parallelFor)
  {
  }

  void close();

private:
  /// A plane's way along the disk of its particle.
  struct Cut
  {
    /// The place on the plane that is nearest to the particle, from there.
    glm::dvec3 foot{ 0.0 };
    /// Unit vectors.
    glm::dvec3 away{ 0.0 };
    glm::dvec3 along{ 0.0 };
    /// Of `away` to the plane's normal.
    double cosine = 0.0;
  };

  static Cut cutOf(const Particle& particle, const ClipPlane& plane);
  bool isCornerOf(int i, int plane, const std::vector<int>& around) const;
  std::vector<int> findAround(int i) const;
  bool isOpen(int i, const glm::dvec3& place, const std::vector<int>& around) const;
  double openBehind(int i, int plane, const std::vector<int>& around) const;
  double openFrom(int i, int plane, const glm::dvec3& start, const glm::dvec3& away,
    const std::vector<int>& around) const;

  const ParticleGrid& All;
  const ParallelFor& Parallel;
};

CreaseCorners::Cut CreaseCorners::cutOf(const Particle& particle, const ClipPlane& plane)
{
  const glm::dvec3& normal = particle.normal.xyz;
  const glm::dvec3 aslant = plane.normal.xyz - glm::dot(plane.normal.xyz, normal) * normal;
  const double cosine = glm::length(aslant);
  const glm::dvec3 away = aslant / cosine;
  return { plane.distance / cosine * away, away, glm::cross(normal, away), cosine };
}

/// Particles whose splats may overlap that of particle i.
std::vector<int> CreaseCorners::findAround(int i) const
{
  const Particle& particle = this->All.at(i);
  std::vector<int> found;
  this->All.visit(particle.position.xyz, particle.spacing,
    [&](int j)
    {
      const Particle& other = this->All.at(j);
      if (j != i && dot(other.normal, particle.normal) > 0.0 &&
        length(other.position - particle.position) <
          splatReach * (particle.spacing + other.spacing))
      {
        found.push_back(j);
      }
    });
  return found;
}

/// Whether a crease meets another one, or a boundary curve, near its particle.
bool CreaseCorners::isCornerOf(int i, int plane, const std::vector<int>& around) const
{
  constexpr double sameCrease = 0.9;
  const glm::dvec3 along = alongEdge(this->All.at(i), this->All.at(i).clips[plane]);
  const auto hasAnother = [&](int j)
  {
    const Particle& other = this->All.at(j);
    return std::any_of(other.clips.begin(), other.clips.end(),
      [&](const ClipPlane& clip)
      { return cuts(clip) && std::abs(glm::dot(alongEdge(other, clip), along)) < sameCrease; });
  };
  return hasAnother(i) || std::any_of(around.begin(), around.end(), hasAnother);
}

/// Whether it is on particle i to cover a place behind its plane: none covers it, nor lies it nearer behind the
/// plane of another, nor beyond a boundary curve.
bool CreaseCorners::isOpen(int i, const glm::dvec3& place, const std::vector<int>& around) const
{
  const double own = behindCreases(this->All.at(i), place);
  return std::none_of(around.begin(), around.end(),
    [&](int j)
    {
      const Particle& other = this->All.at(j);
      if (!reaches(other, place))
      {
        return false;
      }
      const double behind = behindCreases(other, place);
      return behind < filledBehind * other.spacing || behind < own || (behind == own && j < i) ||
        isBehindBoundary(other, place);
    });
}

/// How far it is open, away from a place on a plane.
double CreaseCorners::openFrom(int i, int plane, const glm::dvec3& start, const glm::dvec3& away,
  const std::vector<int>& around) const
{
  const Particle& particle = this->All.at(i);
  const ClipPlane& other = particle.clips[1 - plane];
  const double step = placeStep * particle.spacing;
  const double farthest = farthestOff / std::sin(particle.clips[plane].dihedralAngle);
  int count = 0;
  for (;; ++count)
  {
    const glm::dvec3 offset = start + (count + 1) * step * away;
    const glm::dvec3 place = particle.position.xyz + offset;
    if (!(glm::length(offset) <= splatReach * particle.spacing) ||
      (count + 1) * placeStep > farthest ||
      (cuts(other) && glm::dot(offset, other.normal.xyz) > other.distance) ||
      !this->isOpen(i, place, around))
    {
      return count == 0 ? 0.0 : (count + 0.5) * step;
    }
  }
}

/// How far one of its planes is to be moved.
double CreaseCorners::openBehind(int i, int plane, const std::vector<int>& around) const
{
  if (!this->isCornerOf(i, plane, around))
  {
    return 0.0;
  }
  const Particle& particle = this->All.at(i);
  const Cut cut = cutOf(particle, particle.clips[plane]);
  const double reach = splatReach * particle.spacing;
  const double half = std::sqrt(std::max(0.0, reach * reach - glm::dot(cut.foot, cut.foot)));
  const double step = placeStep * particle.spacing;
  const auto most = static_cast<int>(half / step);
  double farthest = 0.0;
  for (int n = -most; n <= most; ++n)
  {
    farthest = std::max(
      farthest, this->openFrom(i, plane, cut.foot + n * step * cut.along, cut.away, around));
  }
  return farthest * cut.cosine;
}

void CreaseCorners::close()
{
  const std::size_t count = this->All.size();
  std::vector<std::array<double, 2>> moves(count);
  forAll(this->Parallel, count,
    [&](std::size_t n)
    {
      const auto i = static_cast<int>(n);
      const auto isCut = [&](const ClipPlane& plane)
      { return isCrease(plane) && plane.distance < splatReach * this->All.at(i).spacing; };
      const auto& clips = this->All.at(i).clips;
      const std::array<bool, 2> wanted{ isCut(clips[0]), isCut(clips[1]) };
      if (wanted[0] || wanted[1])
      {
        const std::vector<int> around = this->findAround(i);
        moves[n] = { wanted[0] ? this->openBehind(i, 0, around) : 0.0,
          wanted[1] ? this->openBehind(i, 1, around) : 0.0 };
      }
    });
  for (std::size_t i = 0; i < count; ++i)
  {
    this->All.at(i).clips[0].distance += moves[i][0];
    this->All.at(i).clips[1].distance += moves[i][1];
  }
}

} // namespace

void closeCreaseCorners(const ParticleGrid& all, const ParallelFor& parallelFor)
{
  std::atomic<bool> hasCreases{ false };
  forAll(parallelFor, all.size(),
    [&](std::size_t i)
    {
      if (isCrease(all.at(i).clips[0]) || isCrease(all.at(i).clips[1]))
      {
        hasCreases = true;
      }
    });
  if (hasCreases)
  {
    CreaseCorners(all, parallelFor).close();
  }
}

} // namespace hop
