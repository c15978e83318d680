#include "Elements/CanonicalOrder.h"

#include <algorithm>

namespace hop
{

namespace
{

/// The direction along which elements are swept. No simple ratios: centroids of regular meshes have different places along
/// it. Chosen by experiment, see canonicalOrder().
const glm::dvec3 sweep(0.3183098861837907, 0.7071067811865476, 1.0);

/// An element on its way to its place.
struct Keyed
{
  /// Place of the centroid along the sweep.
  double place = 0.0;
  int element = 0;
};

/// Mean of the corners.
glm::dvec3 centroidOf(const BernsteinForm& form)
{
  const int count = static_cast<int>(facts(form.domain).corners.size());
  glm::dvec3 sum(0.0);
  for (int c = 0; c < count; ++c)
  {
    sum += glm::dvec3(controlPoint(form,
      coefficientIndex(
        form.domain, form.degrees, cornerLatticePoint(form.domain, form.degrees, c))));
  }
  return sum / static_cast<double>(count);
}

/// Which of two elements in one place comes first.
bool comesBefore(const BernsteinForm& a, const BernsteinForm& b)
{
  if (a.domain != b.domain || a.degrees != b.degrees)
  {
    return a.domain != b.domain ? a.domain < b.domain : a.degrees < b.degrees;
  }
  const std::size_t count = coefficientCount(a.domain, a.degrees);
  for (std::size_t i = 0; i < count; ++i)
  {
    for (int c = 0; c < Coefficient::length(); ++c)
    {
      if (a.coefficients[i][c] != b.coefficients[i][c])
      {
        return a.coefficients[i][c] < b.coefficients[i][c];
      }
    }
  }
  if (!a.weights || !b.weights)
  {
    return !a.weights && b.weights;
  }
  return std::lexicographical_compare(a.weights, a.weights + count, b.weights, b.weights + count);
}

} // namespace

std::vector<int> canonicalOrder(const ElementMesh& mesh, const ParallelFor& parallelFor)
{
  std::vector<Keyed> keyed(mesh.elements.size());
  forAll(parallelFor, keyed.size(),
    [&](std::size_t e)
    {
      const int element = static_cast<int>(e);
      keyed[e] = { glm::dot(centroidOf(mesh.form(element)), sweep), element };
    });
  askCaller(parallelFor);
  std::stable_sort(keyed.begin(), keyed.end(),
    [&](const Keyed& a, const Keyed& b)
    {
      return a.place != b.place ? a.place < b.place
                                : comesBefore(mesh.form(a.element), mesh.form(b.element));
    });
  std::vector<int> order;
  order.reserve(keyed.size());
  for (const Keyed& some : keyed)
  {
    order.push_back(some.element);
  }
  return order;
}

glm::dvec3 sweepDirection()
{
  return glm::normalize(sweep);
}

} // namespace hop
