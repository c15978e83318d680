#include "Isolation/SizingField.h"

#include "Support/KeepMarked.h"
#include "Support/SpacingGrid.h"

#include <algorithm>
#include <utility>

namespace hop
{
namespace
{

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
  , Tree({}, GradationSlope)
{
}

/// Places that others limit are left out: by the triangle inequality what they allow anywhere, the others allow no more.
void SizingField::add(std::vector<Limit> limits, const ParallelFor& parallelFor)
{
  const std::vector<Limit>& before = this->Tree.places();
  limits.insert(limits.end(), before.begin(), before.end());
  const GradationTree all(limits, GradationSlope);
  askCaller(parallelFor);
  std::vector<char> kept(limits.size());
  forAll(parallelFor, limits.size(),
    [&](std::size_t i)
    { kept[i] = all.limited(limits[i].position, limits[i].spacing) >= limits[i].spacing; });
  keepMarked(limits, kept);
  this->Tree = GradationTree(std::move(limits), GradationSlope);
}

float SizingField::limited(const glm::dvec3& position, float spacing) const
{
  const auto scale = static_cast<float>(this->Scale);
  return scale * this->Tree.limited(position, spacing / scale);
}

void SizingField::lookAround(
  const glm::dvec3& center, double radius, float curvatureMagnitude, Ball& ball) const
{
  ball.Field = this;
  ball.Spacing = static_cast<float>(this->Scale * this->Sizing.at(curvatureMagnitude));
  this->Tree.findAround(
    center, radius, ball.Spacing / static_cast<float>(this->Scale), ball.Places);
}

float SizingField::Ball::at(const glm::dvec3& position) const
{
  const auto scale = static_cast<float>(this->Field->Scale);
  return scale * this->Field->Tree.limited(position, this->Spacing / scale, this->Places);
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
