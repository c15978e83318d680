#include "Elements/DerivativeBounds.h"

#include "Elements/CollapsedFaces.h"
#include "Elements/LatticeRows.h"
#include "Elements/RangeArithmetic.h"
#include "Elements/SymmetricEigenvalues.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bernstein coefficients of the derivatives along one coordinate: rows of (x, y, z, u...).
using DerivativeRows = std::vector<double>;

/// Degree times the differences of coefficients that are neighbours along the coordinate.
DerivativeRows differencesAlong(const SourceElement& source, int axis)
{
  const SimplexFactor& factor = factorOf(source.domain, axis);
  const int degree = source.degrees[axis];
  Degrees degrees = source.degrees;
  for (int a = factor.axis; a < factor.end(); ++a)
  {
    --degrees[a];
  }
  DerivativeRows rows;
  rows.reserve(source.control.size());
  visitLatticeRows(source.domain, degrees,
    [&](int j, int k, int length)
    {
      const auto row = [&](const LatticePoint& start) {
        return &source
                  .control[coefficientIndex(source.domain, source.degrees, start) * source.width];
      };
      const double* here = row({ 0, j, k });
      const double* next = row({ axis == 0, j + (axis == 1), k + (axis == 2) });
      for (int n = 0; n < length * source.width; ++n)
      {
        rows.push_back(degree * (next[n] - here[n]));
      }
    });
  return rows;
}

/// \param columns polynomials, of which some may have lower degrees than others
DerivativeRows rowsOf(const std::vector<ScaledPolynomial>& columns)
{
  Degrees degrees{ 0, 0, 0 };
  for (const ScaledPolynomial& one : columns)
  {
    for (int a = 0; a < 3; ++a)
    {
      degrees[a] = std::max(degrees[a], one.degrees[a]);
    }
  }
  const std::size_t width = columns.size();
  DerivativeRows rows(width * coefficientCount(columns[0].domain, degrees));
  for (std::size_t c = 0; c < width; ++c)
  {
    const std::vector<double> coefficients = unscaled(elevated(columns[c], degrees));
    for (std::size_t i = 0; i < coefficients.size(); ++i)
    {
      rows[i * width + c] = coefficients[i];
    }
  }
  return rows;
}

std::array<DerivativeRows, 3> derivativeRows(const SourceElement& source)
{
  if (!source.isRational && !hasCollapsedEdge(source))
  {
    return { differencesAlong(source, 0), differencesAlong(source, 1),
      differencesAlong(source, 2) };
  }
  const std::array<std::vector<ScaledPolynomial>, 3> columns = homogeneousDerivatives(source);
  return { rowsOf(columns[0]), rowsOf(columns[1]), rowsOf(columns[2]) };
}

/// The mean of x, y and z of rows.
glm::dvec3 meanOf(const DerivativeRows& rows, int width)
{
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < rows.size(); i += width)
  {
    sum += glm::dvec3(rows[i], rows[i + 1], rows[i + 2]);
  }
  return sum * (static_cast<double>(width) / static_cast<double>(rows.size()));
}

/// Whether a matrix is singular, or so nearly that rounding may have made its inverse. True also if it is not finite.
bool isSliver(const glm::dmat3& matrix)
{
  // The determinant over the product of the columns' lengths. Larger: more thin cells are derived that hold no surface;
  // smaller: flat cells, of which rounding errors of coordinates are the volume, pass for cells without surface.
  constexpr double sliver = 1e-6;
  const double lengths = glm::length(matrix[0]) * glm::length(matrix[1]) * glm::length(matrix[2]);
  return !(std::abs(glm::determinant(matrix)) > sliver * lengths);
}

/// For each world coordinate the square of its largest deviation from 0.
glm::dvec3 farthestSquared(const glm::dmat3& inverse, const DerivativeRows& rows, int width, int k)
{
  glm::dvec3 farthest(0.0);
  for (std::size_t i = 0; i < rows.size(); i += width)
  {
    glm::dvec3 deviation = inverse * glm::dvec3(rows[i], rows[i + 1], rows[i + 2]);
    deviation[k] -= 1.0;
    farthest = glm::max(deviation * deviation, farthest);
  }
  return farthest;
}

} // namespace

DerivativeBounds::DerivativeBounds(const SourceElement& source)
  : Field(source.width - 3)
{
  const std::array<DerivativeRows, 3> rows = derivativeRows(source);
  glm::dmat3 mean;
  for (int k = 0; k < 3; ++k)
  {
    mean[k] = meanOf(rows[k], source.width);
  }
  this->Inverse = glm::inverse(mean);
  // M^-1 J = I + E: (I + E)^-1 differs from I by |E| / (1 - |E|) at most.
  double size2 = isSliver(mean) ? infinity : 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3 farthest = farthestSquared(this->Inverse, rows[k], source.width, k);
    size2 += farthest.x + farthest.y + farthest.z;
    for (int i = 0; i < source.width - 3; ++i)
    {
      Range& range = this->Field[i][k];
      range = { rows[k][3 + i], rows[k][3 + i] };
      for (std::size_t n = 3 + i; n < rows[k].size(); n += source.width)
      {
        range.include(rows[k][n]);
      }
    }
  }
  const double size = std::sqrt(size2);
  this->Deviation = size < 1.0 ? size / (1.0 - size) : infinity;
  this->findRounding(source);
}

/// A derivative is the degree times the difference of two coefficients, each of which is off by roundings of its own.
void DerivativeBounds::findRounding(const SourceElement& source)
{
  // Roundings of a number that count: its own, and some of the conversion. Larger: shallow surfaces of fields that hardly
  // change count as noise; smaller: noise as surfaces.
  constexpr double roundings = 4.0 * std::numeric_limits<double>::epsilon();
  std::array<double, 2> largest{};
  for (std::size_t n = 0; n < source.control.size(); ++n)
  {
    double& ofKind = largest[n % source.width < 3 ? 0 : 1];
    ofKind = std::max(ofKind, std::abs(source.control[n]));
  }
  double inverse = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3 column(this->Inverse[0][k], this->Inverse[1][k], this->Inverse[2][k]);
    inverse +=
      2.0 * source.degrees[k] * (std::abs(column.x) + std::abs(column.y) + std::abs(column.z));
  }
  // Of homogeneous numbers derivatives are w p' - p w'.
  const double weight =
    source.isRational ? 2.0 * *std::max_element(source.weights.begin(), source.weights.end()) : 1.0;
  this->GeometryRounding = roundings * weight * largest[0] * inverse;
  this->FieldRounding = roundings * weight * largest[1] * inverse;
}

bool DerivativeBounds::isRegular() const
{
  return this->Deviation < infinity;
}

std::vector<std::array<Range, 3>> DerivativeBounds::gradient() const
{
  std::vector<std::array<Range, 3>> ranges(this->Field.size());
  for (std::size_t i = 0; i < ranges.size(); ++i)
  {
    double length2 = 0.0;
    for (const Range& along : this->Field[i])
    {
      length2 += along.magnitude() * along.magnitude();
    }
    const double radius = length2 > 0.0 ? this->Deviation * std::sqrt(length2) : 0.0;
    for (int j = 0; j < 3; ++j)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Range entry = sum(this->Field[i][k], { -radius, radius });
        const double factor = this->Inverse[j][k];
        ranges[i][j] = factor == 0.0 ? ranges[i][j] : sum(ranges[i][j], scaledBy(factor, entry));
      }
    }
  }
  return ranges;
}

Range DerivativeBounds::of(Quantity quantity) const
{
  const double slack = this->rounding(quantity);
  return knownOr(sum(boundsFrom(quantity, this->gradient()), { -slack, slack }));
}

double DerivativeBounds::rounding(Quantity quantity) const
{
  // Of the products of the largest derivatives: what counts as rounding.
  constexpr double share = 1e-13;
  if (quantity == Quantity::Expression)
  {
    return 0.0;
  }
  double largest = 0.0;
  for (const std::array<Range, 3>& row : this->Field)
  {
    for (int k = 0; k < 3; ++k)
    {
      for (int j = 0; j < 3; ++j)
      {
        largest += row[k].magnitude() * std::abs(this->Inverse[j][k]);
      }
    }
  }
  const double error = (share + this->GeometryRounding) * largest + this->FieldRounding;
  return orderOf(quantity) == 1 ? error : error * std::max(error, largest);
}

namespace
{

/// No eigenvalue of a symmetric matrix moves by more than the norm of what is added to the matrix (Weyl 1912): the middle
/// one of the middles of A = (G G + (G G)^T) / 2 by the norm of the radii at most.
Range boundsOfLambdaTwo(const std::vector<std::array<Range, 3>>& g)
{
  glm::dmat3 middle(0.0);
  glm::dmat3 radius(0.0);
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      Range entry = i == j ? square(g[i][i]) : Range{};
      for (int k = 0; k < 3; ++k)
      {
        if (i != j || k != i)
        {
          const Range both = sum(product(g[i][k], g[k][j]), product(g[j][k], g[k][i]));
          entry = sum(entry, scaledBy(0.5, both));
        }
      }
      middle[i][j] = 0.5 * (entry.lower + entry.upper);
      radius[i][j] = 0.5 * (entry.upper - entry.lower);
    }
  }
  const glm::dvec3 rows = radius * glm::dvec3(1.0);
  const double norm = std::max({ rows.x, rows.y, rows.z });
  if (!(norm < infinity))
  {
    return everything;
  }
  const double value = eigensystemOf(middle).values[1];
  return { value - norm, value + norm };
}

} // namespace

Range boundsFrom(Quantity quantity, const std::vector<std::array<Range, 3>>& g)
{
  Range result;
  const auto add = [&](double factor, const Range& term)
  { result = sum(result, scaledBy(factor, term)); };
  for (int i = 0; i < static_cast<int>(g.size()); ++i)
  {
    const int j = (i + 1) % 3;
    switch (quantity)
    {
      case Quantity::Value:
        break;
      case Quantity::GradientMagnitude:
        for (const Range& entry : g[i])
        {
          add(1.0, square(entry));
        }
        break;
      case Quantity::Divergence:
        add(1.0, g[i][i]);
        break;
      case Quantity::VorticityMagnitude:
        add(1.0, square(sum(g[i][j], scaledBy(-1.0, g[j][i]))));
        break;
      case Quantity::QCriterion:
        add(-0.5, square(g[i][i]));
        add(-1.0, product(g[i][j], g[j][i]));
        break;
      case Quantity::Expression:
        return everything;
      case Quantity::Lambda2:
        return boundsOfLambdaTwo(g);
    }
  }
  return result;
}

} // namespace hop
