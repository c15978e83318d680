#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace hop
{

/// The two spaces of the method. A finite element maps its *reference* domain (coordinates u, where
/// its polynomials live) to *world* space (coordinates x, where the user looks at it). Their points
/// and vectors are different types, so that mixing them does not compile.
struct WorldSpace;
struct ReferenceSpace;

template <class Space>
struct Vector
{
  glm::dvec3 xyz{ 0.0 };
};

template <class Space>
struct Point
{
  glm::dvec3 xyz{ 0.0 };
};

using WorldPoint = Point<WorldSpace>;
using WorldVector = Vector<WorldSpace>;
using ReferencePoint = Point<ReferenceSpace>;
using ReferenceVector = Vector<ReferenceSpace>;

template <class Space>
Vector<Space> operator-(const Point<Space>& a, const Point<Space>& b)
{
  return { a.xyz - b.xyz };
}

template <class Space>
Point<Space> operator+(const Point<Space>& a, const Vector<Space>& b)
{
  return { a.xyz + b.xyz };
}

template <class Space>
Vector<Space> operator+(const Vector<Space>& a, const Vector<Space>& b)
{
  return { a.xyz + b.xyz };
}

template <class Space>
Vector<Space> operator-(const Vector<Space>& a, const Vector<Space>& b)
{
  return { a.xyz - b.xyz };
}

template <class Space>
Vector<Space> operator-(const Vector<Space>& a)
{
  return { -a.xyz };
}

template <class Space>
Vector<Space> operator*(double s, const Vector<Space>& a)
{
  return { s * a.xyz };
}

template <class Space>
double dot(const Vector<Space>& a, const Vector<Space>& b)
{
  return glm::dot(a.xyz, b.xyz);
}

template <class Space>
double length(const Vector<Space>& a)
{
  return glm::length(a.xyz);
}

/// Radians, 0 to pi; zero if one of the vectors is zero.
template <class Space>
double angleBetween(const Vector<Space>& a, const Vector<Space>& b)
{
  return std::atan2(glm::length(glm::cross(a.xyz, b.xyz)), glm::dot(a.xyz, b.xyz));
}

} // namespace hop
