#include "Isolation/TangencyTest.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

constexpr double tangentShare = 1e-6;
constexpr double levelShare = 1e-3;
/// Places that far outside the domain say what happens in it.
constexpr double reach = 0.25;

/// Whether the field and its gradient are zero at a corner: there the way along the gradient may lead out.
bool touchesAtCorner(const BernsteinForm& form, double largest)
{
  const auto& corners = facts(form.domain).corners;
  return std::any_of(corners.begin(), corners.end(),
    [&](const ReferencePoint& corner)
    {
      const Jet jet = evaluateGradient(form, corner);
      return std::abs(jet.value.w) <= tangentShare * largest &&
        glm::length(gradientOf(jet)) <= levelShare * largest;
    });
}

} // namespace

Approach approachToZero(const BernsteinForm& form, double sign)
{
  // Enough for roots of order six, towards which a step goes a fifth of the way.
  constexpr int mostSteps = 12;
  const double largest = fieldRange(form).magnitude();
  const double least = tangentShare * largest;
  if (touchesAtCorner(form, largest))
  {
    return Approach::Tangent;
  }
  ReferencePoint u = middleOf(facts(form.domain));
  for (int step = 0; step < mostSteps && insideMargin(form.domain, u) >= -reach; ++step)
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
