#include "Elements/CornerNumbers.h"

#include "Support/CoincidentPoints.h"

#include <algorithm>
#include <utility>

namespace hop
{
namespace
{

/// How far apart coincident corners may be. Larger tolerances join corners of thin layers, smaller ones leave cracks
/// between elements.
struct Coincidence
{
  /// In units of the largest coordinate: what six decimal digits leave of coordinates, the least that files hold.
  static constexpr double fileRounding = 1e-5;
  /// In units of the element's shortest edge, so that its ends stay apart; chosen by experiment.
  static constexpr double shareOfEdge = 1e-2;
  /// In units of the largest coordinate: ends of a shorter edge differ by rounding errors of doubles only. The edge is
  /// collapsed, and does not count as the shortest.
  static constexpr double rounding = 1e-14;
};

std::size_t cornerCount(const Element& element)
{
  return facts(element.domain).corners.size();
}

glm::dvec3 cornerPosition(const BernsteinForm& form, int corner)
{
  return glm::dvec3(controlPoint(form,
    coefficientIndex(
      form.domain, form.degrees, cornerLatticePoint(form.domain, form.degrees, corner))));
}

double largestCoordinate(const BernsteinForm& form)
{
  double largest = 0.0;
  for (int c = 0; c < static_cast<int>(facts(form.domain).corners.size()); ++c)
  {
    const glm::dvec3 x = glm::abs(cornerPosition(form, c));
    largest = std::max({ largest, x.x, x.y, x.z });
  }
  return largest;
}

/// Length of the shortest edge among the edges longer than `least`; infinite if none is.
double shortestEdge(const BernsteinForm& form, double least)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : facts(form.domain).edges)
  {
    const double length = glm::distance(cornerPosition(form, a), cornerPosition(form, b));
    shortest = length > least ? std::min(shortest, length) : shortest;
  }
  return shortest;
}

} // namespace

std::vector<double> cornerTolerances(const ElementMesh& mesh, const ParallelFor& parallelFor)
{
  std::vector<double> tolerances(mesh.elements.size());
  forAll(parallelFor, tolerances.size(),
    [&](std::size_t e) { tolerances[e] = largestCoordinate(mesh.form(static_cast<int>(e))); });
  const double largest =
    tolerances.empty() ? 0.0 : *std::max_element(tolerances.begin(), tolerances.end());
  forAll(parallelFor, tolerances.size(),
    [&](std::size_t e)
    {
      const double edge =
        shortestEdge(mesh.form(static_cast<int>(e)), Coincidence::rounding * largest);
      tolerances[e] =
        std::min(Coincidence::fileRounding * largest, Coincidence::shareOfEdge * edge);
    });
  return tolerances;
}

void numberCorners(
  ElementMesh& mesh, const std::vector<double>& tolerances, const ParallelFor& parallelFor)
{
  std::vector<std::size_t> first(mesh.elements.size() + 1, 0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    first[e + 1] = first[e] + cornerCount(mesh.elements[e]);
  }
  Buffer<RoundedPoint> corners(first.back());
  forAll(parallelFor, mesh.elements.size(),
    [&](std::size_t e)
    {
      const BernsteinForm form = mesh.form(static_cast<int>(e));
      for (std::size_t c = first[e]; c < first[e + 1]; ++c)
      {
        corners[c] = { cornerPosition(form, static_cast<int>(c - first[e])), tolerances[e] };
      }
    });
  const std::vector<int> places = coincidentPoints(corners, parallelFor);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    auto& numbers = mesh.elements[e].corners;
    numbers.fill(-1);
    std::copy(places.data() + first[e], places.data() + first[e + 1], numbers.begin());
  }
}

void joinElements(ElementMesh& mesh, const ParallelFor& parallelFor)
{
  const std::vector<double> tolerances = cornerTolerances(mesh, parallelFor);
  numberCorners(mesh, tolerances, parallelFor);
  findFaceNeighbors(mesh, tolerances, parallelFor);
}

} // namespace hop
