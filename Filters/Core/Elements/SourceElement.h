#pragma once

#include "Elements/BernsteinProduct.h"

#include <array>
#include <vector>

namespace hop
{

/// An element whose field has components, from whose derivatives another field is made.
struct SourceElement
{
  Domain domain = Domain::Hexahedron;
  Degrees degrees{ 1, 1, 1 };
  /// 3 + number of the field's components.
  int width = 4;
  /// coefficientCount x width values: (x, y, z, u...), homogeneous if rational.
  const std::vector<double>& control;
  /// coefficientCount weights; not read unless the element is rational.
  const std::vector<double>& weights;
  bool isRational = false;
  /// Largest error of the coordinates, in their unit. A Jacobian that is of lower degree up to this error is taken to be
  /// of lower degree: cells with straight edges keep small polynomials although their nodes are rounded.
  double coordinateError = 0.0;
};

/// The `width` components, as polynomials.
std::vector<ScaledPolynomial> componentsOf(const SourceElement& source);

/// The weight w; the constant 1 where the element is not rational.
ScaledPolynomial weightOf(const SourceElement& source);

/// Of each component p along each coordinate w p' - p w', which is p' where w = 1: with X' and U' of coordinates and field
/// du/dx = U' X'^-1, as the powers of w cancel. So do factors that a collapsed face gives all components, which are
/// taken out (see CollapsedFaces.h).
std::array<std::vector<ScaledPolynomial>, 3> homogeneousDerivatives(const SourceElement& source);

} // namespace hop
