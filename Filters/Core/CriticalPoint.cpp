#include "CriticalPoint.h"

#include <cmath>

namespace hop
{
namespace
{

glm::dmat3 symmetric(const std::array<Coefficient, 6>& second)
{
  return { second[0].w, second[1].w, second[2].w, second[1].w, second[3].w, second[4].w,
    second[2].w, second[4].w, second[5].w };
}

} // namespace

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
    const glm::dvec3 gradient(jet.first[0].w, jet.first[1].w, jet.first[2].w);
    const glm::dmat3 hessian = symmetric(jet.second);
    if (glm::determinant(hessian) == 0.0)
    {
      return false;
    }
    const glm::dvec3 du = -glm::inverse(hessian) * gradient;
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
