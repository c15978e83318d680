#include "Mesh/LiftedField.h"

#include "Surface/ActiveFaces.h"
#include "Surface/FaceLocator.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// Chosen by experiment.
struct Lift
{
  /// Largest distance of a value from the isovalue that counts as none. Larger: more of the field is changed; smaller:
  /// surfaces that run very near to edges of the mesh keep their holes.
  static constexpr double Near = 5e-4;
  /// In units of the spacing: distance of particles that were in one place, once they are back, up to which each keeps its
  /// location, as the other side of a crease.
  static constexpr double OnePlace = 1e-6;
  /// The same up to which they are taken for one at all.
  static constexpr double Farthest = 0.3;
  /// How near to a face a place on it is, see faceMargin(): what is in one place is on as many faces in all its elements.
  static constexpr double OnFace = 1e-8;
  /// By how much a place may be outside of its element, in reference space: some roundings. Long steps at oblique corners
  /// leave more.
  static constexpr double Outside = 1e-12;
  /// Square of the sine of the angle between the surface and a face below which there is no curve to find.
  static constexpr double Tangent = 1e-6;
};

/// The faces of its element that a place is on, two at most.
ActiveFaces facesAt(const ElementMesh& mesh, const Location& place)
{
  ActiveFaces faces;
  const auto& all = facts(mesh.elements[place.element].domain).faces;
  for (int f = 0; f < static_cast<int>(all.size()) && faces.count < 2; ++f)
  {
    if (faceMargin(all[f], place.u) < Lift::OnFace)
    {
      faces.add(f);
    }
  }
  return faces;
}

/// Newton's method along faces of the element.
/// \param reach longest way
/// \return whether it has found the surface in the element
bool projectAlong(const ActiveFaces& faces, const Isosurface& surface, SurfaceWalker& walker,
  double reach, Location& place)
{
  const Domain domain = surface.mesh->elements[place.element].domain;
  double travel = 0.0;
  for (int step = 0; step < SurfaceWalker::MaximumNewtonSteps; ++step)
  {
    const FieldPoint point = walker.evaluate(place).point;
    if (surface.holds(point, reach))
    {
      return insideMargin(domain, place.u) >= -Lift::Outside;
    }
    const ReferenceVector along = pullAlong(domain, faces, point.map, point.gradient);
    const double rate = dot(point.map.push(along), point.gradient);
    if (!(rate > Lift::Tangent * dot(point.gradient, point.gradient)))
    {
      return false;
    }
    travel += std::abs(point.value / rate) * length(point.map.push(along));
    if (travel > reach)
    {
      return false;
    }
    place.u = broughtInside(domain, place.u + (-point.value / rate) * along);
  }
  return false;
}

/// Puts a particle onto the surface: along faces on which it stands, as both sides of them do.
/// \return whether it is there
bool putBack(const Isosurface& surface, SurfaceWalker& walker, Particle& particle)
{
  Evaluated place;
  place.location = particle.location;
  const ActiveFaces faces = facesAt(*surface.mesh, particle.location);
  const bool isFound =
    faces.count > 0 && projectAlong(faces, surface, walker, particle.spacing, place.location);
  if (!isFound && !walker.project(particle.location, particle.spacing, place))
  {
    return false;
  }
  place = walker.evaluateCurved(place.location);
  const double slope = length(place.point.gradient);
  if (place.point.map.singular || !(slope > 0.0) || !std::isfinite(slope))
  {
    return false; // the surface is singular there
  }
  const Particle there = particleAt(
    place.location, place.point, curvature(place.point.gradient, place.hessian), particle.spacing);
  particle.location = there.location;
  particle.position = there.position;
  particle.normal = there.normal;
  particle.curvature = there.curvature;
  particle.residual = there.residual;
  return true;
}

} // namespace

std::optional<ElementMesh> liftedMesh(
  const ElementMesh& mesh, double isovalue, LiftedValues which, double height)
{
  const double near = which == LiftedValues::Near ? Lift::Near : 0.0;
  const auto weightOf = [&mesh](std::size_t i)
  { return mesh.weights.empty() ? 1.0 : mesh.weights[i]; };
  const auto isNear = [&](std::size_t i)
  { return std::abs(mesh.coefficients[i].w - isovalue * weightOf(i)) <= near * weightOf(i); };
  std::size_t first = 0;
  while (first < mesh.coefficients.size() && !isNear(first))
  {
    ++first;
  }
  if (first == mesh.coefficients.size() || !mesh.exactFields.empty())
  {
    return std::nullopt;
  }
  ElementMesh lifted = mesh;
  for (std::size_t i = first; i < lifted.coefficients.size(); ++i)
  {
    if (isNear(i))
    {
      const bool isBelow = mesh.coefficients[i].w < isovalue * weightOf(i);
      lifted.coefficients[i].w = (isovalue + (isBelow ? -height : height)) * weightOf(i);
    }
  }
  return lifted;
}

bool putBack(const Isosurface& surface, Distribution& distribution, const ParallelFor& parallelFor)
{
  const FaceLocator locator(*surface.mesh, surface.isovalue, parallelFor);
  Isosurface located = surface;
  located.locator = &locator;
  Buffer<Particle>& particles = distribution.particles;
  std::vector<char> isBack(particles.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(particles.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      SurfaceWalker walker(located);
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        isBack[i] = static_cast<char>(putBack(located, walker, particles[i]));
      }
    });
  bool areAllBack = std::find(isBack.begin(), isBack.end(), 0) == isBack.end();
  for (const auto& [a, b] : distribution.edges.coincident)
  {
    const Particle& one = particles[a];
    Particle& other = particles[b];
    const double apart = length(other.position - one.position);
    areAllBack = areAllBack && apart <= Lift::Farthest * one.spacing;
    if (apart > Lift::OnePlace * one.spacing)
    {
      other.location = one.location;
      other.residual = one.residual;
    }
    other.position = one.position;
  }
  return areAllBack;
}

} // namespace hop
