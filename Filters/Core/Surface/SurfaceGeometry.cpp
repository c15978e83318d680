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
  // Some 450 epsilons of doubles: a column shorter than this beside the others or beside the coordinates is rounding
  // errors. So is a determinant smaller than some 4,500 epsilons beside the product of the columns' lengths. Larger:
  // thin elements count as singular; smaller: normals and steps may be noise.
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

/// The Hessian in world space of a function: K^T (F*_uu - sum_i (F_x)_i d2x_i/du2) K.
/// \param hessian F*_uu, in reference space
/// \param second second derivatives of the map
/// \param gradient F_x, in world space
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
  // Reference coordinates. Larger: particles beside folds pass that are far from the surface; smaller: no step of
  // Newton's method ends beside a fold.
  constexpr double near = 1e-3;
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

WorldVector curvatureOfCrossing(const LevelSet& a, const LevelSet& b)
{
  // Sine of the angle between the level sets below which they are tangent: the vector is divided by its square.
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
  // Both functions are constant along the curve: their second derivatives by arc length vanish too.
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
  // The trace is for the normal +grad F; the mean curvature and the shape operator change their signs with the normal.
  return { -0.5 * trace, 0.5 * (trace * trace - frobenius2), std::sqrt(frobenius2), -1.0 * g };
}

WorldVector surfaceNormal(const WorldVector& gradient)
{
  const double slope = length(gradient);
  return slope > 0.0 ? (-1.0 / slope) * gradient : WorldVector{};
}

} // namespace hop
