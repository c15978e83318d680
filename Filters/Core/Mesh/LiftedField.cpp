#include "Mesh/LiftedField.h"

#include "Support/KeepMarked.h"
#include "Support/PointBins.h"
#include "Surface/ActiveFaces.h"
#include "Surface/FaceLocator.h"
#include "Surface/Patch.h"

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
  /// The same up to which they are taken for one at all, in units of the spacing on flat surfaces.
  static constexpr double Farthest = 0.3;
  /// How near to a face a place on it is, see faceMargin(): what is in one place is on as many faces in all its elements.
  static constexpr double OnFace = 1e-8;
  /// By how much a place may be outside of its element, in reference space: some roundings. Long steps at oblique corners
  /// leave more.
  static constexpr double Outside = 1e-12;
  /// Square of the sine of the angle between the surface and a face below which there is no curve to find. Larger: where a
  /// surface is tangent to an edge, particles on it do not reach the point; smaller: rounding decides.
  static constexpr double Tangent = 1e-12;
  /// How far beside a particle places are tried from which Newton's method may find the surface where it does not from the
  /// particle, in spacings, nearest first; and how many there are around it.
  static constexpr double Beside[] = { 0.05, 0.1, 0.2, 0.3 };
  static constexpr int Around = 8;
  /// In spacings: the longest way from there, and how far from the particle the surface may be found. Larger: triangles at
  /// singular points lose their shape; smaller: fewer meshes are closed there.
  static constexpr double FromBeside = 0.5;
  static constexpr double FarBeside = 0.6;
  /// Share of the way back from the apex of a pyramid to where a particle was. Larger: it is farther from the surface than
  /// its tolerance; smaller: the apex is as near as rounding.
  static constexpr double BesideApex = 1e-8;
  /// Least cosine between the normals there and before: the other side of a cone is not taken.
  static constexpr double SameSide = 0.3;
};

/// The spacing on flat surfaces, or the largest that there is.
double flatSpacing(const Buffer<Particle>& particles)
{
  double most = 0.0;
  for (const Particle& particle : particles)
  {
    most = std::max(most, particle.spacing);
  }
  return most;
}

/// The places of the corners of a mesh, each once.
std::vector<glm::dvec3> cornersOf(
  const Buffer<Particle>& particles, const std::vector<int>& corners)
{
  std::vector<char> isCorner(particles.size(), 0);
  for (const int corner : corners)
  {
    isCorner[corner] = 1;
  }
  std::vector<glm::dvec3> places;
  for (const int corner : markedIndices(isCorner, particles.size()))
  {
    places.push_back(particles[corner].position.xyz);
  }
  return places;
}

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
  for (int n = 0; n < SurfaceWalker::MaximumNewtonSteps; ++n)
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
    // At a node with the isovalue the surface is in the corner of the element, where the step ends.
    const ReferenceVector step = (-point.value / rate) * along;
    const double share = findExit(domain, place.u, step, faces).fraction;
    place.u = broughtInside(domain, place.u + share * step);
  }
  return false;
}

/// Puts the particles of a lifted surface onto the surface itself. Each thread needs one of its own.
class WayBack
{
public:
  /// \param reach longest way that is gone, but for spacings longer than it
  WayBack(const Isosurface& surface, double reach)
    : Surface(surface)
    , Walker(surface)
    , Reach(reach)
  {
  }

  /// \return whether the particle is there
  bool putBack(Particle& particle);

private:
  bool find(const ActiveFaces& faces, double reach, Evaluated& place);
  bool findBeside(const ActiveFaces& faces, const Particle& particle, Evaluated& place);
  Location moved(const ActiveFaces& faces, const Evaluated& start, const WorldVector& step);

  const Isosurface& Surface;
  SurfaceWalker Walker;
  double Reach;
};

/// Newton's method from a place, along faces if there are any.
bool WayBack::find(const ActiveFaces& faces, double reach, Evaluated& place)
{
  return faces.count > 0 ? projectAlong(faces, this->Surface, this->Walker, reach, place.location)
                         : this->Walker.project(place.location, reach, place);
}

Location WayBack::moved(const ActiveFaces& faces, const Evaluated& start, const WorldVector& step)
{
  if (faces.count == 0)
  {
    return this->Walker.move(start, step);
  }
  const Domain domain = this->Surface.mesh->elements[start.location.element].domain;
  const ReferenceVector du = pullAlong(domain, faces, start.point.map, step);
  return { start.location.element, broughtInside(domain, start.location.u + du) };
}

/// The same from places beside a particle, in its tangent plane: it may be the one particle that comes to a singular point.
bool WayBack::findBeside(const ActiveFaces& faces, const Particle& particle, Evaluated& place)
{
  const Evaluated start = this->Walker.evaluate(particle.location);
  if (start.point.map.singular)
  {
    return false;
  }
  const std::array<glm::vec3, 2> tangents = tangentsOf(particle.normal.xyz);
  for (const double distance : Lift::Beside)
  {
    for (int k = 0; k < Lift::Around; ++k)
    {
      const double angle = 2.0 * Pi * k / Lift::Around;
      const WorldVector step{ distance * particle.spacing *
        (std::cos(angle) * glm::dvec3(tangents[0]) + std::sin(angle) * glm::dvec3(tangents[1])) };
      Evaluated found;
      found.location = this->moved(faces, start, step);
      if (!this->find(faces, Lift::FromBeside * particle.spacing, found))
      {
        continue;
      }
      found = this->Walker.evaluate(found.location);
      if (dot(surfaceNormal(found.point.gradient), particle.normal) > Lift::SameSide &&
        length(found.point.map.position - particle.position) <= Lift::FarBeside * particle.spacing)
      {
        place = found;
        return true;
      }
    }
  }
  return false;
}

bool WayBack::putBack(Particle& particle)
{
  const double reach = std::max(particle.spacing, this->Reach);
  const ActiveFaces faces = facesAt(*this->Surface.mesh, particle.location);
  Evaluated place;
  place.location = particle.location;
  Evaluated free = place;
  if (!this->find(faces, reach, place))
  {
    if (this->find({}, reach, free))
    {
      place = free;
    }
    else if (!this->findBeside(faces, particle, place))
    {
      return false;
    }
  }
  place = this->Walker.evaluateCurved(place.location);
  if (place.point.map.singular && place.location.element == particle.location.element)
  {
    place.location.u =
      place.location.u + Lift::BesideApex * (particle.location.u - place.location.u);
    place = this->Walker.evaluateCurved(place.location);
  }
  const double slope = length(place.point.gradient);
  if (place.point.map.singular || !(slope > 0.0) || !std::isfinite(slope) ||
    !this->Surface.holds(place.point, reach))
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
  const double reach = flatSpacing(particles);
  std::vector<char> isBack(particles.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(particles.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      WayBack way(located, reach);
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        isBack[i] = static_cast<char>(way.putBack(particles[i]));
      }
    });
  bool areAllBack = std::find(isBack.begin(), isBack.end(), 0) == isBack.end();
  for (const auto& [a, b] : distribution.edges.coincident)
  {
    const Particle& one = particles[a];
    Particle& other = particles[b];
    const double apart = length(other.position - one.position);
    areAllBack = areAllBack && apart <= Lift::Farthest * reach;
    if (apart > Lift::OnePlace * one.spacing)
    {
      other.location = one.location;
      other.residual = one.residual;
    }
    other.position = one.position;
  }
  return areAllBack;
}

bool isCoveredBy(const Buffer<Particle>& particles, const std::vector<int>& corners,
  const Buffer<Particle>& others, const std::vector<int>& otherCorners,
  const ParallelFor& parallelFor)
{
  const std::vector<glm::dvec3> here = cornersOf(particles, corners);
  const std::vector<glm::dvec3> there = cornersOf(others, otherCorners);
  const double reach = flatSpacing(particles);
  // What is in one bin is near to each other: of a dense mesh one point is looked at for each corner, as a rule.
  const PointBins bins(there, reach / std::sqrt(3.0));
  std::vector<char> isNear(here.size());
  forAll(parallelFor, here.size(),
    [&](std::size_t i)
    {
      const auto isReached = [&](int other)
      { return glm::distance(here[i], there[other]) <= reach; };
      isNear[i] = bins.anyOf(here[i], 0.0, isReached) || bins.anyOf(here[i], reach, isReached);
    });
  return std::find(isNear.begin(), isNear.end(), 0) == isNear.end();
}

} // namespace hop
