#include "AnalyticFields.h"

#include "Surface/Energy.h"

#include <cmath>

namespace hop::testing
{
namespace
{

Curvature fromPrincipal(double k1, double k2)
{
  return { 0.5 * (k1 + k2), k1 * k2, std::hypot(k1, k2) };
}

} // namespace

KnownSurface sphere(const glm::dvec3& center, double radius)
{
  return { [=](const glm::dvec3& x) { return radius * radius - glm::dot(x - center, x - center); },
    2, 4.0 * Pi * radius * radius, [=](const glm::dvec3& x) { return (x - center) / radius; },
    [=](const glm::dvec3&) { return fromPrincipal(1.0 / radius, 1.0 / radius); } };
}

KnownSurface torus(double majorRadius, double minorRadius)
{
  const double R = majorRadius, r = minorRadius;
  const auto spine = [R](const glm::dvec3& x)
  { return R / std::hypot(x.x, x.y) * glm::dvec3(x.x, x.y, 0.0); };
  return { [=](const glm::dvec3& x)
    {
      const double s = glm::dot(x, x) + R * R - r * r;
      return 4.0 * R * R * (x.x * x.x + x.y * x.y) - s * s;
    },
    4, 4.0 * Pi * Pi * R * r, [=](const glm::dvec3& x) { return (x - spine(x)) / r; },
    [=](const glm::dvec3& x)
    {
      const double fromAxis = std::hypot(x.x, x.y);
      return fromPrincipal(1.0 / r, (fromAxis - R) / r / fromAxis);
    } };
}

KnownSurface cylinder(double radius)
{
  return { [=](const glm::dvec3& x) { return radius * radius - x.x * x.x - x.y * x.y; }, 2,
    4.0 * Pi * radius, [=](const glm::dvec3& x) { return glm::dvec3(x.x, x.y, 0.0) / radius; },
    [=](const glm::dvec3&) { return fromPrincipal(1.0 / radius, 0.0); } };
}

KnownSurface prolateEllipsoid(double longAxis, double shortAxis)
{
  const double a = longAxis, b = shortAxis, e = std::sqrt(1.0 - b * b / (a * a));
  const glm::dvec3 inverseSquares(1.0 / (a * a), 1.0 / (b * b), 1.0 / (b * b));
  return { [=](const glm::dvec3& x) { return 1.0 - glm::dot(inverseSquares, x * x); }, 2,
    2.0 * Pi * b * (b + a * std::asin(e) / e),
    [=](const glm::dvec3& x) { return glm::normalize(inverseSquares * x); },
    [=](const glm::dvec3& x)
    {
      // Along the meridian a b / m^3, around the axis 1 / (b m / a), m^2 = a^2 b^2 |x / axes^2|^2.
      const double m = a * b * glm::length(inverseSquares * x);
      return fromPrincipal(a * b / (m * m * m), a / (b * m));
    } };
}

KnownSurface plane(const glm::dvec3& normal, double offset)
{
  return { [=](const glm::dvec3& x) { return offset - glm::dot(normal, x); }, 1, 0.0,
    [=](const glm::dvec3&) { return normal; }, [](const glm::dvec3&) { return Curvature{}; } };
}

KnownSurface bothOf(const KnownSurface& a, const KnownSurface& b)
{
  KnownSurface both;
  both.field = [f = a.field, g = b.field](const glm::dvec3& x) { return -f(x) * g(x); };
  both.degree = a.degree + b.degree;
  both.area = a.area + b.area;
  return both;
}

KnownSurface quartic()
{
  constexpr double radius = 0.7;
  KnownSurface surface;
  surface.degree = 4;
  surface.field = [](const glm::dvec3& x)
  {
    const glm::dvec3 squares = x * x;
    return std::pow(radius, 4) - glm::dot(squares, squares);
  };
  return surface;
}

KnownSurface tangleCube()
{
  KnownSurface surface;
  surface.degree = 4;
  surface.field = [](const glm::dvec3& x)
  {
    const glm::dvec3 squares = 9.0 * x * x;
    return -glm::dot(squares, squares - 5.0) - 11.8;
  };
  return surface;
}

KnownSurface octic()
{
  KnownSurface surface;
  surface.degree = 8;
  surface.field = [](const glm::dvec3& x)
  {
    // T_8 = 2 T_4^2 - 1, and T_4 = 2 T_2^2 - 1.
    const glm::dvec3 t2 = 2.0 * x * x - 1.0;
    const glm::dvec3 t4 = 2.0 * t2 * t2 - 1.0;
    const glm::dvec3 t8 = 2.0 * t4 * t4 - 1.0;
    return -2.5 - (t8.x + t8.y + t8.z);
  };
  return surface;
}

Field gyroid(double periods)
{
  return [scale = Pi * periods](const glm::dvec3& x)
  {
    const glm::dvec3 s = glm::sin(scale * x), c = glm::cos(scale * x);
    return s.x * c.y + s.y * c.z + s.z * c.x;
  };
}

} // namespace hop::testing
