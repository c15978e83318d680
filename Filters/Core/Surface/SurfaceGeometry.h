#pragma once

#include "Elements/ElementMesh.h"

#include <algorithm>
#include <cmath>

namespace hop
{

/// The geometry of the isosurface in world space from derivatives in reference space. See Documentation/algorithm.md,
/// section Geometry in world space.

/// The map from reference to world space at one point: x = T(u).
struct LocalMap
{
  /// x.
  WorldPoint position;
  /// J_ia = dx_i/du_a; column a is dx/du_a.
  glm::dmat3 jacobian{ 1.0 };
  /// K = J^-1; zero where the element is singular.
  glm::dmat3 inverse{ 1.0 };
  /// Whether J cannot be inverted: it is zero, or rounding errors decide about its determinant.
  bool singular = false;

  /// K v and J v.
  ReferenceVector pull(const WorldVector& v) const { return { this->inverse * v.xyz }; }
  WorldVector push(const ReferenceVector& v) const { return { this->jacobian * v.xyz }; }
};

/// The field's first-order behaviour in world space at a place.
struct FieldPoint
{
  LocalMap map;
  /// F - isovalue.
  double value = 0.0;
  /// dF/dx = K^T dF*/du (Meyer et al. 2007, eq. 19).
  WorldVector gradient;
};

/// Curvature of the isosurface through a point, from the world Hessian.
struct Curvature
{
  /// (k1 + k2)/2 for the principal curvatures with respect to the normal -grad F: positive where
  /// the surface bends away from that normal, 1/r on a sphere of radius r with high values inside.
  double mean = 0.0;
  /// k1 k2.
  double gauss = 0.0;
  /// The paper's D = sqrt(k1^2 + k2^2).
  double magnitude = 0.0;
  /// The shape operator dn/dx of the normal n = -grad F/|grad F|, symmetric: how the normal turns along the surface.
  glm::dmat3 shape{ 0.0 };

  /// The larger one of |k1| and |k2|.
  double largest() const
  {
    const double gap = std::max(0.0, this->mean * this->mean - this->gauss);
    return std::abs(this->mean) + std::sqrt(gap);
  }
};

/// \param jet with first derivatives at least
FieldPoint fieldPoint(const Jet& jet, double isovalue);

/// Whether the surface is near in reference space too: |F - c| over the field's slope in reference space is below a
/// thousandth of the element. Where an element folds over (det J = 0) the world gradient is infinite, so that a small
/// ratio |F - c|/|grad F| proves nothing.
bool isNearInReference(const FieldPoint& point);

/// F_xx = K^T (F*_uu - sum_i (F_x)_i d2x_i/du2) K, from differentiating F*(u) = F(x(u)) twice: Meyer et al. 2007,
/// eq. (20). The index forms there, eqs. (17) and (18), are misprinted.
/// \param jet with second derivatives
glm::dmat3 worldHessian(const Jet& jet, const FieldPoint& point);

/// Derivatives at a place of a function in world space, whose level set is a surface.
struct LevelSet
{
  WorldVector gradient;
  glm::dmat3 hessian{ 0.0 };
};

/// The derivatives of faceMargin() of a face, which is linear in reference space.
/// \param jet with second derivatives; only its geometry counts, not its field
LevelSet faceLevels(const Jet& jet, const LocalMap& map, const Face& face);

/// Curvature vector of the curve in which two level sets cross, its second derivative by arc length: on a circle of
/// radius r it points to the centre and has the length 1/r. Zero where the level sets are tangent to each other.
WorldVector curvatureOfCrossing(const LevelSet& a, const LevelSet& b);

/// From G = P F_xx P / |F_x| with P = I - n n^T (Kindlmann et al. 2003): its trace is k1 + k2 for the normal
/// n = +grad F/|grad F|, its Frobenius norm sqrt(k1^2 + k2^2), so that no eigenvalue problem is solved.
Curvature curvature(const WorldVector& gradient, const glm::dmat3& hessian);

/// Unit normal -grad F/|grad F|, from high values to low ones as VTK's Contour orients it. Zero where the gradient
/// vanishes.
WorldVector surfaceNormal(const WorldVector& gradient);

} // namespace hop
