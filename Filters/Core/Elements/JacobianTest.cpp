#include "Elements/JacobianTest.h"

#include "Elements/Bisection.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace hop
{
namespace
{

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// (X, Y, Z, w) or a derivative of (X, Y, Z, w).
using Row = std::array<ScaledPolynomial, 4>;

/// Degrees of the derivative along an axis: one less in the simplex in which the axis runs.
Degrees derivativeDegrees(Domain domain, const Degrees& degrees, int axis)
{
  const SimplexFactor& factor = factorOf(domain, axis);
  Degrees result = degrees;
  for (int a = factor.axis; a < factor.end(); ++a)
  {
    --result[a];
  }
  return result;
}

Row makeRow(Domain domain, const Degrees& degrees, const std::vector<glm::dvec4>& points)
{
  Row row;
  for (int c = 0; c < 4; ++c)
  {
    std::vector<double> values(points.size());
    std::transform(
      points.begin(), points.end(), values.begin(), [c](const glm::dvec4& x) { return x[c]; });
    row[c] = scaled(domain, degrees, std::move(values));
  }
  return row;
}

/// |a b c|, the determinant of the first three components.
ScaledPolynomial determinant(const Row& a, const Row& b, const Row& c)
{
  ScaledPolynomial sum;
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    ScaledPolynomial minor = b[j] * c[k];
    addProduct(-1.0, b[k], c[j], minor);
    if (i == 0)
    {
      sum = a[i] * minor;
    }
    else
    {
      addProduct(1.0, a[i], minor, sum);
    }
  }
  return sum;
}

/// The longest of homogeneous vectors, and the largest of their weights.
struct Largest
{
  double length = 0.0;
  double weight = 0.0;
};

Largest largest(const std::vector<glm::dvec4>& vectors)
{
  Largest result;
  for (const glm::dvec4& v : vectors)
  {
    result.length = std::max(result.length, glm::length(glm::dvec3(v)));
    result.weight = std::max(result.weight, std::abs(v.w));
  }
  return result;
}

glm::dvec4 meanOf(const std::vector<glm::dvec4>& vectors)
{
  return std::accumulate(vectors.begin(), vectors.end(), glm::dvec4(0.0)) /
    static_cast<double>(vectors.size());
}

/// Whether the spectral radius of a matrix without negative entries is proven to be below one: there are weights d > 0
/// with A d < d. Then 1 + E is regular for all |E| <= A, and its determinant is positive.
bool isContraction(const glm::dmat4& matrix)
{
  // Terms of the series 1 + A + A^2 + ..., whose sum times any d > 0 are such weights. Fewer: more elements go the long
  // way; more are hardly of use.
  constexpr int terms = 8;
  // The margin covers rounding. Smaller: more elements go the long way.
  constexpr double belowOne = 0.999;
  const glm::dvec4 one(1.0);
  glm::dvec4 weights = one;
  for (int n = 1; n < terms; ++n)
  {
    weights = one + matrix * weights;
  }
  return glm::all(glm::lessThan(matrix * weights, belowOne * weights));
}

/// Looks for a negative value of a polynomial by bisection. Coefficients at corners of pieces are values.
class SignSearch
{
public:
  SignSearch(Domain domain, const Degrees& degrees)
  {
    for (const LatticePoint& direction : facts(domain).edgeDirections)
    {
      this->Directions.emplace_back(domain, degrees, direction);
    }
    for (int c = 0; c < static_cast<int>(facts(domain).corners.size()); ++c)
    {
      this->Corners.push_back(
        coefficientIndex(domain, degrees, cornerLatticePoint(domain, degrees, c)));
    }
  }

  /// Whether a polynomial is found to have a value below -slack.
  bool goesBelow(std::vector<double> coefficients, double slack)
  {
    const std::ptrdiff_t most =
      JacobianTest::MaximumCoefficients / static_cast<std::ptrdiff_t>(coefficients.size());
    this->add(std::move(coefficients));
    for (std::ptrdiff_t n = 0; n < most && this->LowestCorner >= -slack; ++n)
    {
      const auto worst = std::min_element(this->Pieces.begin(), this->Pieces.end(),
        [](const Piece& a, const Piece& b) { return a.lowest < b.lowest; });
      if (worst->lowest >= -slack)
      {
        return false;
      }
      std::vector<double> first = std::move(worst->coefficients);
      std::swap(*worst, this->Pieces.back());
      this->Pieces.pop_back();
      std::vector<double> second;
      this->mostVariable(first).bisect(first, second);
      this->add(std::move(first));
      this->add(std::move(second));
    }
    return this->LowestCorner < -slack;
  }

private:
  struct Piece
  {
    std::vector<double> coefficients;
    double lowest = 0.0;
  };

  void add(std::vector<double> coefficients)
  {
    for (const int corner : this->Corners)
    {
      this->LowestCorner = std::min(this->LowestCorner, coefficients[corner]);
    }
    const double lowest = *std::min_element(coefficients.begin(), coefficients.end());
    this->Pieces.push_back({ std::move(coefficients), lowest });
  }

  /// The direction along which the coefficients vary most.
  const LatticeLines& mostVariable(const std::vector<double>& coefficients) const
  {
    const LatticeLines* most = &this->Directions.front();
    double largest = -1.0;
    for (const LatticeLines& lines : this->Directions)
    {
      const double variation = lines.variation(coefficients);
      most = variation > largest ? &lines : most;
      largest = std::max(largest, variation);
    }
    return *most;
  }

  std::vector<LatticeLines> Directions;
  std::vector<int> Corners;
  std::vector<Piece> Pieces;
  double LowestCorner = std::numeric_limits<double>::infinity();
};

} // namespace

/// Homogeneous control points relative to the first one, their derivatives, and how exact they are.
struct JacobianTest::ControlNet
{
  ControlNet(const JacobianTest& test, const BernsteinForm& form, double rounding)
    : rational(form.weights != nullptr)
  {
    const int count = coefficientCount(form.domain, form.degrees);
    const glm::dvec3 origin(controlPoint(form, 0));
    double farthest = 0.0;
    double extent = 0.0;
    this->points.reserve(count);
    for (int i = 0; i < count; ++i)
    {
      const double weight = this->rational ? form.weights[i] : 1.0;
      this->largestWeight = std::max(this->largestWeight, weight);
      const glm::dvec3 x(controlPoint(form, i));
      this->points.emplace_back(weight * (x - origin), weight);
      this->isFinite = this->isFinite && std::isfinite(x.x + x.y + x.z + form.coefficients[i].w);
      farthest = std::max(farthest, glm::length(x));
      extent = std::max(extent, glm::length(x - origin));
    }
    // Coordinates are sums of a few numbers of their own size.
    constexpr double epsilonsOfCoordinates = 4.0;
    this->exactness = epsilonsOfCoordinates * epsilon * farthest;
    this->error = this->exactness + rounding * extent;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->derivatives[axis].reserve(test.Derivatives[axis].pairs.size());
      for (const auto& [plus, minus] : test.Derivatives[axis].pairs)
      {
        this->derivatives[axis].push_back(
          static_cast<double>(form.degrees[axis]) * (this->points[plus] - this->points[minus]));
      }
    }
  }

  /// Bound on how much det J (or w^4 det J) changes when control points move by `change`, plus a bound on the
  /// rounding errors of its products.
  double slack(const Degrees& degrees, double change) const
  {
    // Relative to the product of the factors' lengths: some 450 epsilons, for a sum of up to as many products. Larger:
    // slightly inverted elements pass; smaller: rounding errors pass for inverted parts.
    constexpr double roundingOfProducts = 1e-13;
    const Largest all = largest(this->points);
    double lengths = 1.0;
    double changed = 1.0;
    double ofWeights = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Largest d = largest(this->derivatives[axis]);
      ofWeights = ofWeights * d.length + lengths * d.weight * all.length;
      lengths *= d.length;
      changed *= d.length + 2.0 * degrees[axis] * all.weight * change;
    }
    return all.weight * (changed - lengths) +
      roundingOfProducts * (all.weight * lengths + ofWeights);
  }

  bool rational;
  bool isFinite = true;
  double largestWeight = 0.0;
  std::vector<glm::dvec4> points;
  std::array<std::vector<glm::dvec4>, 3> derivatives;
  /// Rounding errors of the coordinates themselves; the same plus errors of the conversion. World units.
  double exactness = 0.0;
  double error = 0.0;
};

JacobianTest::JacobianTest(Domain domain, const Degrees& degrees)
  : ItsDomain(domain)
  , ItsDegrees(degrees)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    Derivative& derivative = this->Derivatives[axis];
    derivative.degrees = derivativeDegrees(domain, degrees, axis);
    for (const LatticePoint& point : latticePoints(domain, derivative.degrees))
    {
      const LatticePoint next{ point.i + (axis == 0), point.j + (axis == 1),
        point.k + (axis == 2) };
      derivative.pairs.push_back(
        { coefficientIndex(domain, degrees, next), coefficientIndex(domain, degrees, point) });
    }
  }
}

/// Whether M^-1 times (w, X) and its derivatives is strictly diagonally dominant everywhere, with weights of columns.
/// \param determinantOfMean receives a number with the sign of det M, which is that of det J then
///
/// Relative to the mean c of the control points the mean of (w, X) is (W, 0). With the means J and g of the derivatives
/// of X and w, M = (W g; 0 J), so that det M has the sign of det J, and M^-1 (w, X) = ((w - g y) / W, y), y = J^-1 X.
bool JacobianTest::isFarFromSingular(const ControlNet& net, double& determinantOfMean) const
{
  const glm::dvec4 meanPoint = meanOf(net.points);
  const glm::dvec3 center = glm::dvec3(meanPoint) / meanPoint.w;
  const auto centered = [&center](const glm::dvec4& x) { return glm::dvec3(x) - x.w * center; };
  glm::dmat3 mean;
  glm::dvec3 meanOfWeights;
  double lengths = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const glm::dvec4 d = meanOf(net.derivatives[axis]);
    mean[axis] = centered(d);
    meanOfWeights[axis] = d.w;
    lengths *= glm::length(mean[axis]);
  }
  // |det J| over the product of its columns' lengths from which on J^-1 is trusted. Larger: more elements go the long
  // way; smaller: the inverse's rounding errors, some epsilon / sliver, come near the margin that belowOne leaves.
  constexpr double sliver = 1e-6;
  determinantOfMean = glm::determinant(mean);
  if (!(std::abs(determinantOfMean) > sliver * lengths))
  {
    return false;
  }
  const glm::dmat3 inverse = glm::inverse(mean);
  const glm::dvec3 rowLengths =
    glm::sqrt(inverse[0] * inverse[0] + inverse[1] * inverse[1] + inverse[2] * inverse[2]);
  // The absolute value of M^-1 times a vector, its errors included.
  const auto magnitudes = [&](const glm::dvec3& x, double w, double error)
  {
    const glm::dvec3 y = inverse * x;
    const glm::dvec3 unsure = error * rowLengths;
    const double first =
      std::abs(w - glm::dot(meanOfWeights, y)) + glm::dot(glm::abs(meanOfWeights), unsure);
    return glm::dvec4(first / meanPoint.w, glm::abs(y) + unsure);
  };
  const double error = net.largestWeight * net.error;
  glm::dmat4 deviation(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const glm::dvec4& d : net.derivatives[axis])
    {
      deviation[axis + 1] = glm::max(deviation[axis + 1],
        magnitudes(centered(d) - mean[axis], d.w - meanOfWeights[axis],
          2.0 * this->ItsDegrees[axis] * error));
    }
  }
  if (net.rational)
  {
    for (const glm::dvec4& x : net.points)
    {
      deviation[0] = glm::max(deviation[0], magnitudes(centered(x), x.w - meanPoint.w, error));
    }
  }
  return isContraction(deviation);
}

ScaledPolynomial JacobianTest::determinant(const ControlNet& net) const
{
  const auto derivative = [&](int axis)
  { return makeRow(this->ItsDomain, this->Derivatives[axis].degrees, net.derivatives[axis]); };
  const Row u = derivative(0);
  const Row v = derivative(1);
  const Row w = derivative(2);
  ScaledPolynomial jacobian = hop::determinant(u, v, w);
  if (net.rational)
  {
    const Row x = makeRow(this->ItsDomain, this->ItsDegrees, net.points);
    jacobian = x[3] * jacobian;
    addProduct(-1.0, u[3], hop::determinant(x, v, w), jacobian);
    addProduct(1.0, v[3], hop::determinant(x, u, w), jacobian);
    addProduct(-1.0, w[3], hop::determinant(x, u, v), jacobian);
  }
  return jacobian;
}

ScaledPolynomial JacobianTest::determinant(const BernsteinForm& form) const
{
  return this->determinant(ControlNet(*this, form, 0.0));
}

JacobianSign JacobianTest::sign(const BernsteinForm& form, double rounding) const
{
  const ControlNet net(*this, form, rounding);
  if (!net.isFinite)
  {
    return JacobianSign::NotFinite;
  }
  double determinantOfMean = 0.0;
  if (this->isFarFromSingular(net, determinantOfMean))
  {
    return determinantOfMean > 0.0 ? JacobianSign::Positive : JacobianSign::Negative;
  }
  const ScaledPolynomial polynomial = this->determinant(net);
  std::vector<double> coefficients = unscaled(polynomial);
  const auto [lowest, highest] = std::minmax_element(coefficients.begin(), coefficients.end());
  if (std::max(-*lowest, *highest) <= net.slack(this->ItsDegrees, net.exactness))
  {
    return JacobianSign::Zero;
  }
  // The mean of the coefficients is the polynomial's mean over the domain: its sign occurs.
  const double sum = std::accumulate(coefficients.begin(), coefficients.end(), 0.0);
  if (sum < 0.0)
  {
    std::transform(coefficients.begin(), coefficients.end(), coefficients.begin(), std::negate<>());
  }
  SignSearch search(form.domain, polynomial.degrees);
  return search.goesBelow(std::move(coefficients), net.slack(this->ItsDegrees, net.error))
    ? JacobianSign::Mixed
    : sum < 0.0 ? JacobianSign::Negative
                : JacobianSign::Positive;
}

} // namespace hop
