#include "Isolation/TangencyTest.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// What counts as a tangency. The figures were chosen by experiment.
struct Tangency
{
  /// |F - c| that counts as zero, as a share of the largest coefficient. With a larger share two sheets close to each
  /// other are taken for a tangency; with a smaller one roots of high order are not reached in the steps below.
  static constexpr double Value = 1e-6;
  /// Length of the gradient that counts as zero at a corner, as a share of the largest coefficient: the gradient of a
  /// square whose value is `Value`. With a larger share a slope that crosses zero is taken for a tangency.
  static constexpr double Gradient = 1e-3;
  /// How far outside the domain the search goes on, reference units: a tangency just outside tells how near the
  /// field comes to zero in the domain. A smaller reach misses tangencies near faces, a larger one finds tangencies far
  /// from the domain.
  static constexpr double Reach = 0.25;
  /// Steps at most: enough for roots of order six, towards which a step goes a fifth of the way.
  static constexpr int MaximumSteps = 12;
};

/// Whether the field and its gradient are zero at a corner. The way along the gradient may lead past such a corner.
bool isTangentAtCorner(const BernsteinForm& form, double largest)
{
  const auto& corners = facts(form.domain).corners;
  return std::any_of(corners.begin(), corners.end(),
    [&](const ReferencePoint& corner)
    {
      const Jet jet = evaluateGradient(form, corner);
      return std::abs(jet.value.w) <= Tangency::Value * largest &&
        glm::length(gradientOf(jet)) <= Tangency::Gradient * largest;
    });
}

} // namespace

Approach approachToZero(const BernsteinForm& form, double sign)
{
  const double largest = fieldRange(form).magnitude();
  const double least = Tangency::Value * largest;
  if (isTangentAtCorner(form, largest))
  {
    return Approach::Tangent;
  }
  ReferencePoint u = middleOf(facts(form.domain));
  for (int step = 0;
       step < Tangency::MaximumSteps && insideMargin(form.domain, u) >= -Tangency::Reach; ++step)
  {
    const Jet jet = evaluateHessian(form, u);
    const double value = sign * jet.value.w;
    if (value <= least)
    {
      return value < -least ? Approach::Crosses : Approach::Tangent;
    }
    const glm::dvec3 gradient = gradientOf(jet);
    const double bend = sign * glm::dot(gradient, hessianOf(jet.second) * gradient);
    if (!(bend > 0.0))
    {
      return Approach::Apart;
    }
    u.xyz -= sign * glm::dot(gradient, gradient) / bend * gradient;
  }
  return Approach::Apart;
}

} // namespace hop
