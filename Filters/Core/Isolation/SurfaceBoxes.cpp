#include "Isolation/SurfaceBoxes.h"

#include "Isolation/ElementSplitter.h"

#include <numeric>

namespace hop
{
namespace
{

/// Fewer elements than this are split one after the other, each in threads.
constexpr std::size_t fewElements = 16;

using IsSmall = std::function<bool(const SurfaceBox&)>;

std::vector<SurfaceBox> joined(const std::vector<std::vector<SurfaceBox>>& ofElement)
{
  std::vector<SurfaceBox> boxes;
  boxes.reserve(std::accumulate(ofElement.begin(), ofElement.end(), std::size_t{ 0 },
    [](std::size_t sum, const auto& some) { return sum + some.size(); }));
  for (const auto& some : ofElement)
  {
    boxes.insert(boxes.end(), some.begin(), some.end());
  }
  return boxes;
}

/// \param found is told how many elements are done
std::vector<SurfaceBox> splitInTurn(const ElementMesh& mesh, double isovalue,
  const IsSmall& isSmall, const ParallelFor& parallelFor, const ReportShare& found)
{
  std::vector<SurfaceBox> boxes;
  ElementSplitter splitter(mesh, isovalue, isSmall);
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
  {
    splitter.split(
      e, parallelFor, [&, e](double share) { found(e + share); }, boxes);
    found(e + 1);
  }
  return boxes;
}

/// Likewise; each element in one thread.
std::vector<SurfaceBox> splitAtOnce(const ElementMesh& mesh, double isovalue,
  const IsSmall& isSmall, const ParallelFor& parallelFor, const ReportShare& found)
{
  std::atomic<int> done{ 0 };
  std::vector<std::vector<SurfaceBox>> ofElement(mesh.elements.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(mesh.elements.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      ElementSplitter splitter(mesh, isovalue, isSmall);
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        splitter.split(static_cast<int>(e), {}, {}, ofElement[e]);
        found(++done);
      }
    });
  return joined(ofElement);
}

} // namespace

std::vector<SurfaceBox> findSurfaceBoxes(
  const ElementMesh& mesh, double isovalue, double wantedSize, const ParallelFor& parallelFor)
{
  return findSurfaceBoxes(
    mesh, isovalue, [wantedSize](const SurfaceBox& box) { return box.size <= wantedSize; },
    parallelFor);
}

std::vector<SurfaceBox> findSurfaceBoxes(const ElementMesh& mesh, double isovalue,
  const IsSmall& isSmall, const ParallelFor& parallelFor, const ReportShare& found)
{
  const auto reportElements = [&](double done)
  { report(found, done / static_cast<double>(mesh.elements.size())); };
  return mesh.elements.size() < fewElements
    ? splitInTurn(mesh, isovalue, isSmall, parallelFor, reportElements)
    : splitAtOnce(mesh, isovalue, isSmall, parallelFor, reportElements);
}

} // namespace hop
