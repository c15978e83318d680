#pragma once

#include "ElementCases.h"
#include "Elements/SampledField.h"
#include "Elements/SourceElement.h"

#include <vector>

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

/// An element with a vector field.
struct VectorElement
{
  /// \param place, field, weight functions of a reference point; the weight counts if the element is rational
  template <class Place, class Field, class Weight>
  VectorElement(const ElementCase& which, bool isRational, const Place& place, const Field& field,
    const Weight& weight)
    : element(which)
    , rational(isRational)
  {
    for (const LatticePoint& point : latticePoints(which.domain, which.degrees))
    {
      const glm::dvec3 u = latticePosition(which.degrees, point).xyz;
      const double w = isRational ? weight(u) : 1.0;
      for (const glm::dvec3& row : { place(u), field(u) })
      {
        this->control.insert(this->control.end(), { w * row.x, w * row.y, w * row.z });
      }
      this->weights.push_back(w);
    }
  }

  SourceElement source() const
  {
    return { this->element.domain, this->element.degrees, 6, this->control, this->weights,
      this->rational, 0.0 };
  }

  ElementCase element;
  bool rational;
  std::vector<double> control;
  std::vector<double> weights;
};

} // namespace hop::testing
