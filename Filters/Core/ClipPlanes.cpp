#include "ClipPlanes.h"

#include "ActiveFaces.h"
#include "Energy.h"
#include "KinkCorners.h"
#include "SpacingGrid.h"

#include <algorithm>
#include <atomic>

namespace hop
{
namespace
{

/// Two planes whose normals are nearer than that are the same edge.
constexpr double sameEdge = 0.8;

/// Rims and kinks come before faces at which the surface is almost smooth, near ones before others.
bool comesBefore(const ClipPlane& a, const ClipPlane& b)
{
  const bool isSharp = a.turn > KinkAngle;
  return isSharp != (b.turn > KinkAngle) ? isSharp : a.distance < b.distance;
}

/// Keeps the first plane, and the first that belongs to another edge.
void offer(Particle& particle, const ClipPlane& plane)
{
  if (plane.distance > ClipReach * particle.spacing)
  {
    return;
  }
  auto& [first, second] = particle.clips;
  const auto isBefore = [&](const ClipPlane& other)
  { return !other.exists() || comesBefore(plane, other); };
  const bool isFirstEdge = first.exists() && dot(first.normal, plane.normal) > sameEdge;
  if (isBefore(first))
  {
    second = isFirstEdge ? second : first;
    first = plane;
  }
  else if (!isFirstEdge && isBefore(second))
  {
    second = plane;
  }
}

/// Of particles that lie farther beyond a rim's plane than this, in units of their spacing, it is no rim: they
/// are those of the other side of a jump. Bent rims leave their planes by less.
constexpr double sameSide = 0.2;

/// How far a particle lies before the plane through a particle on a rim.
double distanceTo(const RimParticle& rim, const Particle& particle)
{
  return dot(rim.particle.position - particle.position, rim.outward);
}

/// Planes through particles on rims around, each through the nearest that looks its way.
void offerRims(const SpacingGrid& grid, const Buffer<RimParticle>& rims, Particle& particle)
{
  struct Edge
  {
    int rim = -1;
    double distance = 0.0;
  };
  std::array<Edge, 2> edges;
  const auto looksLike = [&](const Edge& edge, int j)
  { return edge.rim >= 0 && dot(rims[edge.rim].outward, rims[j].outward) > sameEdge; };
  grid.visit(particle.position.xyz, particle.spacing,
    [&](int j)
    {
      const Edge edge{ j, length(rims[j].particle.position - particle.position) };
      if (edge.distance > ClipReach * particle.spacing || length(rims[j].outward) == 0.0 ||
        dot(rims[j].particle.normal, particle.normal) <= 0.0 ||
        distanceTo(rims[j], particle) < -sameSide * particle.spacing)
      {
        return;
      }
      auto& [first, second] = edges;
      if (first.rim < 0 || edge.distance < first.distance)
      {
        second = looksLike(first, j) ? second : first;
        first = edge;
      }
      else if (!looksLike(first, j) && (second.rim < 0 || edge.distance < second.distance))
      {
        second = edge;
      }
    });
  for (const Edge& edge : edges)
  {
    if (edge.rim >= 0)
    {
      const double distance = std::max(0.0, distanceTo(rims[edge.rim], particle));
      offer(particle, { rims[edge.rim].outward, distance, Pi });
    }
  }
}

/// Whether a particle goes on with the surface of one on a rim: right beyond it, and in its plane.
bool goesOnAt(const RimParticle& rim, const Particle& particle)
{
  constexpr double farthest = 1.3;
  constexpr double aside = 0.8;
  constexpr double above = 0.25;
  const glm::dvec3 step = particle.position.xyz - rim.particle.position.xyz;
  const glm::dvec3 normal = glm::normalize(particle.normal.xyz + rim.particle.normal.xyz);
  const double height = glm::dot(step, normal);
  const double beyond = glm::dot(step, rim.outward.xyz);
  const glm::dvec3 rest = step - height * normal - beyond * rim.outward.xyz;
  const double h = particle.spacing;
  return beyond > sameSide * h && beyond < farthest * h && glm::length(rest) < aside * h &&
    std::abs(height) < above * h && dot(rim.particle.normal, particle.normal) > 0.5;
}

/// Whether two rims look at each other, across a slit.
bool areFacing(const RimParticle& a, const RimParticle& b)
{
  return dot(a.outward, b.outward) < -0.5 && dot(a.particle.normal, b.particle.normal) > 0.0 &&
    length(a.particle.position - b.particle.position) < ClipReach * a.particle.spacing;
}

/// Where a rim comes to an edge of the mesh, and behind that edge the surface goes on though the elements on
/// both sides of it hold none, it is none: there is a gap far smaller than a spacing.
void openRimsThatGoOn(const SpacingGrid& grid, const Buffer<Particle>& particles,
  Buffer<RimParticle>& rims, const ParallelFor& parallelFor)
{
  std::vector<std::atomic<char>> goesOn(rims.size());
  forAll(parallelFor, particles.size(),
    [&](std::size_t i)
    {
      const Particle& particle = particles[i];
      grid.visit(particle.position.xyz, particle.spacing,
        [&](int j)
        {
          if (goesOnAt(rims[j], particle))
          {
            goesOn[j] = 1;
          }
        });
    });
  forAll(parallelFor, rims.size(),
    [&](std::size_t i)
    {
      bool isSlit = false;
      grid.visit(rims[i].particle.position.xyz, rims[i].particle.spacing,
        [&](int j)
        {
          isSlit = isSlit || areFacing(rims[i], rims[j]);
          goesOn[i] = goesOn[i] || goesOnAt(rims[i], rims[j].particle);
        });
      goesOn[i] = goesOn[i] && !isSlit;
    });
  for (std::size_t i = 0; i < rims.size(); ++i)
  {
    if (goesOn[i])
    {
      rims[i].outward = {};
    }
  }
}

/// Planes of faces at which the normal turns.
class FacePlanes
{
public:
  FacePlanes(const Isosurface& surface, const std::vector<float>& turns,
    const Buffer<Particle>& particles, const Buffer<RimParticle>& rims, const ParticleGrid& grid)
    : Mesh(*surface.mesh)
    , Locator(surface.locator)
    , Turns(turns)
    , Particles(particles)
    , Rims(rims)
    , Grid(grid)
  {
  }

  /// \param pull the inverse Jacobian of the particle's element there
  void offerTo(Particle& particle, const glm::mat3& pull) const
  {
    const Location& location = particle.location;
    const auto& faces = facts(this->Mesh.elements[location.element].domain).faces;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
      const double turn = this->Turns[faceSlot(location.element, f)];
      if (turn == 0.0)
      {
        continue;
      }
      const glm::dvec3 inward = glm::transpose(glm::dmat3(pull)) * faces[f].inward.xyz;
      const double slope = glm::length(inward);
      const double distance = std::max(0.0, faceMargin(faces[f], location.u) / slope);
      const WorldVector outward{ inward / -slope };
      if (slope > 0.0 && distance <= ClipReach * particle.spacing &&
        (turn <= KinkAngle ||
          this->goesOnBehind(particle, f, particle.position + distance * outward)))
      {
        offer(particle, { outward, distance, turn });
      }
    }
  }

private:
  /// Whether a particle behind the face is near enough to cover what is cut off, but for the little that splats
  /// reach beyond their planes: slivers of elements hold none.
  bool goesOnBehind(const Particle& particle, int face, const WorldPoint& foot) const
  {
    const int element = particle.location.element;
    const int joined = this->Mesh.neighbor(element, face).element;
    constexpr double nearEnough = 1.1;
    const auto isBehind = [&](int other)
    {
      return joined >= 0 ? other == joined
                         : this->Locator && this->Locator->mayGoOnIn(element, face, other);
    };
    bool found = false;
    this->Grid.visit(foot.xyz, particle.spacing,
      [&](int j)
      {
        found = found ||
          (glm::distance(this->Grid.position(j), foot.xyz) <=
              nearEnough * std::max<double>(particle.spacing, this->Grid.spacing(j)) &&
            isBehind(this->elementOf(j)));
      });
    return found;
  }

  int elementOf(std::size_t i) const
  {
    const std::size_t free = this->Particles.size();
    return (i < free ? this->Particles[i] : this->Rims[i - free].particle).location.element;
  }

  const ElementMesh& Mesh;
  const FaceLocator* Locator;
  const std::vector<float>& Turns;
  const Buffer<Particle>& Particles;
  const Buffer<RimParticle>& Rims;
  const ParticleGrid& Grid;
};

} // namespace

void markClipPlanes(const Isosurface& surface, const FaceJumps& jumps, const ParticleGrid& all,
  Buffer<RimParticle>& rims, Buffer<Particle>& particles, const Buffer<Anchor>& anchors,
  const ParallelFor& parallelFor)
{
  Buffer<glm::dvec3> positions(rims.size());
  Buffer<float> spacings(rims.size());
  forAll(parallelFor, rims.size(),
    [&](std::size_t i)
    {
      positions[i] = rims[i].particle.position.xyz;
      spacings[i] = rims[i].patch.spacing;
    });
  const SpacingGrid grid(positions, spacings, ClipReach, 0.5, parallelFor);
  openRimsThatGoOn(grid, particles, rims, parallelFor);
  const FacePlanes faces(surface, jumps.turns, particles, rims, all);
  forAll(parallelFor, particles.size(),
    [&](std::size_t i)
    {
      offerRims(grid, rims, particles[i]);
      faces.offerTo(particles[i], anchors[i].pull);
    });
  forAll(parallelFor, rims.size(),
    [&](std::size_t i)
    {
      offerRims(grid, rims, rims[i].particle);
      if (length(rims[i].outward) > 0.0 && length(rims[i].otherOutward) > 0.0)
      {
        offer(rims[i].particle, { rims[i].otherOutward, 0.0, Pi });
      }
      faces.offerTo(rims[i].particle, rims[i].pull);
    });
  closeKinkCorners(all, particles, rims, parallelFor);
}

} // namespace hop
