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

/// How a particle sees a boundary curve that another particle knows. Lengths are in units of the spacing of the
/// particle that looks. Chosen by experiment.
struct BoundarySight
{
  /// A particle that lies farther beyond a boundary curve's plane than this is on the other side of a jump, where the
  /// curve does not end its sheet. Bent curves leave their planes by less. A larger one cuts splats of the other side
  /// off, with a smaller one splats reach over bent curves.
  static constexpr double SameSide = 0.2;
  /// Largest angle, radians, by which a plane is turned to follow a bent curve: beyond it the curve may run anywhere.
  static constexpr double LargestAngle = 0.5;
  /// Largest curvature of the curve, 1/spacing, that a parabola follows.
  static constexpr double LargestCurvatureTimesSpacing = 1.0;
  /// Curves that bend less than this share of LargestCurvatureTimesSpacing are straight: it keeps a quotient finite.
  static constexpr double StraightShare = 1e-3;
};

/// Where a particle goes on with the surface that ends at another particle, as seen from that one: lengths in units of
/// the spacing. Larger ones take particles of other sheets for the same surface, smaller ones leave gaps. Chosen by
/// experiment.
struct Continuation
{
  /// Largest distance beyond the boundary curve; the smallest is BoundarySight::SameSide.
  static constexpr double Beyond = 1.3;
  /// Largest distance along the boundary curve.
  static constexpr double Aside = 0.8;
  /// Largest distance off the surface.
  static constexpr double Above = 0.25;
  /// Smallest cosine between the normals: 60 degrees.
  static constexpr double Cosine = 0.5;
};

/// The plane of a boundary curve, known at one of its particles, as another particle sees it. It touches the curve
/// where the curve is nearest, but no farther off than where it has turned by LargestAngle.
/// \pre the surface ends at the first particle
ClipPlane boundarySeenFrom(const BoundaryParticle& onBoundary, const Particle& particle)
{
  const glm::dvec3& outward = onBoundary.side.outward.xyz;
  const glm::dvec3 along = glm::cross(onBoundary.particle.normal.xyz, outward);
  const glm::dvec3 step = particle.position.xyz - onBoundary.particle.position.xyz;
  const double largest = BoundarySight::LargestCurvatureTimesSpacing / particle.spacing;
  const double bend = std::clamp(onBoundary.side.edgeCurvature, -largest, largest);
  const double farthest =
    BoundarySight::LargestAngle / std::max(std::abs(bend), BoundarySight::StraightShare * largest);
  const double s = std::clamp(glm::dot(step, along), -farthest, farthest);
  const glm::dvec3 normal = glm::normalize(outward - bend * s * along);
  const glm::dvec3 nearest = s * along + 0.5 * bend * s * s * outward;
  return { { normal }, glm::dot(nearest - step, normal), bend, static_cast<float>(Pi) };
}

/// Offers a particle the planes of the boundary curves around, each by the nearest particle on the curve. The curve of
/// another sheet would cut off whole splats on a curve that lies beside it, and is left out.
void offerBoundaries(
  const SpacingGrid& grid, const Buffer<BoundaryParticle>& onBoundary, Particle& particle)
{
  /// A boundary curve: the number of the nearest particle on it, and how far off that one is.
  struct Curve
  {
    int nearest = -1;
    double distance = 0.0;
  };
  std::array<Curve, 2> curves;
  const auto isAlong = [&](const Curve& curve, int j)
  {
    return curve.nearest >= 0 &&
      dot(onBoundary[curve.nearest].side.outward, onBoundary[j].side.outward) > SameEdge;
  };
  const auto endsSheetOf = [&](const BoundaryParticle& other)
  {
    return other.side.exists() && dot(other.particle.normal, particle.normal) > SheetCosine &&
      boundarySeenFrom(other, particle).distance >= -BoundarySight::SameSide * particle.spacing;
  };
  grid.visit(particle.position.xyz, particle.spacing,
    [&](int j)
    {
      const Curve curve{ j, length(onBoundary[j].particle.position - particle.position) };
      if (curve.distance > ClipReach * particle.spacing || !endsSheetOf(onBoundary[j]))
      {
        return;
      }
      auto& [first, second] = curves;
      if (first.nearest < 0 || curve.distance < first.distance)
      {
        second = isAlong(first, j) ? second : first;
        first = curve;
      }
      else if (!isAlong(first, j) && (second.nearest < 0 || curve.distance < second.distance))
      {
        second = curve;
      }
    });
  for (const Curve& curve : curves)
  {
    if (curve.nearest >= 0)
    {
      ClipPlane plane = boundarySeenFrom(onBoundary[curve.nearest], particle);
      plane.distance = std::max(0.0, plane.distance);
      offerPlane(particle, plane);
    }
  }
}

/// Whether a particle goes on with the surface that ends at another one: right beyond the boundary curve, and in the
/// same plane.
bool goesOnAt(const BoundaryParticle& onBoundary, const Particle& particle)
{
  const glm::dvec3 step = particle.position.xyz - onBoundary.particle.position.xyz;
  const glm::dvec3 normal = glm::normalize(particle.normal.xyz + onBoundary.particle.normal.xyz);
  const double height = glm::dot(step, normal);
  const double beyond = glm::dot(step, onBoundary.side.outward.xyz);
  const glm::dvec3 rest = step - height * normal - beyond * onBoundary.side.outward.xyz;
  const double h = particle.spacing;
  return beyond > BoundarySight::SameSide * h && beyond < Continuation::Beyond * h &&
    glm::length(rest) < Continuation::Aside * h && std::abs(height) < Continuation::Above * h &&
    dot(onBoundary.particle.normal, particle.normal) > Continuation::Cosine;
}

/// Whether two boundary curves are the two sides of a slit in one sheet.
bool areFacing(const BoundaryParticle& a, const BoundaryParticle& b)
{
  return lookAtEachOther(a.side, b.side) && dot(a.particle.normal, b.particle.normal) > 0.0 &&
    length(a.particle.position - b.particle.position) < ClipReach * a.particle.spacing;
}

/// Marks the particles on boundary curves beyond which a free particle goes on with the surface.
void markGoingOn(const SpacingGrid& grid, const ParticleGrid& all,
  std::vector<std::atomic<char>>& continuesIn, const ParallelFor& parallelFor)
{
  const Buffer<BoundaryParticle>& onBoundary = all.boundaryParticles();
  forAll(parallelFor, all.size() - onBoundary.size(),
    [&](std::size_t i)
    {
      const Particle& particle = all.at(i);
      grid.visit(particle.position.xyz, particle.spacing,
        [&](int j)
        {
          if (goesOnAt(onBoundary[j], particle))
          {
            continuesIn[j] = 1;
          }
        });
    });
}

/// Takes ends of the surface away that are none: a boundary curve comes to an edge of the mesh, and behind that edge
/// the surface goes on, though the elements on both sides of the edge hold none of it. There the gap is far smaller
/// than a spacing. The two sides of a slit stay.
void dropEndsThatGoOn(
  const SpacingGrid& grid, const ParticleGrid& all, const ParallelFor& parallelFor)
{
  Buffer<BoundaryParticle>& onBoundary = all.boundaryParticles();
  std::vector<std::atomic<char>> continuesIn(onBoundary.size());
  markGoingOn(grid, all, continuesIn, parallelFor);
  forAll(parallelFor, onBoundary.size(),
    [&](std::size_t i)
    {
      bool isSlit = false;
      grid.visit(onBoundary[i].particle.position.xyz, onBoundary[i].particle.spacing,
        [&](int j)
        {
          isSlit = isSlit || areFacing(onBoundary[i], onBoundary[j]);
          continuesIn[i] = continuesIn[i] || goesOnAt(onBoundary[i], onBoundary[j].particle);
        });
      continuesIn[i] = continuesIn[i] && !isSlit;
    });
  for (std::size_t i = 0; i < onBoundary.size(); ++i)
  {
    if (continuesIn[i])
    {
      onBoundary[i].side = {};
    }
  }
}

/// Takes planes of creases away where nothing behind them covers what they cut off.
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

  /// Whether a particle behind the face is near enough to cover what is cut off, but for the little that splats reach
  /// beyond their planes. There is none where the element behind is a sliver.
  bool goesOnBehind(const Particle& particle, const ClipPlane& plane) const
  {
    const int element = particle.location.element;
    const int joined = this->Surface.mesh->neighbor(element, plane.face).element;
    const glm::dvec3 foot = (particle.position + plane.distance * plane.normal).xyz;
    // In units of the larger spacing. Chosen by experiment: with a larger one holes stay at creases, with a smaller one
    // splats stand out beyond them.
    constexpr double nearEnough = 1.1;
    const auto isBehind = [&](int other)
    {
      return joined >= 0
        ? other == joined
        : this->Surface.locator && this->Surface.locator->mayContinueIn(element, plane.face, other);
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
  Buffer<BoundaryParticle>& onBoundary = all.boundaryParticles();
  const SpacedPoints points(
    onBoundary.size(), [&](std::size_t i) { return onBoundary[i].particle.position.xyz; },
    [&](std::size_t i) { return onBoundary[i].patch.spacing; }, parallelFor);
  const SpacingGrid grid(points.positions, points.spacings, ClipReach, CellsPerReach, parallelFor);
  dropEndsThatGoOn(grid, all, parallelFor);
  const CreaseCovers covers(surface, all);
  forAll(parallelFor, all.size(),
    [&](std::size_t i)
    {
      covers.dropOpen(all.at(i));
      offerBoundaries(grid, onBoundary, all.at(i));
    });
  forAll(parallelFor, onBoundary.size(),
    [&](std::size_t i)
    {
      auto& [particle, patch, side, other] = onBoundary[i];
      if (side.exists() && other.exists())
      {
        offerPlane(particle, { other.outward, 0.0, other.edgeCurvature, static_cast<float>(Pi) });
      }
    });
  closeCreaseCorners(all, parallelFor);
}

} // namespace hop
