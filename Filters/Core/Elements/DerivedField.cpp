#include "Elements/DerivedField.h"

#include "Elements/LatticeRows.h"
#include "Elements/LowerDegrees.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace hop
{

namespace
{

/// How much of a number counts as rounding.
struct RoundingShare
{
  /// Of the largest Jacobian entry, of a determinant: sums of some ten products each. Smaller: the degrees of straight
  /// cells stay as high as those of curved ones; larger: slightly curved cells count as straight.
  static constexpr double Map = 1e-13;
  /// Of the largest weight: a smaller one is none. Chosen between rounding, some 1e-15, and the least value that a
  /// determinant has in sound cells.
  static constexpr double Weight = 1e-11;
  /// Of the largest coefficient of a gradient, a determinant, a numerator or a denominator: their degrees are lowered
  /// as far as this allows, in several steps. Smaller: bent elements of degree 4 cost up to ten times as much; larger:
  /// particles are off their isovalue by as much.
  static constexpr double Degree = 1e-12;
  /// The same where particles stand on the field itself. Larger: components of the surface that are shallower than this
  /// may be missed; smaller: cells take longer to split, with the third power of the degree.
  static constexpr double DegreeOfProofs = 1e-8;
};

/// Highest degree that the products may have before their degrees are lowered. Larger: a cell takes seconds to derive.
constexpr int MostBeforeTrimming = 3 * MaximumDegree / 2;

/// Of the Bernstein coefficients, and so of all values.
Range hullOf(const ScaledPolynomial& polynomial)
{
  const std::vector<double> coefficients = unscaled(polynomial);
  const auto [lower, upper] = std::minmax_element(coefficients.begin(), coefficients.end());
  return { *lower, *upper };
}

double meanOf(const ScaledPolynomial& polynomial)
{
  double sum = 0.0;
  for (const double coefficient : unscaled(polynomial))
  {
    sum += coefficient;
  }
  return sum / static_cast<double>(polynomial.values.size());
}

ScaledPolynomial constant(Domain domain, double value)
{
  return { domain, { 0, 0, 0 }, { value } };
}

/// factor_0 p_0 + factor_1 p_1 + factor_2 p_2.
ScaledPolynomial combined(const glm::dvec3& factors, const std::vector<ScaledPolynomial>& p)
{
  return sumOf({ { factors[0], &p[0] }, { factors[1], &p[1] }, { factors[2], &p[2] } });
}

/// Terms that are zero are left out; of these alone the sum is zero, of degree 0.
ScaledPolynomial sumOfProducts(
  std::vector<std::tuple<double, const ScaledPolynomial*, const ScaledPolynomial*>> terms)
{
  ScaledPolynomial sum = constant(std::get<1>(terms.front())->domain, 0.0);
  terms.erase(
    std::remove_if(terms.begin(), terms.end(),
      [](const auto& term) { return isZero(*std::get<1>(term)) || isZero(*std::get<2>(term)); }),
    terms.end());
  for (const auto& [factor, a, b] : terms)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      sum.degrees[axis] = std::max(sum.degrees[axis], a->degrees[axis] + b->degrees[axis]);
    }
  }
  sum.values.assign(coefficientCount(sum.domain, sum.degrees), 0.0);
  for (const auto& [factor, a, b] : terms)
  {
    // One factor takes all degrees that the product lacks.
    const Degrees wanted{ sum.degrees[0] - b->degrees[0], sum.degrees[1] - b->degrees[1],
      sum.degrees[2] - b->degrees[2] };
    addProduct(factor, elevated(*a, wanted), *b, sum);
  }
  return sum;
}

/// A polynomial of the lowest degrees that change nothing that matters.
/// \param share of the largest coefficient, that each step may change
ScaledPolynomial trimmed(ScaledPolynomial polynomial, double share)
{
  const double largest = hullOf(polynomial).magnitude();
  return lowered(std::move(polynomial), share * largest);
}

} // namespace

Derivation::Derivation(const SourceElement& source, Quantity quantity, StandIn standIn)
  : Source(source)
  , ItsQuantity(quantity)
  , ItsStandIn(standIn)
  , Components(source.width - 3)
  , Weight(weightOf(source))
{
  Columns world = homogeneousDerivatives(source);
  glm::dmat3 mean(1.0);
  for (int k = 0; k < 3; ++k)
  {
    this->Field[k].assign(world[k].begin() + 3, world[k].end());
    for (int c = 0; c < 3; ++c)
    {
      mean[k][c] = meanOf(world[k][c]);
    }
  }
  this->Inverse = glm::inverse(mean);
  for (int c = 0; c < 3; ++c)
  {
    const glm::dvec3 row(this->Inverse[0][c], this->Inverse[1][c], this->Inverse[2][c]);
    const glm::dvec3 sizes = glm::abs(row);
    const int degree = *std::max_element(source.degrees.begin(), source.degrees.end());
    const double error = 4.0 * degree * (sizes.x + sizes.y + sizes.z) * source.coordinateError;
    for (int k = 0; k < 3; ++k)
    {
      this->Map[k].push_back(lowered(combined(row, world[k]), std::max(RoundingShare::Map, error)));
    }
  }
}

/// adj(Y') Inverse: entry [k][j] takes a derivative along coordinate k to one along world axis j, times the determinant
/// of Y'.
Derivation::Columns Derivation::adjugate() const
{
  Columns result;
  for (int k = 0; k < 3; ++k)
  {
    const std::vector<ScaledPolynomial>& a = this->Map[(k + 1) % 3];
    const std::vector<ScaledPolynomial>& b = this->Map[(k + 2) % 3];
    std::vector<ScaledPolynomial> cross;
    for (int c = 0; c < 3; ++c)
    {
      const int d = (c + 1) % 3;
      const int e = (c + 2) % 3;
      cross.push_back(sumOfProducts({ { 1.0, &a[d], &b[e] }, { -1.0, &a[e], &b[d] } }));
    }
    result[k] = std::move(cross);
  }
  return result;
}

/// The entries of G det(Y').
/// \param share by which degrees are lowered
std::vector<std::array<ScaledPolynomial, 3>> Derivation::gradientNumerators(
  const Columns& adjugate, double share) const
{
  std::vector<std::array<ScaledPolynomial, 3>> gradient(this->Components);
  for (int j = 0; j < 3; ++j)
  {
    Columns toWorld;
    for (int k = 0; k < 3; ++k)
    {
      toWorld[k].push_back(combined(this->Inverse[j], adjugate[k]));
    }
    for (int i = 0; i < this->Components; ++i)
    {
      ScaledPolynomial entry = sumOfProducts({ { 1.0, &this->Field[0][i], &toWorld[0][0] },
        { 1.0, &this->Field[1][i], &toWorld[1][0] }, { 1.0, &this->Field[2][i], &toWorld[2][0] } });
      gradient[i][j] = trimmed(std::move(entry), share);
    }
  }
  return gradient;
}

/// The quantity, or its square, times the determinant to the power of orderOf().
ScaledPolynomial Derivation::numerator(
  const std::vector<std::array<ScaledPolynomial, 3>>& gradient) const
{
  std::vector<ScaledPolynomial> curl;
  std::vector<std::tuple<double, const ScaledPolynomial*, const ScaledPolynomial*>> terms;
  curl.reserve(3);
  for (int i = 0; i < this->Components; ++i)
  {
    const int j = (i + 1) % 3;
    switch (this->ItsQuantity)
    {
      case Quantity::Value:
        break;
      case Quantity::Divergence:
        return sumOf(
          { { 1.0, &gradient[0][0] }, { 1.0, &gradient[1][1] }, { 1.0, &gradient[2][2] } });
      case Quantity::GradientMagnitude:
        for (const ScaledPolynomial& entry : gradient[i])
        {
          terms.emplace_back(1.0, &entry, &entry);
        }
        break;
      case Quantity::VorticityMagnitude:
        curl.push_back(sumOf({ { 1.0, &gradient[i][j] }, { -1.0, &gradient[j][i] } }));
        terms.emplace_back(1.0, &curl.back(), &curl.back());
        break;
      case Quantity::QCriterion:
        terms.emplace_back(-0.5, &gradient[i][i], &gradient[i][i]);
        terms.emplace_back(-1.0, &gradient[i][j], &gradient[j][i]);
        break;
      case Quantity::Lambda2:
      case Quantity::Expression:
        break; // no quotient of polynomials
    }
  }
  return sumOfProducts(terms);
}

bool Derivation::isAffine() const
{
  for (const std::vector<ScaledPolynomial>& column : this->Map)
  {
    for (const ScaledPolynomial& entry : column)
    {
      if (entry.values.size() > 1)
      {
        return false;
      }
    }
  }
  return this->Weight.values.size() == 1;
}

Degrees Derivation::degreesAtMost() const
{
  const int order = orderOf(this->ItsQuantity);
  Degrees result{ 0, 0, 0 };
  for (int a = 0; a < 3; ++a)
  {
    std::array<int, 3> map{ 0, 0, 0 };
    std::array<int, 3> field{ 0, 0, 0 };
    for (int k = 0; k < 3; ++k)
    {
      for (const ScaledPolynomial& entry : this->Map[k])
      {
        map[k] = std::max(map[k], entry.degrees[a]);
      }
      for (const ScaledPolynomial& entry : this->Field[k])
      {
        field[k] = std::max(field[k], entry.degrees[a]);
      }
    }
    const int determinant = map[0] + map[1] + map[2];
    int gradient = 0;
    for (int k = 0; k < 3; ++k)
    {
      gradient = std::max(gradient, field[k] + determinant - map[k]);
    }
    const int weight = this->Weight.degrees[a];
    result[a] = std::max(order * gradient + weight, order * determinant + this->Source.degrees[a]);
  }
  return result;
}

DerivedElement Derivation::element() const
{
  const Degrees most = this->degreesAtMost();
  if (*std::max_element(most.begin(), most.end()) > MostBeforeTrimming)
  {
    DerivedElement none;
    none.state = DerivedElement::State::DegreeTooHigh;
    return none;
  }
  const Columns adjugate = this->adjugate();
  const bool isProof = this->ItsStandIn == StandIn::Proof && !this->isAffine();
  const double share = isProof ? RoundingShare::DegreeOfProofs : RoundingShare::Degree;
  ScaledPolynomial determinant = lowered(
    sumOfProducts({ { 1.0, &this->Map[0][0], &adjugate[0][0] },
      { 1.0, &this->Map[0][1], &adjugate[0][1] }, { 1.0, &this->Map[0][2], &adjugate[0][2] } }),
    RoundingShare::Map);
  determinant = trimmed(std::move(determinant), share);
  const ScaledPolynomial numerator =
    trimmed(this->numerator(this->gradientNumerators(adjugate, share)), share);
  const ScaledPolynomial denominator = trimmed(
    orderOf(this->ItsQuantity) == 2 ? determinant * determinant : std::move(determinant), share);
  DerivedElement result = this->assemble(numerator, denominator);
  result.standIn = isProof ? StandIn::Proof : StandIn::Surface;
  return result;
}

DerivedElement Derivation::assemble(
  const ScaledPolynomial& numerator, const ScaledPolynomial& denominator) const
{
  // One of the denominators' powers: a constant one is divided by here, so that the field is a polynomial.
  const bool isPolynomial = denominator.values.size() == 1 && !this->Source.isRational;
  const double divisor = isPolynomial ? denominator.values[0] : 1.0;
  const Domain domain = this->Source.domain;
  const ScaledPolynomial unit = constant(domain, 1.0);
  const ScaledPolynomial& factor = isPolynomial ? unit : denominator;
  std::vector<ScaledPolynomial> components = componentsOf(this->Source);
  for (int c = 0; c < 3 && !this->Source.isRational; ++c)
  {
    components[c] = lowered(std::move(components[c]), this->Source.coordinateError);
  }
  std::array<ScaledPolynomial, 5> parts{ factor * components[0], factor * components[1],
    factor * components[2], numerator * this->Weight, factor * this->Weight };
  DerivedElement result;
  for (const ScaledPolynomial& part : parts)
  {
    for (int a = 0; a < 3; ++a)
    {
      // A flat cell may be constant along an axis, but elements are at least linear.
      result.degrees[a] = std::max({ 1, result.degrees[a], part.degrees[a] });
    }
  }
  if (*std::max_element(result.degrees.begin(), result.degrees.end()) > MaximumDegree)
  {
    result.state = DerivedElement::State::DegreeTooHigh;
    return result;
  }
  std::array<std::vector<double>, 5> rows;
  for (int r = 0; r < 5; ++r)
  {
    rows[r] = unscaled(elevated(parts[r], result.degrees));
  }
  // Control points are quotients by the weights: where one of these is no larger than rounding they mean nothing.
  const double leastWeight =
    RoundingShare::Weight * *std::max_element(rows[4].begin(), rows[4].end());
  if (!(*std::min_element(rows[4].begin(), rows[4].end()) > leastWeight) || !(divisor > 0.0))
  {
    return result;
  }
  result.state = DerivedElement::State::Sound;
  for (std::size_t i = 0; i < rows[0].size(); ++i)
  {
    result.coefficients.emplace_back(rows[0][i], rows[1][i], rows[2][i], rows[3][i] / divisor);
  }
  if (!isPolynomial)
  {
    result.weights = std::move(rows[4]);
  }
  return result;
}

} // namespace hop
