#include "Elements/SourceElement.h"

#include "Elements/CollapsedFaces.h"
#include "Elements/LowerDegrees.h"

#include <utility>

namespace hop
{

namespace
{

/// w p' - p w'; the derivative p' where the weight is constant.
ScaledPolynomial homogeneousDerivative(
  const ScaledPolynomial& p, const ScaledPolynomial& weight, int axis)
{
  if (weight.values.size() == 1)
  {
    return derivative(p, axis);
  }
  const ScaledPolynomial plus = weight * derivative(p, axis);
  const ScaledPolynomial minus = p * derivative(weight, axis);
  return sumOf({ { 1.0, &plus }, { -1.0, &minus } });
}

} // namespace

std::vector<ScaledPolynomial> componentsOf(const SourceElement& source)
{
  std::vector<ScaledPolynomial> components;
  for (int c = 0; c < source.width; ++c)
  {
    std::vector<double> values;
    for (std::size_t i = c; i < source.control.size(); i += source.width)
    {
      values.push_back(source.control[i]);
    }
    components.push_back(scaled(source.domain, source.degrees, std::move(values)));
  }
  return components;
}

ScaledPolynomial weightOf(const SourceElement& source)
{
  return source.isRational ? scaled(source.domain, source.degrees, source.weights)
                           : ScaledPolynomial{ source.domain, { 0, 0, 0 }, { 1.0 } };
}

std::array<std::vector<ScaledPolynomial>, 3> homogeneousDerivatives(const SourceElement& source)
{
  const std::vector<ScaledPolynomial> components = componentsOf(source);
  const ScaledPolynomial weight = weightOf(source);
  std::array<std::vector<ScaledPolynomial>, 3> result;
  for (int k = 0; k < 3; ++k)
  {
    for (const ScaledPolynomial& component : components)
    {
      result[k].push_back(homogeneousDerivative(component, weight, k));
    }
  }
  if (hasCollapsedEdge(source))
  {
    divideByCommonFactors(source, result);
  }
  return result;
}

} // namespace hop
