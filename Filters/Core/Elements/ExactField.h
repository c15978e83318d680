#pragma once

#include "Elements/Bernstein.h"
#include "Elements/Quantity.h"
#include "Elements/ReferencePart.h"
#include "Elements/SourceElement.h"

#include <cstddef>
#include <vector>

namespace hop
{

/// Components that an exact field can be derived from.
constexpr int MostExactComponents = 3;

/// Place and quantity at the points of a part of a cell, from the cell's own polynomials and the chain rule: no quotient
/// of products of polynomials costs as little, and where lambda 2 has a crease no polynomial holds it. The field is the
/// quantity, or its square where that is derived, times `scale`.
struct ExactField
{
  Quantity quantity = Quantity::QCriterion;
  /// Of the field that is derived from: MostExactComponents at most.
  int components = 3;
  /// Of the cell.
  Degrees degrees{};
  /// Of the derivatives of place and field along each coordinate of the cell.
  std::array<Degrees, 3> ofDerivatives{};
  /// The part of the cell.
  ReferencePart part;
  double scale = 1.0;
  /// Index of the first of coefficientCount(), wherever they are kept: the cell's own (X, Y, Z, w), w the weight or 1; then
  /// for each coordinate those of the derivatives of (x, y, z, u_0) and, if there are more, (u_1, u_2, 0, 0), homogeneous if rational.
  std::size_t firstCoefficient = 0;
};

/// Coefficients of a field.
std::size_t coefficientCount(Domain domain, const ExactField& field);

/// A field with its coefficients, of which the first is its own.
struct ExactSource
{
  ExactField field;
  std::vector<Coefficient> coefficients;
};

/// \param source of a field of MostExactComponents at most
/// \param quantity neither Value nor Expression
/// \return of the whole cell
ExactSource exactSource(const SourceElement& source, Quantity quantity);

/// Place and field with first derivatives along the coordinates of the part.
/// \param coefficients the field's own
/// \pre the cell's Jacobian determinant is not zero there
Jet exactGradient(
  Domain domain, const ExactField& field, const Coefficient* coefficients, const ReferencePoint& u);

/// The same with second derivatives.
Jet exactHessian(
  Domain domain, const ExactField& field, const Coefficient* coefficients, const ReferencePoint& u);

} // namespace hop
