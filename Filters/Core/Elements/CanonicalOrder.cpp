#include "Elements/CanonicalOrder.h"

#include <algorithm>
#include <cstdint>

namespace hop
{

namespace
{

/// Bits of a coordinate in a Morton key: three coordinates fill 63 of 64 bits.
constexpr int bitsPerAxis = 21;

/// An element on its way to its place.
struct Keyed
{
  std::uint64_t key = 0;
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

/// The lowest 21 bits with two zeros between each.
std::uint64_t spread(std::uint64_t bits)
{
  std::uint64_t result = 0;
  for (int b = 0; b < bitsPerAxis; ++b)
  {
    result |= ((bits >> b) & 1U) << (3 * b);
  }
  return result;
}

/// \param x from 0 to 1 in every coordinate
std::uint64_t mortonKey(const glm::dvec3& x)
{
  constexpr double largest = (1 << bitsPerAxis) - 1;
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    key |= spread(static_cast<std::uint64_t>(largest * std::clamp(x[axis], 0.0, 1.0))) << axis;
  }
  return key;
}

/// Which of two elements with one key comes first.
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

std::vector<int> canonicalOrder(
  const ElementMesh& mesh, const MeshCube& cube, const ParallelFor& parallelFor)
{
  std::vector<Keyed> keyed(mesh.elements.size());
  forAll(parallelFor, keyed.size(),
    [&](std::size_t e)
    {
      const int element = static_cast<int>(e);
      keyed[e] = { mortonKey((centroidOf(mesh.form(element)) - cube.lower) / cube.side), element };
    });
  askCaller(parallelFor);
  std::stable_sort(keyed.begin(), keyed.end(),
    [&](const Keyed& a, const Keyed& b)
    {
      return a.key != b.key ? a.key < b.key
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

} // namespace hop
