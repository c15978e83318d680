#include "ClipPlanes.h"

#include "ActiveFaces.h"
#include "Energy.h"
#include "KeepMarked.h"
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

/// Rims that cut the splat come before kinks, these before faces at which the surface is almost smooth, near ones
/// before others.
bool comesBefore(const ClipPlane& a, const ClipPlane& b, double spacing)
{
  const auto rank = [spacing](const ClipPlane& plane) {
    return plane.turn == Pi && plane.distance < spacing ? 0 : plane.turn > KinkAngle ? 1 : 2;
  };
  return rank(a) != rank(b) ? rank(a) < rank(b) : a.distance < b.distance;
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
  { return !other.exists() || comesBefore(plane, other, particle.spacing); };
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

/// The rim, known at one of its particles, as another particle sees it: the plane touches it where it is nearest,
/// but no farther off than where it has turned by half a radian: behind that it may run anywhere.
/// \pre the rim is one
ClipPlane rimSeenFrom(const RimParticle& rim, const Particle& particle)
{
  const glm::dvec3& outward = rim.side.outward.xyz;
  const glm::dvec3 along = glm::cross(rim.particle.normal.xyz, outward);
  const glm::dvec3 step = particle.position.xyz - rim.particle.position.xyz;
  const double largest = 1.0 / particle.spacing; // more than that a parabola does not follow
  const double bend = std::clamp(rim.side.bend, -largest, largest);
  const double farthest = 0.5 / std::max(std::abs(bend), 1e-3 * largest);
  const double s = std::clamp(glm::dot(step, along), -farthest, farthest);
  const glm::dvec3 normal = glm::normalize(outward - bend * s * along);
  const glm::dvec3 nearest = s * along + 0.5 * bend * s * s * outward;
  return { { normal }, glm::dot(nearest - step, normal), Pi, bend };
}

/// Planes of the rims around, each by the nearest particle on it.
void offerRims(const SpacingGrid& grid, const Buffer<RimParticle>& rims, Particle& particle)
{
  struct Edge
  {
    int rim = -1;
    double distance = 0.0;
  };
  std::array<Edge, 2> edges;
  const auto looksLike = [&](const Edge& edge, int j)
  { return edge.rim >= 0 && dot(rims[edge.rim].side.outward, rims[j].side.outward) > sameEdge; };
  grid.visit(particle.position.xyz, particle.spacing,
    [&](int j)
    {
      const Edge edge{ j, length(rims[j].particle.position - particle.position) };
      if (edge.distance > ClipReach * particle.spacing || !rims[j].side.exists() ||
        dot(rims[j].particle.normal, particle.normal) <= 0.0 ||
        rimSeenFrom(rims[j], particle).distance < -sameSide * particle.spacing)
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
      ClipPlane plane = rimSeenFrom(rims[edge.rim], particle);
      plane.distance = std::max(0.0, plane.distance);
      offer(particle, plane);
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
  const double beyond = glm::dot(step, rim.side.outward.xyz);
  const glm::dvec3 rest = step - height * normal - beyond * rim.side.outward.xyz;
  const double h = particle.spacing;
  return beyond > sameSide * h && beyond < farthest * h && glm::length(rest) < aside * h &&
    std::abs(height) < above * h && dot(rim.particle.normal, particle.normal) > 0.5;
}

/// Whether two rims look at each other, across a slit.
bool areFacing(const RimParticle& a, const RimParticle& b)
{
  return dot(a.side.outward, b.side.outward) < -0.5 &&
    dot(a.particle.normal, b.particle.normal) > 0.0 &&
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
      rims[i].side = {};
    }
  }
}

/// A function of world space near a place, to second order.
struct Quadratic
{
  double value = 0.0;
  LevelSet slope;

  double valueAt(const glm::dvec3& x) const
  {
    return this->value + glm::dot(this->slope.gradient.xyz + 0.5 * this->slope.hessian * x, x);
  }
  LevelSet slopeAt(const glm::dvec3& x) const
  {
    return { this->slope.gradient + WorldVector{ this->slope.hessian * x }, this->slope.hessian };
  }
};

/// The place on the curve {a = b = 0} that is nearest to the origin; not finite where there is none.
glm::dvec3 nearestOnCrossing(const Quadratic& a, const Quadratic& b)
{
  constexpr int steps = 4;
  glm::dvec3 x(0.0);
  for (int step = 0; step < steps; ++step)
  {
    // Of the places on both planes that touch the functions here, the nearest.
    const glm::dvec3 p = a.slopeAt(x).gradient.xyz;
    const glm::dvec3 q = b.slopeAt(x).gradient.xyz;
    const glm::dvec2 wanted(glm::dot(p, x) - a.valueAt(x), glm::dot(q, x) - b.valueAt(x));
    const glm::dmat2 products(glm::dot(p, p), glm::dot(p, q), glm::dot(p, q), glm::dot(q, q));
    const glm::dvec2 shares = glm::inverse(products) * wanted;
    x = shares.x * p + shares.y * q;
  }
  return x;
}

/// The face by which the surface leaves an element, touched where the surface is nearest to leaving, as a particle
/// in the element sees that to second order. (Planes across the surface would not be the same from both sides.)
/// \param field, wall around the particle: F - c, and faceMargin() of the face
/// \return the plane exists only if that place is within reach
ClipPlane edgeSeenFrom(const Particle& particle, const Quadratic& field, const Quadratic& wall)
{
  const glm::dvec3 nearest = nearestOnCrossing(field, wall);
  if (!(glm::length(nearest) <= ClipReach * particle.spacing))
  {
    return {};
  }
  const LevelSet wallThere = wall.slopeAt(nearest);
  const WorldVector outward{ -glm::normalize(wallThere.gradient.xyz) };
  const WorldVector bend = bendOfCrossing(field.slopeAt(nearest), wallThere);
  return { outward, std::max(0.0, glm::dot(nearest, outward.xyz)), 0.0, dot(bend, outward) };
}

/// Planes of faces at which the normal turns.
class FacePlanes
{
public:
  FacePlanes(const Isosurface& surface, const std::vector<float>& turns,
    const Buffer<Particle>& particles, const Buffer<RimParticle>& rims, const ParticleGrid& grid)
    : Surface(surface)
    , Mesh(*surface.mesh)
    , Turns(turns)
    , Particles(particles)
    , Rims(rims)
    , Grid(grid)
  {
  }

  /// Faces at which the surface is almost smooth.
  /// \param pull the inverse Jacobian of the particle's element there
  /// \return whether a kink is near
  bool offerSmooth(Particle& particle, const glm::mat3& pull) const
  {
    bool nearKink = false;
    this->visitTurns(particle,
      [&](const Face& face, int, double turn)
      {
        ClipPlane plane = planeOf(face, particle, pull);
        if (plane.distance > ClipReach * particle.spacing)
        {
          return;
        }
        nearKink = nearKink || turn > KinkAngle;
        if (turn <= KinkAngle)
        {
          plane.turn = turn;
          offer(particle, plane);
        }
      });
    return nearKink;
  }

  /// \param jet at the particle's place, with second derivatives
  void offerKinks(Particle& particle, const Jet& jet) const
  {
    const FieldPoint point = fieldPoint(jet, this->Surface.isovalue);
    const Quadratic field{ point.value, { point.gradient, worldHessian(jet, point) } };
    this->visitTurns(particle,
      [&](const Face& face, int f, double turn)
      {
        if (turn <= KinkAngle)
        {
          return;
        }
        const Quadratic wall{ faceMargin(face, particle.location.u),
          faceLevels(jet, point.map, face) };
        ClipPlane plane = edgeSeenFrom(particle, field, wall);
        if (plane.exists() &&
          this->goesOnBehind(particle, f, particle.position + plane.distance * plane.normal))
        {
          plane.turn = turn;
          offer(particle, plane);
        }
      });
  }

private:
  /// Calls use(face, number, turn) for faces of its element at which the normal turns.
  template <class Use>
  void visitTurns(const Particle& particle, const Use& use) const
  {
    const int element = particle.location.element;
    const auto& faces = facts(this->Mesh.elements[element].domain).faces;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
      const double turn = this->Turns[faceSlot(element, f)];
      if (turn != 0.0)
      {
        use(faces[f], f, turn);
      }
    }
  }

  /// The face itself, to first order.
  static ClipPlane planeOf(const Face& face, const Particle& particle, const glm::mat3& pull)
  {
    const glm::dvec3 inward = glm::transpose(glm::dmat3(pull)) * face.inward.xyz;
    const double slope = glm::length(inward);
    return slope > 0.0 ? ClipPlane{ { inward / -slope },
      std::max(0.0, faceMargin(face, particle.location.u) / slope) }
                       : ClipPlane{ {}, std::numeric_limits<double>::infinity() };
  }

  /// Whether a particle behind the face is near enough to cover what is cut off, but for the little that splats
  /// reach beyond their planes: slivers of elements hold none.
  bool goesOnBehind(const Particle& particle, int face, const WorldPoint& foot) const
  {
    const int element = particle.location.element;
    const int joined = this->Mesh.neighbor(element, face).element;
    constexpr double nearEnough = 1.1;
    const auto isBehind = [&](int other)
    {
      return joined >= 0
        ? other == joined
        : this->Surface.locator && this->Surface.locator->mayGoOnIn(element, face, other);
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

  const Isosurface& Surface;
  const ElementMesh& Mesh;
  const std::vector<float>& Turns;
  const Buffer<Particle>& Particles;
  const Buffer<RimParticle>& Rims;
  const ParticleGrid& Grid;
};

/// Offers those of `count` particles the faces around.
/// \param particleAt, pullAt functions of 0 to count - 1
/// \return the number of evaluations
template <class ParticleAt, class PullAt>
std::int64_t offerFaces(const Isosurface& surface, const FacePlanes& faces, std::size_t count,
  const ParticleAt& particleAt, const PullAt& pullAt, const ParallelFor& parallelFor)
{
  std::vector<char> marks(count);
  forAll(parallelFor, count,
    [&](std::size_t i) { marks[i] = faces.offerSmooth(particleAt(i), pullAt(i)); });
  const std::vector<int> nearKinks = markedIndices(marks, count);
  std::vector<Location> places;
  places.reserve(nearKinks.size());
  for (const int i : nearKinks)
  {
    places.push_back(particleAt(i).location);
  }
  const ElementMesh& mesh = *surface.mesh;
  const std::vector<int> order = orderByElement(places, mesh.elements.size(), parallelFor);
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(order.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      evaluateInOrder(mesh, places, order, begin, end,
        [&](int n, const Jet& jet) { faces.offerKinks(particleAt(nearKinks[n]), jet); });
    });
  return static_cast<std::int64_t>(order.size());
}

} // namespace

std::int64_t markClipPlanes(const Isosurface& surface, const FaceJumps& jumps,
  const ParticleGrid& all, Buffer<RimParticle>& rims, Buffer<Particle>& particles,
  const Buffer<Anchor>& anchors, const ParallelFor& parallelFor)
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
  forAll(
    parallelFor, particles.size(), [&](std::size_t i) { offerRims(grid, rims, particles[i]); });
  forAll(parallelFor, rims.size(),
    [&](std::size_t i)
    {
      auto& [particle, patch, pull, side, other] = rims[i];
      offerRims(grid, rims, particle);
      if (side.exists() && other.exists())
      {
        offer(particle, { other.outward, 0.0, Pi, other.bend });
      }
    });
  const FacePlanes faces(surface, jumps.turns, particles, rims, all);
  const std::int64_t evaluations =
    offerFaces(
      surface, faces, particles.size(), [&](std::size_t i) -> Particle& { return particles[i]; },
      [&](std::size_t i) { return anchors[i].pull; }, parallelFor) +
    offerFaces(
      surface, faces, rims.size(), [&](std::size_t i) -> Particle& { return rims[i].particle; },
      [&](std::size_t i) { return rims[i].pull; }, parallelFor);
  closeKinkCorners(all, particles, rims, parallelFor);
  return evaluations;
}

} // namespace hop
