#include "Surface/SurfaceGeometry.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hop
{
namespace
{

LocalMap localMap(const Jet& jet)
{
  // A column this short beside the others or beside the coordinates, and a determinant this small
  // beside the product of the columns' lengths, are rounding errors.
  constexpr double roundedColumn = 1e-13;
  constexpr double roundedDeterminant = 1e-12;
  LocalMap map;
  map.position = { glm::dvec3(jet.value) };
  map.jacobian =
    glm::dmat3(glm::dvec3(jet.first[0]), glm::dvec3(jet.first[1]), glm::dvec3(jet.first[2]));
  const double lengths[] = { glm::length(map.jacobian[0]), glm::length(map.jacobian[1]),
    glm::length(map.jacobian[2]) };
  const auto [shortest, longest] = std::minmax_element(std::begin(lengths), std::end(lengths));
  const double determinant = glm::determinant(map.jacobian);
  map.singular = !(*shortest > roundedColumn * std::max(*longest, glm::length(map.position.xyz))) ||
    !(std::abs(determinant) > roundedDeterminant * lengths[0] * lengths[1] * lengths[2]);
  map.inverse = map.singular ? glm::dmat3(0.0) : glm::inverse(map.jacobian);
  return map;
}

/// To world space, of a function with that Hessian in reference space.
glm::dmat3 pulled(glm::dmat3 hessian, const std::array<Coefficient, 6>& second, const LocalMap& map,
  const WorldVector& gradient)
{
  for (int i = 0; i < 3; ++i)
  {
    hessian -= gradient.xyz[i] * hessianOf(second, i);
  }
  return glm::transpose(map.inverse) * hessian * map.inverse;
}

} // namespace

FieldPoint fieldPoint(const Jet& jet, double isovalue)
{
  FieldPoint point;
  point.map = localMap(jet);
  point.value = jet.value.w - isovalue;
  point.gradient = { glm::transpose(point.map.inverse) *
    glm::dvec3(jet.first[0].w, jet.first[1].w, jet.first[2].w) };
  return point;
}

bool isNearInReference(const FieldPoint& point)
{
  constexpr double near = 1e-3; // of the element
  const glm::dvec3 slope = glm::transpose(point.map.jacobian) * point.gradient.xyz;
  return std::abs(point.value) <= near * glm::length(slope);
}

glm::dmat3 worldHessian(const Jet& jet, const FieldPoint& point)
{
  return pulled(hessianOf(jet.second), jet.second, point.map, point.gradient);
}

LevelSet faceLevels(const Jet& jet, const LocalMap& map, const Face& face)
{
  const WorldVector gradient{ glm::transpose(map.inverse) * face.inward.xyz };
  return { gradient, pulled(glm::dmat3(0.0), jet.second, map, gradient) };
}

WorldVector bendOfCrossing(const LevelSet& a, const LevelSet& b)
{
  constexpr double parallel = 1e-6;
  const double lengthA = length(a.gradient);
  const double lengthB = length(b.gradient);
  const glm::dvec3 normalA = a.gradient.xyz / lengthA;
  const glm::dvec3 normalB = b.gradient.xyz / lengthB;
  const glm::dvec3 along = glm::cross(normalA, normalB);
  const double sine = glm::length(along);
  if (!(sine > parallel))
  {
    return {};
  }
  // Along the curve both functions stay what they are, to second order.
  const glm::dvec3 tangent = along / sine;
  const double bendA = -glm::dot(tangent, a.hessian * tangent) / lengthA;
  const double bendB = -glm::dot(tangent, b.hessian * tangent) / lengthB;
  const double cosine = glm::dot(normalA, normalB);
  return { ((bendA - cosine * bendB) * normalA + (bendB - cosine * bendA) * normalB) /
    (sine * sine) };
}

Curvature curvature(const WorldVector& gradient, const glm::dmat3& hessian)
{
  const double slope = length(gradient);
  if (!(slope > 0.0))
  {
    return {};
  }
  const glm::dvec3 n = gradient.xyz / slope;
  const glm::dmat3 projector = glm::dmat3(1.0) - glm::outerProduct(n, n);
  const glm::dmat3 g = projector * hessian * projector / slope;
  const double trace = g[0][0] + g[1][1] + g[2][2];
  const double frobenius2 = glm::dot(g[0], g[0]) + glm::dot(g[1], g[1]) + glm::dot(g[2], g[2]);
  // trace and frobenius2 are k1 + k2 and k1^2 + k2^2 for the normal +grad F; the mean curvature
  // changes its sign with the normal.
  return { -0.5 * trace, 0.5 * (trace * trace - frobenius2), std::sqrt(frobenius2), -1.0 * g };
}

WorldVector surfaceNormal(const WorldVector& gradient)
{
  const double slope = length(gradient);
  return slope > 0.0 ? (-1.0 / slope) * gradient : WorldVector{};
}

} // namespace hop
