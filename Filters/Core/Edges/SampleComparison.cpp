#include "Edges/SampleComparison.h"

#include <cmath>

namespace hop
{
namespace
{

/// When two samples belong to one smooth sheet. A looser limit overlooks dihedral angles, a tighter one costs
/// evaluations. Chosen by experiment.
struct Smoothness
{
  /// Cosine of the largest angle between the normals halfway between the samples: 2 degrees.
  static constexpr double LeastCosine = 0.9994;
  /// Largest distance of one sample from where the other's patch leads to, in units of the distance of the samples.
  static constexpr double LargestMiss = 0.1;
};

/// How far a sample tells about the surface around it. More believes second-order patches too far off, less costs
/// evaluations. Chosen by experiment.
struct Trust
{
  /// Largest distance, in units of the spacing.
  static constexpr double Distance = 3.0;
  /// Largest angle by which the surface bends on the way, radians.
  static constexpr double Angle = 0.5;
};

/// Cosine of the largest angle between the normals of two sides that meet: 26 degrees. Where the sides are turned more,
/// the distance between them says little. Chosen by experiment: farther from 1 jumps at creases are overlooked, nearer
/// to 1 costs evaluations.
constexpr double meetingCosine = 0.9;

/// Unit normal of a patch above a place of its tangent plane.
glm::dvec3 normalAt(const Patch& patch, const glm::dvec2& t)
{
  const auto tangents = tangentsOf(patch.normal);
  const glm::dvec2 slope = patch.slope(t);
  return glm::normalize(glm::dvec3(patch.normal) + slope.x * glm::dvec3(tangents[0]) +
    slope.y * glm::dvec3(tangents[1]));
}

/// Whether two patches look like parts of one smooth sheet: one lies where the other leads to, and halfway
/// between them their normals agree.
bool areSmooth(const Patch& a, const Patch& b)
{
  const double distance = glm::distance(a.position, b.position);
  return std::abs(a.heightOf(b.position)) <= Smoothness::LargestMiss * distance &&
    glm::dot(normalAt(a, 0.5 * a.inPlane(b.position)), normalAt(b, 0.5 * b.inPlane(a.position))) >=
    Smoothness::LeastCosine;
}

} // namespace

bool SampleComparison::isSmoothTo(const SurfaceProxy::Sample& sample, int element) const
{
  const SurfaceProxy::Sample* nearest = this->Proxy.nearestSample(sample.patch.position, element);
  return nearest && areSmooth(sample.patch, nearest->patch);
}

bool SampleComparison::meet(
  const FaceCrossing& crossing, const SurfaceProxy::Sample& sample, double largestJump) const
{
  const int element = crossing.location.element;
  const int neighbor = this->Mesh.neighbor(element, crossing.face).element;
  if (!sample.found || neighbor < 0)
  {
    return false;
  }
  Anchor anchor;
  Patch here;
  continuePatch(sample.anchor, sample.patch, crossing.location, anchor, here);
  const SurfaceProxy::Sample* there = this->Proxy.nearestSample(here.position, neighbor);
  const double spacing = sample.patch.spacing;
  const auto reaches = [&](const Patch& patch)
  {
    const double distance = glm::distance(patch.position, here.position);
    return distance <= Trust::Distance * spacing &&
      distance * patch.curvatureMagnitude() <= Trust::Angle;
  };
  if (!there || !reaches(sample.patch) || !reaches(there->patch))
  {
    return false;
  }
  const glm::dvec3 normal(here.normal);
  const glm::dvec3 other = normalAt(there->patch, there->patch.inPlane(here.position));
  const Face& face = this->Mesh.face(element, crossing.face);
  const glm::dvec3 across =
    glm::normalize(glm::transpose(glm::dmat3(sample.anchor.pull)) * face.inward.xyz);
  // A jump along the face is larger than the distance of the sides along their normal.
  const double slant = glm::length(normal - glm::dot(normal, across) * across);
  return glm::dot(normal, other) >= meetingCosine &&
    std::abs(there->patch.heightOf(here.position)) <= largestJump * spacing * slant;
}

} // namespace hop
