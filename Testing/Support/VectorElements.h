#pragma once

#include "ElementCases.h"
#include "Elements/SampledField.h"
#include "Elements/SourceElement.h"

namespace hop::testing
{

/// Position, values and gradients of a vector field on an element, one component after the other.
inline FieldPoint vectorFieldAt(const SourceElement& source, const ReferencePoint& u)
{
  FieldPoint result;
  for (int c = 0; c < 3; ++c)
  {
    std::vector<Coefficient> coefficients;
    for (std::size_t i = 0; i < source.control.size(); i += 6)
    {
      const double* row = &source.control[i];
      coefficients.emplace_back(row[0], row[1], row[2], row[3 + c]);
    }
    const Jet jet = evaluateGradient({ source.domain, source.degrees, coefficients.data(),
                                       source.isRational ? source.weights.data() : nullptr },
      u);
    const glm::dmat3 jacobian{ glm::dvec3(jet.first[0]), glm::dvec3(jet.first[1]),
      glm::dvec3(jet.first[2]) };
    result.x = glm::dvec3(jet.value);
    result.values.push_back(jet.value.w);
    result.gradients.push_back(gradientOf(jet) * glm::inverse(jacobian));
  }
  return result;
}

} // namespace hop::testing
