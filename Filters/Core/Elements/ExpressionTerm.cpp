#include "Elements/ExpressionTerm.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace hop
{

namespace
{

using Value = ExpressionTerm::Value;

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

using OfOne = double (*)(double);

const std::map<std::string, OfOne>& scalarFunctions()
{
  static const std::map<std::string, OfOne> functions{ { "abs", std::fabs }, { "acos", std::acos },
    { "asin", std::asin }, { "atan", std::atan }, { "ceil", std::ceil }, { "cos", std::cos },
    { "cosh", std::cosh }, { "exp", std::exp }, { "floor", std::floor }, { "ln", std::log },
    { "log", std::log }, { "log10", std::log10 }, { "sign", sign }, { "sin", std::sin },
    { "sinh", std::sinh }, { "sqrt", std::sqrt }, { "tan", std::tan }, { "tanh", std::tanh } };
  return functions;
}

} // namespace

ExpressionTerm constantTerm(double value)
{
  return { ScalarSize, [value](const FieldPoint&) { return scalar(value); } };
}

ExpressionTerm coordinateTerm(int axis)
{
  return { ScalarSize, [axis](const FieldPoint& at) { return scalar(at.x[axis]); } };
}

ExpressionTerm coordinatesTerm()
{
  return { VectorSize, [](const FieldPoint& at) { return vector(at.x); } };
}

ExpressionTerm valueTerm(int first, int components)
{
  return { components,
    [=](const FieldPoint& at)
    {
      Value result{};
      std::copy_n(at.values.begin() + first, components, result.begin());
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
    } };
}

ExpressionTerm curlTerm(int first)
{
  return { VectorSize,
    [first](const FieldPoint& at)
    {
      const std::vector<glm::dvec3> g = rowsAt(at, first);
      return Value{ g[2].y - g[1].z, g[0].z - g[2].x, g[1].x - g[0].y };
    } };
}

ExpressionTerm quantityTerm(Quantity quantity, int first)
{
  return { ScalarSize, [first, function = functionOf(quantity)](const FieldPoint& at) {
            return scalar(function({ at.x, {}, rowsAt(at, first) }));
          } };
}

ExpressionTerm combined(const ExpressionTerm& a, const ExpressionTerm& b, NumberOfTwo use)
{
  const int size = std::max(a.size, b.size);
  const int stepA = a.size == ScalarSize ? 0 : 1;
  const int stepB = b.size == ScalarSize ? 0 : 1;
  return { size,
    [=](const FieldPoint& at)
    {
      const Value left = a.at(at);
      const Value right = b.at(at);
      Value result{};
      for (int i = 0; i < size; ++i)
      {
        result[i] = use(left[stepA * i], right[stepB * i]);
      }
      return result;
    } };
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
    } };
}

ExpressionTerm dotOf(const ExpressionTerm& a, const ExpressionTerm& b)
{
  return { ScalarSize, [=](const FieldPoint& at) {
            return scalar(glm::dot(vectorOf(a.at(at)), vectorOf(b.at(at))));
          } };
}

ExpressionTerm crossOf(const ExpressionTerm& a, const ExpressionTerm& b)
{
  return { VectorSize, [=](const FieldPoint& at) {
            return vector(glm::cross(vectorOf(a.at(at)), vectorOf(b.at(at))));
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
  return { ScalarSize, [a, function = scalarFunctions().at(name)](const FieldPoint& at) {
            return scalar(function(a.at(at)[0]));
          } };
}

} // namespace hop
