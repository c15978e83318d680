#include "Isolation/CriticalPoint.h"

#include <cmath>

namespace hop
{

bool findCriticalPoint(
  const ElementMesh& mesh, double isovalue, const SurfaceBox& box, CriticalPoint& result)
{
  constexpr int maximumSteps = 30;
  constexpr double converged = 1e-12;
  constexpr double searchRadii = 4.0;
  const BernsteinForm form = mesh.form(box.middle.element);
  const Range range = fieldRange(form);
  glm::dvec3 u = box.middle.u.xyz;
  for (int step = 0; step < maximumSteps; ++step)
  {
    const Jet jet = evaluateHessian(form, { u });
    const glm::dmat3 hessian = hessianOf(jet.second);
    if (glm::determinant(hessian) == 0.0)
    {
      return false;
    }
    const glm::dvec3 du = -glm::inverse(hessian) * gradientOf(jet);
    u += du;
    if (!(glm::distance(u, box.middle.u.xyz) <= searchRadii * box.referenceRadius))
    {
      return false;
    }
    if (glm::length(du) < converged)
    {
      const double value = evaluateGradient(form, { u }).value.w - isovalue;
      constexpr double rounding = 1e-12;
      result.location = { box.middle.element, { u } };
      result.onSurface = std::abs(value) <=
        rounding * (std::abs(range.lower) + std::abs(range.upper) + std::abs(isovalue));
      return true;
    }
  }
  return false;
}

} // namespace hop
