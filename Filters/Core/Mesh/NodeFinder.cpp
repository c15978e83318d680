#include "Mesh/NodeFinder.h"

#include "Surface/ActiveFaces.h"

#include <cmath>

namespace hop
{
namespace
{

/// How a node is sought. All were chosen by experiment.
struct Search
{
  /// Steps along the surface; each squares the relative distance to the node. Fewer: nodes on strongly bent triangles
  /// stay straight; more: time is lost on lines that the surface does not meet.
  static constexpr int MostSteps = 12;
  /// A step this short, in units of the triangle's edges, is the last one: behind it the distance is about its square.
  /// Larger: nodes stand off their lines, which costs an order of accuracy; smaller: one evaluation more.
  static constexpr double LastStep = 1e-4;
  /// A place this near to its line, in units of the triangle's edges, is taken although steps come no nearer: where the
  /// surface ends before it meets the line. Larger: triangles fold over; smaller: their nodes stay straight.
  static constexpr double Near = 0.1;
  /// Least cosine of the angle between line and normal, or of a chord and its curve, 78 degrees. Smaller: steps go
  /// far astray; larger: nodes on strongly bent triangles stay straight.
  static constexpr double LeastCosine = 0.2;
  /// Share of a step along a curve by which it is sent out of the element as well, so that it is held back by the next
  /// element's face, too. Any value does that is not small beside the angle between both.
  static constexpr double Outward = 0.1;
};

WorldVector unit(const WorldVector& v)
{
  return (1.0 / length(v)) * v;
}

/// Takes steps until one is short.
/// \param stepFrom the next step from a place; none where there is no way on
/// \param go takes a step; returns whether it arrived on the surface
template <class StepFrom, class Go>
std::optional<Evaluated> search(Evaluated at, double scale, const StepFrom& stepFrom, const Go& go)
{
  double left = 0.0;
  for (int n = 0; n < Search::MostSteps; ++n)
  {
    const std::optional<WorldVector> step = stepFrom(at);
    if (!step || !(length(*step) <= 2.0 * scale))
    {
      return std::nullopt;
    }
    left = length(*step);
    if (!go(at, *step))
    {
      return std::nullopt;
    }
    if (left <= Search::LastStep * scale)
    {
      return at;
    }
  }
  return left <= Search::Near * scale ? std::optional<Evaluated>(at) : std::nullopt;
}

} // namespace

std::optional<Evaluated> NodeFinder::onLine(const Location& start, const NodeLine& line)
{
  // To where the line meets the tangent plane.
  const auto stepFrom = [&](const Evaluated& at) -> std::optional<WorldVector>
  {
    const WorldVector normal = surfaceNormal(at.point.gradient);
    const double cosine = dot(normal, line.direction);
    const WorldVector toFoot = line.foot - at.point.map.position;
    return cosine > Search::LeastCosine
      ? std::optional<WorldVector>(toFoot - (dot(toFoot, normal) / cosine) * line.direction)
      : std::nullopt;
  };
  const auto go = [&](Evaluated& at, const WorldVector& step)
  { return this->Walker.project(this->Walker.move(at, step), line.scale, at); };
  return search(this->Walker.evaluate(start), line.scale, stepFrom, go);
}

/// The tangent of the curve on which a place lies, on the face where it runs along `along`, or against it, most.
std::optional<NodeFinder::Tangent> NodeFinder::tangentAt(
  const Evaluated& at, const WorldVector& along)
{
  const ElementMesh& mesh = *this->Ending.mesh;
  const int faces = static_cast<int>(facts(mesh.elements[at.location.element].domain).faces.size());
  const WorldVector normal = surfaceNormal(at.point.gradient);
  std::optional<Tangent> best;
  double largest = Search::LeastCosine;
  for (int f = 0; f < faces; ++f)
  {
    if (!this->EndWalker.endsAt(at, f))
    {
      continue;
    }
    const WorldVector outward{ -(
      glm::transpose(at.point.map.inverse) * mesh.face(at.location.element, f).inward.xyz) };
    const WorldVector tangent{ glm::cross(normal.xyz, outward.xyz) };
    const double cosine = std::abs(dot(tangent, along)) / length(tangent);
    if (cosine > largest)
    {
      largest = cosine;
      best = Tangent{ unit(tangent), unit(outward) };
    }
  }
  return best;
}

std::optional<Evaluated> NodeFinder::onCurve(
  const Location& start, const NodeLine& line, const WorldVector& along)
{
  const auto stepFrom = [&](const Evaluated& at) -> std::optional<WorldVector>
  {
    const std::optional<Tangent> tangent = this->tangentAt(at, along);
    if (!tangent)
    {
      return std::nullopt;
    }
    const double left = dot(line.foot - at.point.map.position, along);
    return (left / dot(tangent->along, along)) * tangent->along;
  };
  const auto go = [&](Evaluated& at, const WorldVector& step)
  {
    const WorldVector outward =
      (Search::Outward * length(step)) * this->tangentAt(at, along)->outward;
    const Location there = this->EndWalker.move(at, step + outward);
    return this->EndWalker.project(there, line.scale, at, /*keepFace=*/true);
  };
  const std::optional<Evaluated> found =
    search(this->EndWalker.evaluate(start), line.scale, stepFrom, go);
  return found && this->tangentAt(*found, along) ? found : std::nullopt;
}

Particle NodeFinder::particleOf(const Location& place, double spacing)
{
  const Evaluated at = this->Walker.evaluateCurved(place);
  return particleAt(place, at.point, curvature(at.point.gradient, at.hessian), spacing);
}

Particle NodeFinder::straightParticle(const Location& start, const NodeLine& line, double spacing)
{
  const Evaluated from = this->Walker.evaluate(start);
  const WorldVector step = line.foot - from.point.map.position;
  Particle particle = this->particleOf(this->Walker.move(from, step), spacing);
  particle.position = line.foot;
  particle.normal = line.direction;
  if (!std::isfinite(particle.residual))
  {
    particle.residual =
      line.scale; // the field stands still, or the element is flat; farther away it was not sought
  }
  return particle;
}

WorldVector NodeFinder::meanNormal(const Location& place)
{
  const ElementMesh& mesh = *this->Ending.mesh;
  const int faces = static_cast<int>(facts(mesh.elements[place.element].domain).faces.size());
  WorldVector sum = surfaceNormal(this->Walker.evaluate(place).point.gradient);
  for (int f = 0; f < faces; ++f)
  {
    const bool isCrease = this->Ending.mayEnd(place.element, f) &&
      mesh.neighbor(place.element, f).element >= 0 && isOnFace(mesh, place, f);
    if (isCrease)
    {
      sum = sum + surfaceNormal(this->Walker.evaluate(crossFace(mesh, place, f)).point.gradient);
    }
  }
  return unit(sum);
}

} // namespace hop
