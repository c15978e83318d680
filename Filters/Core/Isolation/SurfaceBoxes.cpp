#include "Isolation/SurfaceBoxes.h"

#include "Isolation/ElementSplitter.h"

#include <algorithm>
#include <numeric>

namespace hop
{
namespace
{

/// Elements from which each is split by one thread. Fewer elements are split one after the other, each by all threads.
/// Chosen by experiment: a smaller number leaves threads idle, a larger one costs a start of the threads for each level
/// of pieces.
constexpr std::size_t fewElements = 16;

using IsSmall = std::function<bool(const SurfaceBox&)>;

/// The known boxes by element.
class KnownElements
{
public:
  /// \param known outlives it
  KnownElements(const KnownBoxes& known, std::size_t elementCount)
    : Known(known)
    , First(known.boxes ? elementCount + 1 : 0, 0)
  {
    for (std::size_t b = 0; known.boxes && b < known.boxes->size(); ++b)
    {
      this->First[(*known.boxes)[b].middle.element + 1] = b + 1;
    }
    for (std::size_t e = 1; e < this->First.size(); ++e)
    {
      this->First[e] = std::max(this->First[e], this->First[e - 1]);
    }
  }

  /// Appends the boxes of an element, if they are known and all may stay. An element that had no boxes has no surface.
  /// \return whether the element is done
  bool take(int element, std::vector<SurfaceBox>& boxes) const
  {
    if (!this->Known.boxes)
    {
      return false;
    }
    const auto begin = this->Known.boxes->begin();
    const auto first = begin + static_cast<std::ptrdiff_t>(this->First[element]);
    const auto last = begin + static_cast<std::ptrdiff_t>(this->First[element + 1]);
    const bool isDone = std::all_of(first, last, this->Known.mayStay);
    boxes.insert(boxes.end(), first, isDone ? last : first);
    return isDone;
  }

private:
  const KnownBoxes& Known;
  /// Index of the first box of each element, then the number of boxes.
  std::vector<std::size_t> First;
};

/// Boxes of all elements in one list.
std::vector<SurfaceBox> joined(const std::vector<std::vector<SurfaceBox>>& ofElement)
{
  std::vector<SurfaceBox> boxes;
  boxes.reserve(std::accumulate(ofElement.begin(), ofElement.end(), std::size_t{ 0 },
    [](std::size_t sum, const auto& list) { return sum + list.size(); }));
  for (const auto& list : ofElement)
  {
    boxes.insert(boxes.end(), list.begin(), list.end());
  }
  return boxes;
}

/// Splits elements one after the other, each by all threads.
/// \param progress is told how many elements are done
std::vector<SurfaceBox> splitInTurn(const ElementMesh& mesh, double isovalue,
  const IsSmall& isFineEnough, const KnownElements& known, const ParallelFor& parallelFor,
  const ReportProgress& progress)
{
  std::vector<SurfaceBox> boxes;
  const PreparedKinds kinds(mesh, isovalue);
  ElementSplitter splitter(mesh, isovalue, kinds, isFineEnough);
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
  {
    if (!known.take(e, boxes))
    {
      splitter.split(
        e, parallelFor, [&, e](double share) { progress(e + share); }, boxes);
    }
    progress(e + 1);
  }
  return boxes;
}

/// Splits many elements at a time, each by one thread, and then those that take long by all threads. Parameters are those
/// of splitInTurn.
std::vector<SurfaceBox> splitAtOnce(const ElementMesh& mesh, double isovalue,
  const IsSmall& isFineEnough, const KnownElements& known, const ParallelFor& parallelFor,
  const ReportProgress& progress)
{
  const PreparedKinds kinds(mesh, isovalue);
  std::atomic<int> done{ 0 };
  std::vector<std::vector<SurfaceBox>> ofElement(mesh.elements.size());
  std::vector<char> isLong(mesh.elements.size(), 0);
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(mesh.elements.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      ElementSplitter splitter(mesh, isovalue, kinds, isFineEnough);
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        const int element = static_cast<int>(e);
        isLong[e] =
          !known.take(element, ofElement[e]) && !splitter.splitIfShort(element, ofElement[e]);
        if (!isLong[e])
        {
          progress(++done);
        }
      }
    });
  ElementSplitter splitter(mesh, isovalue, kinds, isFineEnough);
  for (std::size_t e = 0; e < isLong.size(); ++e)
  {
    if (isLong[e])
    {
      const auto report = [&](double share) { progress(done + share); };
      splitter.split(static_cast<int>(e), parallelFor, report, ofElement[e]);
      progress(++done);
    }
  }
  return joined(ofElement);
}

} // namespace

std::vector<SurfaceBox> findSurfaceBoxes(
  const ElementMesh& mesh, double isovalue, double largestSize, const ParallelFor& parallelFor)
{
  return findSurfaceBoxes(
    mesh, isovalue, [largestSize](const SurfaceBox& box) { return box.size <= largestSize; },
    parallelFor);
}

std::vector<SurfaceBox> findSurfaceBoxes(const ElementMesh& mesh, double isovalue,
  const IsSmall& isFineEnough, const ParallelFor& parallelFor, const ReportProgress& progress,
  const KnownBoxes& known)
{
  const KnownElements knownElements(known, mesh.elements.size());
  const auto reportElements = [&](double done)
  { report(progress, done / static_cast<double>(mesh.elements.size())); };
  return mesh.elements.size() < fewElements
    ? splitInTurn(mesh, isovalue, isFineEnough, knownElements, parallelFor, reportElements)
    : splitAtOnce(mesh, isovalue, isFineEnough, knownElements, parallelFor, reportElements);
}

} // namespace hop
