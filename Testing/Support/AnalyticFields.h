#pragma once

#include "Surface/SurfaceGeometry.h"
#include "TestMeshes.h"

namespace hop::testing
{

/// A surface known in closed form: {field = 0}, with positive values inside. All fields here are
/// polynomials of x, so that straight elements of their degree hold them exactly.
struct KnownSurface
{
  Field field;
  /// Degree of the field.
  int degree = 2;
  double area = 0.0;
  /// Unit normal from positive to negative values, at a point of the surface.
  Map normal;
  /// At a point of the surface, for that normal.
  std::function<Curvature(const glm::dvec3&)> curvature;
};

/// Area 4 pi r^2, both principal curvatures 1/r.
KnownSurface sphere(const glm::dvec3& center, double radius);

/// Around the z axis: (|x|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + y^2). Area 4 pi^2 R r; at the angle v of
/// the tube the principal curvatures are 1/r and cos v / (R + r cos v).
KnownSurface torus(double majorRadius, double minorRadius);

/// Around the z axis; its area is that between z = -1 and z = 1.
KnownSurface cylinder(double radius);

/// x^2/a^2 + y^2/b^2 + z^2/b^2 = 1 with a > b: most bent at its two tips.
KnownSurface prolateEllipsoid(double longAxis, double shortAxis);

/// {normal . x = offset}, normal a unit vector; without area, as it depends on the domain.
KnownSurface plane(const glm::dvec3& normal, double offset);

/// Positive inside either of two surfaces that do not meet. Without normal and curvature.
KnownSurface bothOf(const KnownSurface& a, const KnownSurface& b);

/// The paper's algebraic surfaces, scaled to the cube [-1,1]^3; without area, normal and curvature.
///  - a rounded cube, x^4 + y^4 + z^4 = 0.7^4;
///  - the tangle cube, x^4 - 5 x^2 + y^4 - 5 y^2 + z^4 - 5 z^2 + 11.8 = 0 for |x|, |y|, |z| <= 3;
///  - the octic T_8(x) + T_8(y) + T_8(z) = -2.5 of Chebyshev polynomials: 64 blobs.
KnownSurface quartic();
KnownSurface tangleCube();
KnownSurface octic();

/// sin x cos y + sin y cos z + sin z cos x, scaled to `periods` over [-1,1]: no polynomial.
Field gyroid(double periods);

} // namespace hop::testing
