#include "Elements/CollapsedFaces.h"

#include "Elements/LatticeRows.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{

namespace
{

/// How much of a number counts as zero in a collapsed face.
struct Rounding
{
  /// Of a component's largest derivative. Chosen between rounding, some 1e-15, and the least that derivatives are in
  /// faces that are not collapsed.
  static constexpr double OfDerivatives = 1e-11;
  /// Of a component's largest value, times the degree: a component that is constant has no derivatives but rounding.
  static constexpr double OfValues = 1e-15;
  /// Of the longest edge: the ends of one that is collapsed are no farther apart.
  static constexpr double OfEdges = 1e-9;
};

/// A face across a line of the domain, where the line's coordinate is 0 or 1.
struct LineEnd
{
  int axis = 0;
  bool isTop = false;

  bool holds(const LatticePoint& point, const Degrees& degrees) const
  {
    const std::array<int, 3> index{ point.i, point.j, point.k };
    return index[this->axis] == (this->isTop ? degrees[this->axis] : 0);
  }
};

double largestOf(const std::vector<double>& numbers)
{
  double largest = 0.0;
  for (const double number : numbers)
  {
    largest = std::max(largest, std::abs(number));
  }
  return largest;
}

/// Of each component: what counts as zero of its derivatives.
std::vector<double> roundingOf(
  const SourceElement& source, const std::array<std::vector<ScaledPolynomial>, 3>& derivatives)
{
  const int degree = *std::max_element(source.degrees.begin(), source.degrees.end());
  std::vector<double> rounding(source.width, 0.0);
  for (std::size_t i = 0; i < source.control.size(); ++i)
  {
    double& own = rounding[i % source.width];
    own = std::max(own, Rounding::OfValues * degree * std::abs(source.control[i]));
  }
  for (const std::vector<ScaledPolynomial>& column : derivatives)
  {
    for (std::size_t c = 0; c < column.size(); ++c)
    {
      rounding[c] = std::max(rounding[c], Rounding::OfDerivatives * largestOf(unscaled(column[c])));
    }
  }
  return rounding;
}

/// Whether a polynomial is zero in a face.
bool vanishesAt(const ScaledPolynomial& polynomial, const LineEnd& end, double rounding)
{
  const std::vector<double> coefficients = unscaled(polynomial);
  bool vanishes = true;
  std::size_t n = 0;
  visitLatticePoints(polynomial.domain, polynomial.degrees,
    [&](const LatticePoint& point)
    {
      const bool isZero = std::abs(coefficients[n++]) <= rounding;
      vanishes = vanishes && (isZero || !end.holds(point, polynomial.degrees));
    });
  return vanishes;
}

/// The quotient of a polynomial that vanishes in a face and the line's coordinate, or 1 less it.
ScaledPolynomial withoutFactor(const ScaledPolynomial& polynomial, const LineEnd& end)
{
  ScaledPolynomial result{ polynomial.domain, polynomial.degrees, {} };
  --result.degrees[end.axis];
  std::size_t n = 0;
  visitLatticePoints(polynomial.domain, polynomial.degrees,
    [&](const LatticePoint& point)
    {
      if (!end.holds(point, polynomial.degrees))
      {
        result.values.push_back(polynomial.values[n]);
      }
      ++n;
    });
  return result;
}

/// Divides the derivatives along one coordinate as often as all of them vanish in the face.
void divideAt(
  const LineEnd& end, const std::vector<double>& rounding, std::vector<ScaledPolynomial>& column)
{
  const auto vanishes = [&]
  {
    for (std::size_t c = 0; c < column.size(); ++c)
    {
      if (column[c].degrees[end.axis] == 0 || !vanishesAt(column[c], end, rounding[c]))
      {
        return false;
      }
    }
    return true;
  };
  while (vanishes())
  {
    for (ScaledPolynomial& polynomial : column)
    {
      polynomial = withoutFactor(polynomial, end);
    }
  }
}

} // namespace

void divideByCommonFactors(
  const SourceElement& source, std::array<std::vector<ScaledPolynomial>, 3>& derivatives)
{
  const std::vector<double> rounding = roundingOf(source, derivatives);
  for (const SimplexFactor& factor : facts(source.domain).factors)
  {
    for (int end = 0; end < 2 && factor.dimension == 1; ++end)
    {
      for (std::vector<ScaledPolynomial>& column : derivatives)
      {
        divideAt({ factor.axis, end == 1 }, rounding, column);
      }
    }
  }
}

bool hasCollapsedEdge(const SourceElement& source)
{
  const DomainFacts& domain = facts(source.domain);
  std::array<glm::dvec3, MaximumCorners> corners;
  for (std::size_t n = 0; n < domain.corners.size(); ++n)
  {
    const LatticePoint at = cornerLatticePoint(source.domain, source.degrees, static_cast<int>(n));
    const int i = coefficientIndex(source.domain, source.degrees, at);
    const double* row = &source.control[i * source.width];
    corners[n] = glm::dvec3(row[0], row[1], row[2]) / (source.isRational ? source.weights[i] : 1.0);
  }
  double shortest2 = std::numeric_limits<double>::infinity();
  double longest2 = 0.0;
  for (const auto& [a, b] : domain.edges)
  {
    const glm::dvec3 edge = corners[b] - corners[a];
    shortest2 = std::min(shortest2, glm::dot(edge, edge));
    longest2 = std::max(longest2, glm::dot(edge, edge));
  }
  return shortest2 <= Rounding::OfEdges * Rounding::OfEdges * longest2;
}

} // namespace hop
