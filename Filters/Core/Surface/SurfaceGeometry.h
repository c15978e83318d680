#pragma once

#include "Elements/ElementMesh.h"

namespace hop
{

/// The map from reference to world space at one point: x = T(u).
struct LocalMap
{
  WorldPoint position;
  /// J_ia = dx_i/du_a; column a is dx/du_a.
  glm::dmat3 jacobian{ 1.0 };
  /// K = J^-1; zero where the element is singular.
  glm::dmat3 inverse{ 1.0 };
  bool singular = false;

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
  /// Half the sum of the principal curvatures with respect to the normal -grad F: positive where
  /// the surface bends away from that normal, 1/r on a sphere of radius r with high values inside.
  double mean = 0.0;
  double gauss = 0.0;
  /// The paper's D = sqrt(k1^2 + k2^2).
  double magnitude = 0.0;
  /// Shape operator dn/dx of that normal, symmetric: how the normal turns along the surface.
  glm::dmat3 shape{ 0.0 };
};

FieldPoint fieldPoint(const Jet& jet, double isovalue);

/// Whether the field is near the isovalue in reference space too, to a thousandth of the element by its
/// slope there. Where an element folds over (det J = 0) the world gradient is infinite, and any residual
/// over it small.
bool isNearInReference(const FieldPoint& point);

/// F_xx = K^T (F*_uu - sum_i (F_x)_i d2x_i/du2) K. The paper's eqs. (17), (18) are misprinted; this
/// form follows from differentiating F*(u) = F(x(u)) twice.
glm::dmat3 worldHessian(const Jet& jet, const FieldPoint& point);

/// A function of world space near a place.
struct LevelSet
{
  WorldVector gradient;
  glm::dmat3 hessian{ 0.0 };
};

/// Of faceMargin() of a face, which is linear in reference space.
/// \param jet with second derivatives; that of the field does not matter
LevelSet faceLevels(const Jet& jet, const LocalMap& map, const Face& face);

/// How the curve in which two level sets cross bends: its second derivative by arc length, 1/r on a circle of
/// radius r, towards the middle. Zero where they touch.
WorldVector bendOfCrossing(const LevelSet& a, const LevelSet& b);

/// G = P F_xx P / |F_x| with P = I - n n^T (Kindlmann et al. 2003): trace, Frobenius norm and the
/// principal curvatures without an eigenvalue problem.
Curvature curvature(const WorldVector& gradient, const glm::dmat3& hessian);

/// Unit normal -grad F/|grad F|, as Contour orients it: from high values to low ones. Zero where
/// the gradient vanishes.
WorldVector surfaceNormal(const WorldVector& gradient);

} // namespace hop
