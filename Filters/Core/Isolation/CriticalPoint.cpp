#include "Isolation/CriticalPoint.h"

#include <cmath>

namespace hop
{
namespace
{

/// How Newton's method searches for a critical point. The figures were chosen by experiment.
struct Search
{
  /// Steps at most. A few suffice at a simple root; towards roots of higher order the method converges linearly, so
  /// that fewer steps miss critical points there. More steps cost time where there is no critical point.
  static constexpr int MaximumSteps = 30;
  /// Length of the last step, reference coordinates: well above rounding errors. A smaller length may
  /// never be reached where the Hessian is nearly singular; a larger one leaves places inexact.
  static constexpr double Converged = 1e-12;
  /// How far from the box's middle a step may lead, in radii of the box. A smaller reach misses critical points that
  /// leave the box beside them undecided; a larger one finds points that have nothing to do with the box.
  static constexpr double Reach = 4.0;
  /// |F - c| at a point of the surface at most, as a share of the range of F and of |c|: the rounding errors of an
  /// evaluation. A larger share counts critical points beside the surface as singular points of the surface.
  static constexpr double Rounding = 1e-12;
};

} // namespace

bool findCriticalPoint(
  const ElementMesh& mesh, double isovalue, const SurfaceBox& box, CriticalPoint& result)
{
  const BernsteinForm form = mesh.form(box.middle.element);
  const Range range = fieldRange(form);
  glm::dvec3 u = box.middle.u.xyz;
  for (int step = 0; step < Search::MaximumSteps; ++step)
  {
    const Jet jet = evaluateHessian(form, { u });
    const glm::dmat3 hessian = hessianOf(jet.second);
    if (glm::determinant(hessian) == 0.0)
    {
      return false;
    }
    const glm::dvec3 du = -glm::inverse(hessian) * gradientOf(jet);
    u += du;
    if (!(glm::distance(u, box.middle.u.xyz) <= Search::Reach * box.referenceRadius))
    {
      return false;
    }
    if (glm::length(du) < Search::Converged)
    {
      const double value = evaluateGradient(form, { u }).value.w - isovalue;
      result.location = { box.middle.element, { u } };
      result.onSurface = std::abs(value) <=
        Search::Rounding * (std::abs(range.lower) + std::abs(range.upper) + std::abs(isovalue));
      return true;
    }
  }
  return false;
}

} // namespace hop
