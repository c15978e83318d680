#include "Edges/SampleComparison.h"

#include <cmath>

namespace hop
{
namespace
{

/// Cosine of the largest angle between the normals of smooth sheets, 2 degrees.
constexpr double smoothCosine = 0.9994;
/// Smooth sheets miss each other by less than this, in units of the distance of the samples.
constexpr double offSheet = 0.1;
/// Samples tell about places up to that far off, in units of the spacing, and up to that turn.
constexpr double farthestSample = 3.0;
constexpr double largestTurn = 0.5;
/// Cosine of the largest angle between the normals of sides that meet.
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
  return std::abs(a.heightOf(b.position)) <= offSheet * distance &&
    glm::dot(normalAt(a, 0.5 * a.inPlane(b.position)), normalAt(b, 0.5 * b.inPlane(a.position))) >=
    smoothCosine;
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
    return distance <= farthestSample * spacing &&
      distance * patch.curvatureMagnitude() <= largestTurn;
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
  // The distance of the sides is that along their normal; along the face it is larger.
  const double slant = glm::length(normal - glm::dot(normal, across) * across);
  return glm::dot(normal, other) >= meetingCosine &&
    std::abs(there->patch.heightOf(here.position)) <= largestJump * spacing * slant;
}

} // namespace hop
