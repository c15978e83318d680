#include "Isolation/SurfaceBox.h"

#include <cmath>

namespace hop
{

bool isAtBox(const SurfaceBox& box, const Location& location)
{
  return location.element == box.middle.element &&
    glm::distance(location.u.xyz, box.middle.u.xyz) <= box.referenceRadius;
}

Location findBetweenEnds(
  const ElementMesh& mesh, double isovalue, const SurfaceBox& box, std::int64_t& evaluations)
{
  // Steps at most: enough for the accuracy on smooth fields, chosen by experiment. Fewer end farther from the surface.
  constexpr int mostSteps = 20;
  // |F - c| at the end, as a share of its difference between the ends. Chosen by experiment: a smaller share costs
  // evaluations, a larger one costs Newton steps afterwards.
  constexpr double nearEnough = 1e-3;
  const BernsteinForm form = mesh.form(box.middle.element);
  const auto at = [&](double t)
  { return ReferencePoint{ glm::mix(box.ends[0].xyz, box.ends[1].xyz, t) }; };
  const auto valueAt = [&](double t)
  {
    ++evaluations;
    return evaluateGradient(form, at(t)).value.w - isovalue;
  };
  double below = 0.0, above = 1.0;
  double valueBelow = valueAt(below), valueAbove = valueAt(above);
  const double enough = nearEnough * (valueAbove - valueBelow);
  double t = 0.5;
  for (int n = 0; n < mostSteps; ++n)
  {
    t = below + (above - below) * valueBelow / (valueBelow - valueAbove);
    const double value = valueAt(t);
    if (!(std::abs(value) > enough))
    {
      break;
    }
    // The Illinois rule: the value of the end that stays is halved, so that the end does not stay for long.
    (value < 0.0 ? below : above) = t;
    (value < 0.0 ? valueBelow : valueAbove) = value;
    (value < 0.0 ? valueAbove : valueBelow) *= 0.5;
  }
  return { box.middle.element, at(t) };
}

} // namespace hop
