#pragma once

#include "Elements/SampledField.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace hop
{

/// What a formula is told of an element: the ranges in which x, and value and gradient of each component, stay.
struct FieldBounds
{
  std::array<Range, 3> x;
  std::vector<Range> values;
  /// Of du_i/dx_j: three a component.
  std::vector<std::array<Range, 3>> gradients;
};

/// A part of a formula: how many numbers it has, what they are at a point, and between which bounds they stay.
struct ExpressionTerm
{
  static constexpr int ScalarSize = 1;
  static constexpr int VectorSize = 3;
  /// Row by row.
  static constexpr int TensorSize = 9;
  using Value = std::array<double, TensorSize>;
  using Bounds = std::array<Range, TensorSize>;

  int size = ScalarSize;
  std::function<Value(const FieldPoint&)> at;
  /// Holds all values, widened by what rounding can make of them; infinite where some of them are not finite or not known.
  std::function<Bounds(const FieldBounds&)> within;
};

enum class Operation
{
  Sum,
  Difference,
  Product,
  Quotient,
  Power,
  Least,
  Greatest
};

/// Of a formula's numbers, coordinates and arrays.
ExpressionTerm constantTerm(double value);
/// \param axis 0, 1 or 2
ExpressionTerm coordinateTerm(int axis);
ExpressionTerm coordinatesTerm();
/// \param first of the components in FieldPoint
/// \param components 1 or 3
ExpressionTerm valueTerm(int first, int components);
/// A vector; of a vector a tensor.
ExpressionTerm gradientTerm(int first, int components);
ExpressionTerm curlTerm(int first);
/// \param quantity of three components; as in functionOf()
ExpressionTerm quantityTerm(Quantity quantity, int first);

/// Number by number; a scalar goes with every number of the other.
/// \pre sizes are the same, or one of them is that of a scalar
ExpressionTerm combined(Operation operation, const ExpressionTerm& a, const ExpressionTerm& b);
/// The square root of the sum of all squares.
ExpressionTerm lengthOf(const ExpressionTerm& a);
/// \pre both are vectors
ExpressionTerm dotOf(const ExpressionTerm& a, const ExpressionTerm& b);
ExpressionTerm crossOf(const ExpressionTerm& a, const ExpressionTerm& b);

/// Names of the functions of one scalar, in alphabetical order.
std::vector<std::string> scalarFunctionNames();
/// \param name one of scalarFunctionNames()
/// \pre the term is a scalar
ExpressionTerm functionTerm(const std::string& name, const ExpressionTerm& a);

} // namespace hop
