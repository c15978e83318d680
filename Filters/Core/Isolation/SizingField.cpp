#include "Isolation/SizingField.h"

#include "Support/SpacingGrid.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace hop
{
namespace
{

/// Distance up to which a place limits spacings, in units of its own spacing: there the limit is 1 + 4 GradationSlope =
/// 2.2 times that spacing. Chosen by experiment: a larger reach takes longer, a smaller one lets spacings jump where a
/// small one has no other places around it.
constexpr double lookUpReach = 4.0;

/// Entries of the queue between two questions whether to go on: often enough for an early end within a fraction of a
/// second, and too seldom to cost time.
constexpr std::size_t entriesPerQuestion = 256;

/// Which places stand for others. Spacings then are exact to the way from one place of a cell to another, times the
/// slope of the gradation. The figures were chosen by experiment: with more places gradation takes longer, with fewer
/// of them spacings are less exact.
struct Representatives
{
  /// Size of the cells, in units of the spacings in them: a quarter to a half, as cells are grouped by powers of two.
  static constexpr double CellPerSpacing = 0.25;
  /// Places of a cell that may all be marked.
  static constexpr std::ptrdiff_t MostInCell = 16;
  /// Places a cell, on average, above which elements are finer than spacings, and a cell has one mark only.
  static constexpr double FineAverage = 4.0;
};

} // namespace

SizingField::SizingField(const SizingFunction& sizing)
  : Sizing(sizing)
{
}

SizingField::SizingField(SizingField&&) noexcept = default;
SizingField::~SizingField() = default;

void SizingField::add(const std::vector<Limit>& limits, const ParallelFor& parallelFor)
{
  const std::size_t first = this->Spacings.size();
  for (const Limit& limit : limits)
  {
    this->Positions.push_back(limit.position);
    this->Spacings.push_back(limit.spacing);
  }
  this->limitGradation(first, parallelFor);
  this->Grid = std::make_unique<SpacingGrid>(this->Positions, this->Spacings, lookUpReach);
}

/// Dijkstra's method: from the smallest spacing on, each place limits the places around it.
/// \param first of the new places; the places before it keep to the gradation among themselves already
void SizingField::limitGradation(std::size_t first, const ParallelFor& parallelFor)
{
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t i = first; i < this->Spacings.size(); ++i)
  {
    queue.emplace(this->Spacings[i], static_cast<int>(i));
  }
  const std::vector<float> before = this->Spacings;
  const SpacingGrid grid(this->Positions, before, lookUpReach);
  for (std::size_t n = 1; !queue.empty(); ++n)
  {
    if (n % entriesPerQuestion == 0)
    {
      askCaller(parallelFor);
    }
    const auto [spacing, i] = queue.top();
    queue.pop();
    if (spacing > this->Spacings[i])
    {
      continue;
    }
    grid.visitCoarser(this->Positions[i], spacing, GradationSlope,
      [&, h = spacing, from = i](int j)
      {
        const auto limit = static_cast<float>(
          h + GradationSlope * glm::distance(this->Positions[from], this->Positions[j]));
        if (limit < this->Spacings[j])
        {
          this->Spacings[j] = limit;
          queue.emplace(limit, j);
        }
      });
  }
}

float SizingField::limited(const glm::dvec3& position, float spacing) const
{
  const auto scale = static_cast<float>(this->Scale);
  return this->Grid ? scale * this->Grid->withGradation(position, spacing / scale, GradationSlope)
                    : spacing;
}

std::vector<char> markRepresentatives(Span<glm::dvec3> positions, Span<float> spacings)
{
  const SpacingGrid cells(positions, spacings, Representatives::CellPerSpacing);
  std::vector<SpacingGrid::Points> groups;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const SpacingGrid::Points mates = cells.cellMates(static_cast<int>(i));
    if (*mates.begin() == static_cast<int>(i))
    {
      groups.push_back(mates);
    }
  }
  const bool isFine = static_cast<double>(positions.size()) >
    Representatives::FineAverage * static_cast<double>(groups.size());
  const auto lessSpacing = [&](int a, int b) { return spacings[a] < spacings[b]; };
  std::vector<char> marks(positions.size(), 1);
  for (const SpacingGrid::Points& group : groups)
  {
    if (group.end() - group.begin() > (isFine ? 1 : Representatives::MostInCell))
    {
      for (const int one : group)
      {
        marks[one] = 0;
      }
      marks[*std::min_element(group.begin(), group.end(), lessSpacing)] = 1;
    }
  }
  return marks;
}

} // namespace hop
