#include "Elements/SlabElements.h"

#include "Support/KeepMarked.h"

#include <algorithm>
#include <limits>

namespace hop
{

std::array<double, 2> extentAlong(const BernsteinForm& form, const glm::dvec3& direction)
{
  std::array<double, 2> extent{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  const int count = static_cast<int>(coefficientCount(form.domain, form.degrees));
  for (int i = 0; i < count; ++i)
  {
    const double place = glm::dot(glm::dvec3(controlPoint(form, i)), direction);
    extent = { std::min(extent[0], place), std::max(extent[1], place) };
  }
  return extent;
}

std::vector<int> elementsIn(
  const ElementMesh& mesh, const Slab& slab, const ParallelFor& parallelFor)
{
  std::vector<char> marks(mesh.elements.size());
  forAll(parallelFor, marks.size(),
    [&](std::size_t e)
    {
      const auto [first, last] = extentAlong(mesh.form(static_cast<int>(e)), slab.direction);
      marks[e] = slab.begin <= last && first <= slab.end;
    });
  return markedIndices(marks, marks.size());
}

std::vector<char> reachingOutOf(
  const ElementMesh& mesh, const Slab& slab, const ParallelFor& parallelFor)
{
  std::vector<char> marks(mesh.elements.size());
  forAll(parallelFor, marks.size(),
    [&](std::size_t e)
    {
      const auto [first, last] = extentAlong(mesh.form(static_cast<int>(e)), slab.direction);
      marks[e] = first < slab.begin || slab.end < last;
    });
  return marks;
}

} // namespace hop
