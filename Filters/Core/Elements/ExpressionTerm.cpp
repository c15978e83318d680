#include "Elements/ExpressionTerm.h"

#include "Elements/DerivativeBounds.h"
#include "Elements/DerivedField.h"
#include "Elements/RangeArithmetic.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>

namespace hop
{

namespace
{

using Value = ExpressionTerm::Value;
using Bounds = ExpressionTerm::Bounds;

constexpr int ScalarSize = ExpressionTerm::ScalarSize;
constexpr int VectorSize = ExpressionTerm::VectorSize;

Value scalar(double number)
{
  return { number };
}

Value vector(const glm::dvec3& v)
{
  return { v.x, v.y, v.z };
}

glm::dvec3 vectorOf(const Value& value)
{
  return { value[0], value[1], value[2] };
}

std::vector<glm::dvec3> rowsAt(const FieldPoint& at, int first)
{
  return { &at.gradients[first], &at.gradients[first] + VectorSize };
}

double sign(double x)
{
  return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}

/// How a function of one scalar runs, for bounds.
enum class Course
{
  Rising,
  Falling,
  /// Of the absolute value it rises.
  Even,
  /// Between -1 and 1; more is not made use of.
  Wave,
  Unknown
};

struct ScalarFunction
{
  double (*value)(double) = nullptr;
  Course course = Course::Rising;
  /// Where it is defined.
  Range domain = everything;
};

const std::map<std::string, ScalarFunction>& scalarFunctions()
{
  constexpr Range unit{ -1.0, 1.0 };
  constexpr Range positive{ 0.0, everything.upper };
  static const std::map<std::string, ScalarFunction> functions{
    { "abs", { std::fabs, Course::Even, everything } },
    { "acos", { std::acos, Course::Falling, unit } },
    { "asin", { std::asin, Course::Rising, unit } },
    { "atan", { std::atan, Course::Rising, everything } },
    { "ceil", { std::ceil, Course::Rising, everything } },
    { "cos", { std::cos, Course::Wave, everything } },
    { "cosh", { std::cosh, Course::Even, everything } },
    { "exp", { std::exp, Course::Rising, everything } },
    { "floor", { std::floor, Course::Rising, everything } },
    { "ln", { std::log, Course::Rising, positive } },
    { "log", { std::log, Course::Rising, positive } },
    { "log10", { std::log10, Course::Rising, positive } },
    { "sign", { sign, Course::Rising, everything } },
    { "sin", { std::sin, Course::Wave, everything } },
    { "sinh", { std::sinh, Course::Rising, everything } },
    { "sqrt", { std::sqrt, Course::Rising, positive } },
    { "tan", { std::tan, Course::Unknown, everything } },
    { "tanh", { std::tanh, Course::Rising, everything } }
  };
  return functions;
}

/// Widened by many times what rounding adds in one operation on numbers of a size; everything where it is not finite.
Range widened(const Range& range, double size)
{
  constexpr double rounding = 1e-14;
  const double slack = rounding * std::max(size, range.magnitude());
  return knownOr({ range.lower - slack, range.upper + slack });
}

Range boundsOf(const ScalarFunction& function, const Range& a)
{
  if (!(a.lower >= function.domain.lower && a.upper <= function.domain.upper))
  {
    return everything;
  }
  switch (function.course)
  {
    case Course::Rising:
      return widened({ function.value(a.lower), function.value(a.upper) }, 0.0);
    case Course::Falling:
      return widened({ function.value(a.upper), function.value(a.lower) }, 0.0);
    case Course::Even:
    {
      const bool holdsZero = a.lower <= 0.0 && a.upper >= 0.0;
      const double least = holdsZero ? 0.0 : std::min(std::abs(a.lower), std::abs(a.upper));
      return widened({ function.value(least), function.value(a.magnitude()) }, 0.0);
    }
    case Course::Wave:
      return { -1.0, 1.0 };
    case Course::Unknown:
      break;
  }
  return everything;
}

/// Of positive bases, and of constant whole exponents.
Range powerOf(const Range& base, const Range& exponent)
{
  if (base.lower > 0.0)
  {
    const auto [lower, upper] =
      std::minmax({ std::pow(base.lower, exponent.lower), std::pow(base.lower, exponent.upper),
        std::pow(base.upper, exponent.lower), std::pow(base.upper, exponent.upper) });
    return { lower, upper };
  }
  const double n = exponent.lower;
  if (exponent.upper != n || n != std::floor(n) || n < 0.0)
  {
    return everything;
  }
  const bool isEven = std::fmod(n, 2.0) == 0.0;
  const double ends[2]{ std::pow(base.lower, n), std::pow(base.upper, n) };
  const Range range{ std::min(ends[0], ends[1]), std::max(ends[0], ends[1]) };
  return isEven && base.upper >= 0.0 ? Range{ 0.0, range.upper } : range;
}

double valueOf(Operation operation, double a, double b)
{
  switch (operation)
  {
    case Operation::Sum:
      return a + b;
    case Operation::Difference:
      return a - b;
    case Operation::Product:
      return a * b;
    case Operation::Quotient:
      return a / b;
    case Operation::Power:
      return std::pow(a, b);
    case Operation::Least:
      return std::min(a, b);
    case Operation::Greatest:
      break;
  }
  return std::max(a, b);
}

Range boundsOf(Operation operation, const Range& a, const Range& b)
{
  const double size = std::max(a.magnitude(), b.magnitude());
  if (!(size < everything.upper))
  {
    return everything;
  }
  switch (operation)
  {
    case Operation::Sum:
      return widened(sum(a, b), size);
    case Operation::Difference:
      return widened(sum(a, scaledBy(-1.0, b)), size);
    case Operation::Product:
      return widened(product(a, b), 0.0);
    case Operation::Quotient:
      return widened(quotient(a, b), 0.0);
    case Operation::Power:
      return widened(powerOf(a, b), 0.0);
    case Operation::Least:
      return { std::min(a.lower, b.lower), std::min(a.upper, b.upper) };
    case Operation::Greatest:
      break;
  }
  return { std::max(a.lower, b.lower), std::max(a.upper, b.upper) };
}

} // namespace

ExpressionTerm constantTerm(double value)
{
  return { ScalarSize, [value](const FieldPoint&) { return scalar(value); },
    [value](const FieldBounds&) {
      return Bounds{ Range{ value, value } };
    } };
}

ExpressionTerm coordinateTerm(int axis)
{
  return { ScalarSize, [axis](const FieldPoint& at) { return scalar(at.x[axis]); },
    [axis](const FieldBounds& in) { return Bounds{ widened(in.x[axis], 0.0) }; } };
}

ExpressionTerm coordinatesTerm()
{
  return { VectorSize, [](const FieldPoint& at) { return vector(at.x); },
    [](const FieldBounds& in)
    {
      Bounds result{};
      std::transform(in.x.begin(), in.x.end(), result.begin(),
        [](const Range& range) { return widened(range, 0.0); });
      return result;
    } };
}

ExpressionTerm valueTerm(int first, int components)
{
  return { components,
    [=](const FieldPoint& at)
    {
      Value result{};
      std::copy_n(at.values.begin() + first, components, result.begin());
      return result;
    },
    [=](const FieldBounds& in)
    {
      Bounds result{};
      std::transform(in.values.begin() + first, in.values.begin() + first + components,
        result.begin(), [](const Range& range) { return widened(range, 0.0); });
      return result;
    } };
}

ExpressionTerm gradientTerm(int first, int components)
{
  const int size = 3 * components;
  return { size,
    [=](const FieldPoint& at)
    {
      Value result{};
      for (int i = 0; i < size; ++i)
      {
        result[i] = at.gradients[first + i / 3][i % 3];
      }
      return result;
    },
    [=](const FieldBounds& in)
    {
      Bounds result{};
      for (int i = 0; i < size; ++i)
      {
        result[i] = widened(in.gradients[first + i / 3][i % 3], 0.0);
      }
      return result;
    } };
}

ExpressionTerm curlTerm(int first)
{
  return { VectorSize,
    [first](const FieldPoint& at)
    {
      const std::vector<glm::dvec3> g = rowsAt(at, first);
      return Value{ g[2].y - g[1].z, g[0].z - g[2].x, g[1].x - g[0].y };
    },
    [first](const FieldBounds& in)
    {
      Bounds result{};
      for (int i = 0; i < VectorSize; ++i)
      {
        const int j = (i + 1) % VectorSize;
        const int k = (i + 2) % VectorSize;
        result[i] =
          boundsOf(Operation::Difference, in.gradients[first + k][j], in.gradients[first + j][k]);
      }
      return result;
    } };
}

ExpressionTerm quantityTerm(Quantity quantity, int first)
{
  return { ScalarSize,
    [first, function = functionOf(quantity)](const FieldPoint& at) {
      return scalar(function({ at.x, {}, rowsAt(at, first) }));
    },
    [=](const FieldBounds& in)
    {
      const std::vector<std::array<Range, 3>> rows(
        &in.gradients[first], &in.gradients[first] + VectorSize);
      const Range range = boundsFrom(quantity, rows);
      return Bounds{ widened(range, 0.0) };
    } };
}

ExpressionTerm combined(Operation operation, const ExpressionTerm& a, const ExpressionTerm& b)
{
  const int size = std::max(a.size, b.size);
  const int stepA = a.size == ScalarSize ? 0 : 1;
  const int stepB = b.size == ScalarSize ? 0 : 1;
  const auto eachComponent = [=](const auto& left, const auto& right, const auto& combine)
  {
    std::decay_t<decltype(left)> result{};
    for (int i = 0; i < size; ++i)
    {
      result[i] = combine(operation, left[stepA * i], right[stepB * i]);
    }
    return result;
  };
  const auto bounds = [](Operation which, const Range& left, const Range& right)
  { return boundsOf(which, left, right); };
  return { size, [=](const FieldPoint& at) { return eachComponent(a.at(at), b.at(at), valueOf); },
    [=](const FieldBounds& in) { return eachComponent(a.within(in), b.within(in), bounds); } };
}

ExpressionTerm lengthOf(const ExpressionTerm& a)
{
  return { ScalarSize,
    [a](const FieldPoint& at)
    {
      const Value v = a.at(at);
      double sum = 0.0;
      for (int i = 0; i < a.size; ++i)
      {
        sum += v[i] * v[i];
      }
      return scalar(std::sqrt(sum));
    },
    [a](const FieldBounds& in)
    {
      const Bounds v = a.within(in);
      Range all;
      for (int i = 0; i < a.size; ++i)
      {
        all = sum(all, square(v[i]));
      }
      return Bounds{ widened({ std::sqrt(all.lower), std::sqrt(all.upper) }, 0.0) };
    } };
}

ExpressionTerm dotOf(const ExpressionTerm& a, const ExpressionTerm& b)
{
  return { ScalarSize,
    [=](const FieldPoint& at) { return scalar(glm::dot(vectorOf(a.at(at)), vectorOf(b.at(at)))); },
    [=](const FieldBounds& in)
    {
      const Bounds u = a.within(in);
      const Bounds v = b.within(in);
      Range all = boundsOf(Operation::Product, u[0], v[0]);
      for (int i = 1; i < VectorSize; ++i)
      {
        all = boundsOf(Operation::Sum, all, boundsOf(Operation::Product, u[i], v[i]));
      }
      return Bounds{ all };
    } };
}

ExpressionTerm crossOf(const ExpressionTerm& a, const ExpressionTerm& b)
{
  return { VectorSize,
    [=](const FieldPoint& at)
    { return vector(glm::cross(vectorOf(a.at(at)), vectorOf(b.at(at)))); },
    [=](const FieldBounds& in)
    {
      const Bounds u = a.within(in);
      const Bounds v = b.within(in);
      Bounds result{};
      for (int i = 0; i < VectorSize; ++i)
      {
        const int j = (i + 1) % VectorSize;
        const int k = (i + 2) % VectorSize;
        result[i] = boundsOf(Operation::Difference, boundsOf(Operation::Product, u[j], v[k]),
          boundsOf(Operation::Product, u[k], v[j]));
      }
      return result;
    } };
}

std::vector<std::string> scalarFunctionNames()
{
  std::vector<std::string> names;
  for (const auto& [name, function] : scalarFunctions())
  {
    names.push_back(name);
  }
  return names;
}

ExpressionTerm functionTerm(const std::string& name, const ExpressionTerm& a)
{
  const ScalarFunction& function = scalarFunctions().at(name);
  return { ScalarSize,
    [a, use = function.value](const FieldPoint& at) { return scalar(use(a.at(at)[0])); },
    [a, function](const FieldBounds& in)
    { return Bounds{ boundsOf(function, a.within(in)[0]) }; } };
}

} // namespace hop
