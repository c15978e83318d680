#pragma once

#include "Elements/Bernstein.h"
#include "Elements/ReferencePart.h"
#include "Elements/SourceElement.h"

#include <cstddef>
#include <vector>

namespace hop
{

/// Lambda 2 at the points of a part of a cell, from the cell's own polynomials: where two eigenvalues are equal it has a
/// crease, which no polynomial holds. The field is the middle eigenvalue of S^2 + W^2 times `scale`.
struct LambdaTwoField
{
  /// Of the derivatives of (x, y, z, u, v, w) along each coordinate of the cell.
  std::array<Degrees, 3> degrees{};
  /// The part of the cell.
  ReferencePart part;
  double scale = 1.0;
  /// Index of the first of derivativeCount() coefficients, wherever they are kept: for each coordinate first those of the
  /// derivatives of (x, y, z, u), then those of (v, w, 0, 0).
  std::size_t firstDerivative = 0;
};

/// Coefficients of a field.
std::size_t derivativeCount(Domain domain, const LambdaTwoField& field);

/// A field with its coefficients, of which the first is its own.
struct LambdaTwoSource
{
  LambdaTwoField field;
  std::vector<Coefficient> derivatives;
};

/// \param source of a vector field
LambdaTwoSource lambdaTwoSource(const SourceElement& source, const ReferencePart& part);

/// Writes the field with its first and second derivatives along the coordinates of the part into jet.w. All of them are
/// finite: where two eigenvalues are equal, derivatives are those of one of the two sides of the crease.
/// \param derivatives the field's own
/// \pre the cell's Jacobian determinant is not zero there
void evaluateLambdaTwo(Domain domain, const LambdaTwoField& field, const Coefficient* derivatives,
  const ReferencePoint& u, Jet& jet);

} // namespace hop
