#pragma once

#include "Elements/ExpressionTerm.h"

#include <string>
#include <vector>

namespace hop
{

/// An array that an expression may name.
struct NamedArray
{
  std::string name;
  int components = 1;
};

/// A field made of arrays by a formula in the grammar of ParaView's calculator: numbers, + - * / ^, parentheses,
/// functions, names of arrays ("quoted" where they hold other characters than letters, digits, _ and .) and of their components (`u_X`
/// to `u_Z`, or `u_0`, `u_1`, ...), `coordsX` to `coordsZ` and `coords`; and of arrays gradient(), curl(), divergence(), q_criterion() and
/// lambda2(). Several threads may evaluate one expression.
class FieldExpression
{
public:
  /// \param arrays that there are
  /// \throw std::invalid_argument with what is wrong, for the user
  FieldExpression(const std::string& text, const std::vector<NamedArray>& arrays);

  /// The arrays that the formula names, in the order in which their components stand in FieldPoint.
  const std::vector<NamedArray>& arrays() const { return this->Used; }

  double operator()(const FieldPoint& at) const { return this->Function(at); }

  /// Holds all values of the formula in an element; infinite where some of them are not finite or not known.
  Range bounds(const FieldBounds& in) const { return this->Bounds(in); }

private:
  std::vector<NamedArray> Used;
  FieldFunction Function;
  std::function<Range(const FieldBounds&)> Bounds;
};

} // namespace hop
