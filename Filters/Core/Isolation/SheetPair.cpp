#include "Isolation/SheetPair.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Limits of a pair of sheets, chosen by experiment. Narrower limits leave pairs to be halved further, wider ones take
/// sheets that meet or bend for two flat ones.
struct PairLimits
{
  /// Least ratio between the distances of the sheets, on the lines through two places.
  static constexpr double Steady = 0.5;
  /// Distance of a sheet from its tangent plane at most, in units of the thickness of the domain.
  static constexpr double Flat = 0.1;
  /// Distance of a corner from a sheet below which the value at the corner is the field's own value, in units of the
  /// distance between the sheet and the extremum. Distances from second order may have the wrong sign that near.
  static constexpr double AtSheet = 0.1;
  /// Distance of the nearest corner from a sheet that clearly passes all corners by, in units of the distance of the
  /// sheet from its tangent plane.
  static constexpr double Apart = 2.0;
};

/// The eigenvector of a symmetric matrix whose eigenvalue has the largest absolute value, by repeated squaring; if
/// there are two such eigenvalues, a combination of their eigenvectors.
glm::dvec3 dominantDirection(glm::dmat3 matrix)
{
  // The matrix to the power of 2^6 = 64: eigenvalues in the ratio 10:9 then are in the ratio 850:1. More squarings tell
  // closer eigenvalues apart, at a cost that counts for each undecided piece. Chosen by experiment.
  constexpr int squarings = 6;
  for (int n = 0; n < squarings; ++n)
  {
    const double size = std::sqrt(glm::dot(matrix[0], matrix[0]) + glm::dot(matrix[1], matrix[1]) +
      glm::dot(matrix[2], matrix[2]));
    if (!(size > 0.0))
    {
      return glm::dvec3(0.0);
    }
    matrix = matrix * matrix / (size * size);
  }
  const auto shorter = [](const glm::dvec3& a, const glm::dvec3& b)
  { return glm::dot(a, a) < glm::dot(b, b); };
  const glm::dvec3 column = std::max({ matrix[0], matrix[1], matrix[2] }, shorter);
  const double length = glm::length(column);
  return length > 0.0 ? column / length : glm::dvec3(0.0);
}

/// A field on the lines along one direction.
class FieldOnLines
{
public:
  FieldOnLines(const BernsteinForm& form, const glm::dvec3& direction)
    : Form(form)
    , Direction(direction)
  {
  }

  /// The field and its first two derivatives along the direction.
  struct Expansion
  {
    double value = 0.0;
    double slope = 0.0;
    double curvature = 0.0;
  };

  Expansion at(const glm::dvec3& u) const
  {
    const Jet jet = evaluateHessian(this->Form, { u });
    return { jet.value.w, glm::dot(gradientOf(jet), this->Direction),
      glm::dot(this->Direction, hessianOf(jet.second) * this->Direction) };
  }

  /// The line through a place, and the extremum of the field on it.
  struct Line
  {
    double valueHere = 0.0;
    /// Coordinate of the place on the line, from the extremum.
    double distance = 0.0;
    double valueThere = 0.0;
    /// Distance of the two zeros from the extremum, to second order.
    double reach = 0.0;
  };

  /// The line through a place. Two Newton steps find the extremum: exactly for fields that are quadratic along the
  /// direction, and nearly so for the almost quadratic fields between two sheets that are close to each other.
  Line through(const glm::dvec3& u) const
  {
    Expansion there = this->at(u);
    Line line{ there.value, 0.0, 0.0, 0.0 };
    for (int step = 0; step < 2; ++step)
    {
      line.distance += there.slope / there.curvature;
      there = this->at(u - line.distance * this->Direction);
    }
    line.valueThere = there.value;
    line.reach = std::sqrt(std::max(0.0, -2.0 * there.value / there.curvature));
    return line;
  }

  /// The zero on the line near a place, by Newton's method. Four steps converge from a start that is exact to second
  /// order.
  glm::dvec3 zeroNear(glm::dvec3 u) const
  {
    for (int step = 0; step < 4; ++step)
    {
      const Expansion here = this->at(u);
      u -= here.value / here.slope * this->Direction;
    }
    return u;
  }

private:
  BernsteinForm Form;
  glm::dvec3 Direction;
};

/// Whether the second derivative along a direction has a given sign everywhere.
bool bendsOneWay(
  const BernsteinForm& form, const MonotoneTest& test, const glm::dvec3& direction, double sign)
{
  std::vector<double> values;
  const int count = coefficientCount(form.domain, form.degrees);
  double largest = 0.0;
  for (int i = 0; i < count; ++i)
  {
    values.push_back(form.coefficients[i].w);
    largest = std::max(largest, std::abs(values.back()));
  }
  // Rounding errors of two differences in a row, as a share of the largest coefficient: the second one multiplies
  // errors of the first. A larger share misses pairs in which the field hardly bends.
  const double rounding = 1e-12 * largest;
  const std::vector<double> second = test.derivative(test.derivative(values, direction), direction);
  return std::all_of(
    second.begin(), second.end(), [&](double bend) { return sign * bend > rounding; });
}

/// One sheet of a pair.
/// \param place on the sheet
/// \param reach distance of the sheet from the extremum, on the line through the middle of the domain
/// \param lines through the corners
/// \param side 1 for the sheet ahead along the direction, -1 for the other one
/// \return nothing if the sheet is far from the other one, or not nearly flat, or passes the corners by so closely that
///   it may be in the domain
std::optional<SheetPair::Sheet> sheetFrom(const BernsteinForm& form, const glm::dvec3& place,
  const glm::dvec3& direction, double reach, const std::vector<FieldOnLines::Line>& lines,
  double side)
{
  const auto& corners = facts(form.domain).corners;
  const glm::dvec3 gradient = gradientOf(evaluateGradient(form, { place }));
  const double rise = glm::dot(gradient, direction);
  SheetPair::Sheet sheet;
  sheet.place = place;
  Range heights{ infinity, -infinity };
  Range distances = heights;
  double error = 0.0;
  for (std::size_t c = 0; c < corners.size(); ++c)
  {
    const double distance = lines[c].distance - side * lines[c].reach;
    const double fromPlane = glm::dot(gradient, corners[c].xyz - place) / rise;
    error = std::max(error, std::abs(distance - fromPlane));
    heights.include(glm::dot(direction, corners[c].xyz));
    distances.include(distance);
    const bool isAtSheet = std::abs(distance) < PairLimits::AtSheet * lines[c].reach;
    sheet.values[c] = isAtSheet ? lines[c].valueHere : rise * distance;
  }
  const bool passesBy =
    distances.lower > PairLimits::Apart * error || distances.upper < -PairLimits::Apart * error;
  const bool parts = distances.lower <= 0.0 && distances.upper >= 0.0;
  sheet.reach = std::abs(rise) * reach;
  sheet.isFlat = error <= reach;
  const double thickness = heights.upper - heights.lower;
  const bool isNear = 2.0 * reach <= thickness;
  const bool isNearlyFlat = error <= PairLimits::Flat * thickness;
  return isNear && isNearlyFlat && (parts || passesBy) ? std::optional(sheet) : std::nullopt;
}

} // namespace

std::optional<SheetPair> findSheetPair(
  const BernsteinForm& form, const MonotoneTest& test, double slack)
{
  const BernsteinForm field{ form.domain, form.degrees, form.coefficients, nullptr };
  const auto& corners = facts(form.domain).corners;
  const glm::dvec3 middle = middleOf(facts(form.domain)).xyz;
  const glm::dvec3 direction =
    dominantDirection(hessianOf(evaluateHessian(field, { middle }).second));
  const FieldOnLines along(field, direction);
  SheetPair pair;
  pair.outside = along.at(middle).curvature > 0.0 ? 1.0 : -1.0;
  if (direction == glm::dvec3(0.0) || !bendsOneWay(field, test, direction, pair.outside))
  {
    return std::nullopt;
  }
  const FieldOnLines::Line middleLine = along.through(middle);
  const auto isSteadyPair = [&](const FieldOnLines::Line& line)
  {
    return pair.outside * line.valueThere < -slack &&
      line.reach > PairLimits::Steady * middleLine.reach &&
      middleLine.reach > PairLimits::Steady * line.reach;
  };
  // Most pieces fail at the first line or the second; each costs three evaluations.
  if (!isSteadyPair(middleLine))
  {
    return std::nullopt;
  }
  std::vector<FieldOnLines::Line> lines;
  lines.reserve(corners.size());
  for (const ReferencePoint& corner : corners)
  {
    lines.push_back(along.through(corner.xyz));
    if (!isSteadyPair(lines.back()))
    {
      return std::nullopt;
    }
  }
  pair.between = middle - middleLine.distance * direction;
  for (const int n : { 0, 1 })
  {
    const double side = n == 0 ? -1.0 : 1.0;
    const glm::dvec3 place = along.zeroNear(pair.between + side * middleLine.reach * direction);
    const auto sheet = sheetFrom(field, place, direction, middleLine.reach, lines, side);
    if (!sheet)
    {
      return std::nullopt;
    }
    pair.sheets[n] = *sheet;
  }
  return pair;
}

} // namespace hop
