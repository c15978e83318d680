#include "Edges/ClipPlanes.h"

#include "Edges/CreaseCorners.h"
#include "Edges/FacePlanes.h"
#include "Support/SpacingGrid.h"

#include <algorithm>
#include <atomic>

namespace hop
{
namespace
{

/// Of particles that lie farther beyond a boundary curve's plane than this, in units of their spacing, it is no boundary curve: they
/// are those of the other side of a jump. Bent boundary curves leave their planes by less.
constexpr double sameSide = 0.2;

/// The boundary curve, known at one of its particles, as another particle sees it: the plane touches it where it is nearest,
/// but no farther off than where it has turned by half a radian: behind that it may run anywhere.
/// \pre the boundary curve is one
ClipPlane boundarySeenFrom(const BoundaryParticle& boundary, const Particle& particle)
{
  const glm::dvec3& outward = boundary.side.outward.xyz;
  const glm::dvec3 along = glm::cross(boundary.particle.normal.xyz, outward);
  const glm::dvec3 step = particle.position.xyz - boundary.particle.position.xyz;
  const double largest = 1.0 / particle.spacing; // more than that a parabola does not follow
  const double bend = std::clamp(boundary.side.bend, -largest, largest);
  const double farthest = 0.5 / std::max(std::abs(bend), 1e-3 * largest);
  const double s = std::clamp(glm::dot(step, along), -farthest, farthest);
  const glm::dvec3 normal = glm::normalize(outward - bend * s * along);
  const glm::dvec3 nearest = s * along + 0.5 * bend * s * s * outward;
  return { { normal }, glm::dot(nearest - step, normal), bend, static_cast<float>(Pi) };
}

/// Planes of the boundary curves around, each by the nearest particle on it. Another sheet's would cut off whole splats on a
/// boundary curve that lies beside it.
void offerBoundaries(
  const SpacingGrid& grid, const Buffer<BoundaryParticle>& boundaries, Particle& particle)
{
  struct Edge
  {
    int boundary = -1;
    double distance = 0.0;
  };
  std::array<Edge, 2> edges;
  const auto looksLike = [&](const Edge& edge, int j)
  {
    return edge.boundary >= 0 &&
      dot(boundaries[edge.boundary].side.outward, boundaries[j].side.outward) > SameEdge;
  };
  grid.visit(particle.position.xyz, particle.spacing,
    [&](int j)
    {
      const Edge edge{ j, length(boundaries[j].particle.position - particle.position) };
      if (edge.distance > ClipReach * particle.spacing || !boundaries[j].side.exists() ||
        dot(boundaries[j].particle.normal, particle.normal) <= SameSheet ||
        boundarySeenFrom(boundaries[j], particle).distance < -sameSide * particle.spacing)
      {
        return;
      }
      auto& [first, second] = edges;
      if (first.boundary < 0 || edge.distance < first.distance)
      {
        second = looksLike(first, j) ? second : first;
        first = edge;
      }
      else if (!looksLike(first, j) && (second.boundary < 0 || edge.distance < second.distance))
      {
        second = edge;
      }
    });
  for (const Edge& edge : edges)
  {
    if (edge.boundary >= 0)
    {
      ClipPlane plane = boundarySeenFrom(boundaries[edge.boundary], particle);
      plane.distance = std::max(0.0, plane.distance);
      offerPlane(particle, plane);
    }
  }
}

/// Whether a particle goes on with the surface of one on a boundary curve: right beyond it, and in its plane.
bool goesOnAt(const BoundaryParticle& boundary, const Particle& particle)
{
  constexpr double farthest = 1.3;
  constexpr double aside = 0.8;
  constexpr double above = 0.25;
  const glm::dvec3 step = particle.position.xyz - boundary.particle.position.xyz;
  const glm::dvec3 normal = glm::normalize(particle.normal.xyz + boundary.particle.normal.xyz);
  const double height = glm::dot(step, normal);
  const double beyond = glm::dot(step, boundary.side.outward.xyz);
  const glm::dvec3 rest = step - height * normal - beyond * boundary.side.outward.xyz;
  const double h = particle.spacing;
  return beyond > sameSide * h && beyond < farthest * h && glm::length(rest) < aside * h &&
    std::abs(height) < above * h && dot(boundary.particle.normal, particle.normal) > 0.5;
}

/// Whether two boundary curves look at each other, across a slit.
bool areFacing(const BoundaryParticle& a, const BoundaryParticle& b)
{
  return dot(a.side.outward, b.side.outward) < -0.5 &&
    dot(a.particle.normal, b.particle.normal) > 0.0 &&
    length(a.particle.position - b.particle.position) < ClipReach * a.particle.spacing;
}

/// Where a boundary curve comes to an edge of the mesh, and behind that edge the surface goes on though the elements on
/// both sides of it hold none, it is none: there is a gap far smaller than a spacing.
void openBoundariesThatGoOn(
  const SpacingGrid& grid, const ParticleGrid& all, const ParallelFor& parallelFor)
{
  Buffer<BoundaryParticle>& boundaries = all.boundaries();
  std::vector<std::atomic<char>> goesOn(boundaries.size());
  forAll(parallelFor, all.size() - boundaries.size(),
    [&](std::size_t i)
    {
      const Particle& particle = all.at(i);
      grid.visit(particle.position.xyz, particle.spacing,
        [&](int j)
        {
          if (goesOnAt(boundaries[j], particle))
          {
            goesOn[j] = 1;
          }
        });
    });
  forAll(parallelFor, boundaries.size(),
    [&](std::size_t i)
    {
      bool isSlit = false;
      grid.visit(boundaries[i].particle.position.xyz, boundaries[i].particle.spacing,
        [&](int j)
        {
          isSlit = isSlit || areFacing(boundaries[i], boundaries[j]);
          goesOn[i] = goesOn[i] || goesOnAt(boundaries[i], boundaries[j].particle);
        });
      goesOn[i] = goesOn[i] && !isSlit;
    });
  for (std::size_t i = 0; i < boundaries.size(); ++i)
  {
    if (goesOn[i])
    {
      boundaries[i].side = {};
    }
  }
}

/// Takes planes of creases away behind which nothing covers what they cut off.
class CreaseCovers
{
public:
  CreaseCovers(const Isosurface& surface, const ParticleGrid& all)
    : Surface(surface)
    , All(all)
  {
  }

  void dropOpen(Particle& particle) const
  {
    auto& [first, second] = particle.clips;
    second = this->isOpen(particle, second) ? ClipPlane{} : second;
    if (this->isOpen(particle, first))
    {
      first = second;
      second = {};
    }
  }

private:
  bool isOpen(const Particle& particle, const ClipPlane& plane) const
  {
    return plane.exists() && !plane.isBoundary() && plane.dihedralAngle > CreaseAngle &&
      !this->goesOnBehind(particle, plane);
  }

  /// Whether a particle behind the face is near enough to cover what is cut off, but for the little that splats
  /// reach beyond their planes: slivers of elements hold none.
  bool goesOnBehind(const Particle& particle, const ClipPlane& plane) const
  {
    const int element = particle.location.element;
    const int joined = this->Surface.mesh->neighbor(element, plane.face).element;
    const glm::dvec3 foot = (particle.position + plane.distance * plane.normal).xyz;
    constexpr double nearEnough = 1.1;
    const auto isBehind = [&](int other)
    {
      return joined >= 0
        ? other == joined
        : this->Surface.locator && this->Surface.locator->mayGoOnIn(element, plane.face, other);
    };
    bool found = false;
    this->All.visit(foot, particle.spacing,
      [&](int j)
      {
        found = found ||
          (glm::distance(this->All.position(j), foot) <=
              nearEnough * std::max<double>(particle.spacing, this->All.spacing(j)) &&
            isBehind(this->All.at(j).location.element));
      });
    return found;
  }

  const Isosurface& Surface;
  const ParticleGrid& All;
};

} // namespace

void markClipPlanes(
  const Isosurface& surface, const ParticleGrid& all, const ParallelFor& parallelFor)
{
  Buffer<BoundaryParticle>& boundaries = all.boundaries();
  const SpacedPoints points(
    boundaries.size(), [&](std::size_t i) { return boundaries[i].particle.position.xyz; },
    [&](std::size_t i) { return boundaries[i].patch.spacing; }, parallelFor);
  const SpacingGrid grid(points.positions, points.spacings, ClipReach, 0.5, parallelFor);
  openBoundariesThatGoOn(grid, all, parallelFor);
  const CreaseCovers covers(surface, all);
  forAll(parallelFor, all.size(),
    [&](std::size_t i)
    {
      covers.dropOpen(all.at(i));
      offerBoundaries(grid, boundaries, all.at(i));
    });
  forAll(parallelFor, boundaries.size(),
    [&](std::size_t i)
    {
      auto& [particle, patch, side, other] = boundaries[i];
      if (side.exists() && other.exists())
      {
        offerPlane(particle, { other.outward, 0.0, other.bend, static_cast<float>(Pi) });
      }
    });
  closeCreaseCorners(all, parallelFor);
}

} // namespace hop
