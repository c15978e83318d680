#pragma once

#include "Elements/SampledField.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace hop
{

/// A part of a formula: how many numbers it has, and what they are at a point.
struct ExpressionTerm
{
  static constexpr int ScalarSize = 1;
  static constexpr int VectorSize = 3;
  /// Row by row.
  static constexpr int TensorSize = 9;
  using Value = std::array<double, TensorSize>;

  int size = ScalarSize;
  std::function<Value(const FieldPoint&)> at;
};

/// A function of two numbers.
using NumberOfTwo = double (*)(double, double);

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

/// use(a, b), number by number; a scalar goes with every number of the other.
/// \pre sizes are the same, or one of them is that of a scalar
ExpressionTerm combined(const ExpressionTerm& a, const ExpressionTerm& b, NumberOfTwo use);
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
