#include "Edges/ClipPlanes.h"

#include "Edges/CreaseGaps.h"
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
  /// Largest height of a particle over the end of its own sheet, along the mean of both normals, which is 0 on a sheet
  /// that bends evenly. A larger one lets the end of a sheet cut off another one that passes over it; a smaller one
  /// misses ends behind creases. From 0.15 to 0.35 pictures are the same, to a pixel.
  static constexpr double SameSheet = 0.25;
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

bool areJoined(const ElementMesh& mesh, int element, int other)
{
  for (int face = 0; face < MaximumFaces; ++face)
  {
    if (mesh.neighbor(element, face).element == other)
    {
      return true;
    }
  }
  return false;
}

/// Whether a particle is behind the face at which the surface ends, in the element there or in one beside it. What these
/// hold is another sheet, however small the jump.
bool isBehind(const ElementMesh& mesh, const BoundaryParticle& end, const Particle& particle)
{
  const int before = end.particle.location.element;
  const int face = end.side.face; // -1 at the edge of a polygon
  const int behind = face >= 0 ? mesh.neighbor(before, face).element : -1;
  const int element = particle.location.element;
  return behind >= 0 && element != before &&
    (element == behind || (areJoined(mesh, behind, element) && !areJoined(mesh, before, element)));
}

/// Whether a particle is on the sheet that ends at a place: turned as it is, not far beyond the end, and not over it.
/// Where a field jumps, sheets may pass over each other's ends.
bool isEndOfSheet(const ElementMesh& mesh, const BoundaryParticle& end, const Particle& particle)
{
  const WorldVector step = particle.position - end.particle.position;
  const WorldVector bothNormals = end.particle.normal + particle.normal;
  return end.side.exists() && !isBehind(mesh, end, particle) &&
    dot(end.particle.normal, particle.normal) > SheetCosine &&
    std::abs(dot(step, bothNormals)) <= 2.0 * BoundarySight::SameSheet * particle.spacing &&
    boundarySeenFrom(end, particle).distance >= -BoundarySight::SameSide * particle.spacing;
}

/// Places at which the surface ends, to be found by place: particles on boundary curves, and places that stand too near
/// to others to be particles.
class SurfaceEnds
{
public:
  SurfaceEnds(Buffer<BoundaryParticle>& onBoundary, Buffer<BoundaryParticle>& thinned,
    const ParallelFor& parallelFor)
    : OnBoundary(onBoundary)
    , Thinned(thinned)
    , Points(
        onBoundary.size() + thinned.size(),
        [this](std::size_t i) { return this->at(i).particle.position.xyz; },
        [this](std::size_t i) { return this->at(i).patch.spacing; }, parallelFor)
    , Grid(this->Points.positions, this->Points.spacings, ClipReach, CellsPerReach, parallelFor)
  {
  }
  SurfaceEnds(const SurfaceEnds&) = delete;
  SurfaceEnds& operator=(const SurfaceEnds&) = delete;

  std::size_t size() const { return this->Points.positions.size(); }
  BoundaryParticle& at(std::size_t i) const
  {
    const std::size_t count = this->OnBoundary.size();
    return i < count ? this->OnBoundary[i] : this->Thinned[i - count];
  }

  /// Calls with the numbers of places around a particle.
  template <class Use>
  void visit(const Particle& particle, const Use& use) const
  {
    this->Grid.visit(particle.position.xyz, particle.spacing, use);
  }

private:
  Buffer<BoundaryParticle>& OnBoundary;
  Buffer<BoundaryParticle>& Thinned;
  SpacedPoints Points;
  SpacingGrid Grid;
};

/// Offers a particle the planes of the boundary curves around, each by the nearest place on the curve. The curve of
/// another sheet would cut off whole splats on a curve that lies beside it, and is left out.
void offerBoundaries(const ElementMesh& mesh, const SurfaceEnds& ends, Particle& particle)
{
  /// A boundary curve: the number of the nearest place on it, and how far off this one is.
  struct Curve
  {
    int nearest = -1;
    double distance = 0.0;

    bool exists() const { return this->nearest >= 0; }
  };
  const auto isNearer = [](const Curve& a, const Curve& b) { return a.distance < b.distance; };
  const auto isSame = [&](const Curve& a, const Curve& b)
  { return dot(ends.at(a.nearest).side.outward, ends.at(b.nearest).side.outward) > SameEdge; };
  std::array<Curve, 3> curves;
  ends.visit(particle,
    [&](int j)
    {
      const BoundaryParticle& end = ends.at(j);
      const Curve curve{ j, length(end.particle.position - particle.position) };
      if (curve.distance <= ClipReach * particle.spacing && isEndOfSheet(mesh, end, particle))
      {
        insertEdge(curves, curve, isNearer, isSame);
      }
    });
  for (const Curve& curve : curves)
  {
    if (curve.exists())
    {
      ClipPlane plane = boundarySeenFrom(ends.at(curve.nearest), particle);
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

/// Marks the places on boundary curves beyond which a free particle goes on with the surface.
void markGoingOn(const SurfaceEnds& ends, const ParticleGrid& all,
  std::vector<std::atomic<char>>& continuesIn, const ParallelFor& parallelFor)
{
  forAll(parallelFor, all.size() - all.boundaryParticles().size(),
    [&](std::size_t i)
    {
      const Particle& particle = all.at(i);
      ends.visit(particle,
        [&](int j)
        {
          if (goesOnAt(ends.at(j), particle))
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
  const SurfaceEnds& ends, const ParticleGrid& all, const ParallelFor& parallelFor)
{
  std::vector<std::atomic<char>> continuesIn(ends.size());
  markGoingOn(ends, all, continuesIn, parallelFor);
  forAll(parallelFor, ends.size(),
    [&](std::size_t i)
    {
      bool isSlit = false;
      ends.visit(ends.at(i).particle,
        [&](int j)
        {
          isSlit = isSlit || areFacing(ends.at(i), ends.at(j));
          continuesIn[i] = continuesIn[i] || goesOnAt(ends.at(i), ends.at(j).particle);
        });
      continuesIn[i] = continuesIn[i] && !isSlit;
    });
  for (std::size_t i = 0; i < ends.size(); ++i)
  {
    if (continuesIn[i])
    {
      ends.at(i).side = {};
    }
  }
}

/// Finds the planes of creases behind which nothing covers what they cut off.
class CreaseCovers
{
public:
  CreaseCovers(const Isosurface& surface, const ParticleGrid& all)
    : Surface(surface)
    , All(all)
  {
  }

  /// Lets the splat go on beyond open planes, where it counts only as far as no other does. Planes that cut come first.
  void markOpen(Particle& particle) const
  {
    for (ClipPlane& plane : particle.clips)
    {
      plane.dihedralAngle = this->isOpen(particle, plane) ? 0.0f : plane.dihedralAngle;
    }
    std::stable_partition(particle.clips.begin(), particle.clips.end(),
      [](const ClipPlane& plane) { return plane.exists() && !plane.isOpen(); });
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

void markClipPlanes(const Isosurface& surface, const ParticleGrid& all,
  Buffer<BoundaryParticle>& thinned, const ParallelFor& parallelFor)
{
  Buffer<BoundaryParticle>& onBoundary = all.boundaryParticles();
  const SurfaceEnds ends(onBoundary, thinned, parallelFor);
  dropEndsThatGoOn(ends, all, parallelFor);
  const CreaseCovers covers(surface, all);
  forAll(parallelFor, all.size(),
    [&](std::size_t i)
    {
      covers.markOpen(all.at(i));
      offerBoundaries(*surface.mesh, ends, all.at(i));
    });
  forAll(parallelFor, onBoundary.size(),
    [&](std::size_t i)
    {
      BoundaryParticle& corner = onBoundary[i];
      const BoundarySide& other = corner.otherSide;
      if (corner.side.exists() && other.exists())
      {
        offerPlane(
          corner.particle, { other.outward, 0.0, other.edgeCurvature, static_cast<float>(Pi) });
      }
    });
  closeCreaseGaps(all, parallelFor);
}

} // namespace hop
