#include "Elements/NodalBasis.h"

#include "Elements/Bernstein.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <type_traits>

namespace hop
{
namespace
{

using Extended = long double;

/// Points of the lattice of a line, triangle or tetrahedron, as barycentric indices that add up to the degree: for
/// 1 - u - v - w, u, v, w.
std::vector<std::array<int, 4>> simplexLattice(int dimension, int degree)
{
  std::vector<std::array<int, 4>> points;
  for (int k = 0; k <= (dimension > 2 ? degree : 0); ++k)
  {
    for (int j = 0; j <= (dimension > 1 ? degree - k : 0); ++j)
    {
      for (int i = 0; i <= degree - j - k; ++i)
      {
        points.push_back({ degree - i - j - k, i, j, k });
      }
    }
  }
  return points;
}

/// 1 - u - v - w, u, v, w.
using Barycentric = std::array<Extended, 4>;

/// B_index at a point: degree! / prod(index!) prod(barycentric^index).
Extended bernsteinAt(const std::array<int, 4>& index, const Barycentric& point, int degree)
{
  Extended value = 1.0L;
  int n = degree;
  for (int c = 0; c < 4; ++c)
  {
    for (int power = 1; power <= index[c]; ++power, --n)
    {
      value *= point[c] * n / power;
    }
  }
  return value;
}

/// Gauss-Jordan elimination with row pivoting.
std::vector<Extended> invert(std::vector<Extended> a, int n)
{
  std::vector<Extended> inverse(a.size(), 0.0L);
  for (int i = 0; i < n; ++i)
  {
    inverse[i * n + i] = 1.0L;
  }
  for (int column = 0; column < n; ++column)
  {
    int pivot = column;
    for (int row = column + 1; row < n; ++row)
    {
      pivot = std::abs(a[row * n + column]) > std::abs(a[pivot * n + column]) ? row : pivot;
    }
    for (int k = 0; pivot != column && k < n; ++k)
    {
      std::swap(a[pivot * n + k], a[column * n + k]);
      std::swap(inverse[pivot * n + k], inverse[column * n + k]);
    }
    const Extended scale = 1.0L / a[column * n + column];
    for (int row = 0; row < n; ++row)
    {
      const Extended factor = row == column ? 0.0L : a[row * n + column] * scale;
      for (int k = 0; factor != 0.0L && k < n; ++k)
      {
        a[row * n + k] -= factor * a[column * n + k];
        inverse[row * n + k] -= factor * inverse[column * n + k];
      }
    }
    for (int k = 0; k < n; ++k)
    {
      a[column * n + k] *= scale;
      inverse[column * n + k] *= scale;
    }
  }
  return inverse;
}

/// The inverse of V_ij = B_j(node i).
ConversionMatrix makeConversion(int dimension, int degree, const std::vector<Barycentric>& nodes)
{
  const auto lattice = simplexLattice(dimension, degree);
  const std::size_t n = lattice.size();
  std::vector<Extended> vandermonde(n * n);
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = 0; j < n; ++j)
    {
      vandermonde[i * n + j] = bernsteinAt(lattice[j], nodes[i], degree);
    }
  }
  ConversionMatrix matrix;
  matrix.extended = invert(std::move(vandermonde), static_cast<int>(n));
  matrix.rounded.assign(matrix.extended.begin(), matrix.extended.end());
  return matrix;
}

std::vector<Barycentric> equispacedNodes(int dimension, int degree)
{
  std::vector<Barycentric> nodes;
  for (const auto& point : simplexLattice(dimension, degree))
  {
    Barycentric node;
    std::transform(point.begin(), point.end(), node.begin(),
      [degree](int index) { return static_cast<Extended>(index) / degree; });
    nodes.push_back(node);
  }
  return nodes;
}

/// Computed at the first request, kept for the life of the program.
template <class Make>
const ConversionMatrix& cached(const std::array<int, 3>& key, const Make& make)
{
  static std::mutex mutex;
  static std::map<std::array<int, 3>, ConversionMatrix> known;
  const std::lock_guard<std::mutex> lock(mutex);
  auto [entry, isNew] = known.try_emplace(key);
  if (isNew)
  {
    entry->second = make();
  }
  return entry->second;
}

/// Largest sum of absolute values along a row.
double infinityNorm(const std::vector<double>& matrix, int columns)
{
  double norm = 0.0;
  for (std::size_t row = 0; row < matrix.size(); row += columns)
  {
    double sum = 0.0;
    for (int j = 0; j < columns; ++j)
    {
      sum += std::abs(matrix[row + j]);
    }
    norm = std::max(norm, sum);
  }
  return norm;
}

/// One row of a matrix times `Width` neighbouring columns of values, which stand in rows of `stride`.
template <int Width, class Number>
void multiplyRow(const Number* row, int columns, const Number* values, int stride, Number* result)
{
  std::array<Number, Width> sum{};
  for (int column = 0; column < columns; ++column, values += stride)
  {
    for (int c = 0; c < Width; ++c)
    {
      sum[c] += row[column] * values[c];
    }
  }
  std::copy(sum.begin(), sum.end(), result);
}

/// The product of a rows x columns matrix with `columns` rows of `width` values: `rows` rows as long.
template <class Number>
void multiply(
  const Number* matrix, int rows, int columns, const Number* values, int width, Number* result)
{
  // Sums that are kept at a time: few enough for registers, as many as an AVX register holds.
  constexpr int together = 4;
  for (int row = 0; row < rows; ++row, matrix += columns, result += width)
  {
    int c = 0;
    for (; c + together <= width; c += together)
    {
      multiplyRow<together>(matrix, columns, values + c, width, result + c);
    }
    for (; c < width; ++c)
    {
      multiplyRow<1>(matrix, columns, values + c, width, result + c);
    }
  }
}

/// Applies the matrix of one factor to every line, triangle or tetrahedron of values.
/// \param width number of values that stand side by side and are converted alike
template <class Number>
void applyFactor(const std::vector<Number>& matrix, int size, int width,
  const std::vector<Number>& values, std::vector<Number>& result)
{
  const std::size_t block = static_cast<std::size_t>(size) * width;
  for (std::size_t start = 0; start < values.size(); start += block)
  {
    multiply(matrix.data(), size, size, &values[start], width, &result[start]);
  }
}

template <class Number>
const std::vector<Number>& entries(const ConversionMatrix& matrix)
{
  if constexpr (std::is_same_v<Number, double>)
  {
    return matrix.rounded;
  }
  else
  {
    return matrix.extended;
  }
}

} // namespace

std::vector<long double> gaussLobattoPoints(int degree)
{
  // Newton's method on (1 - x^2) P'_n(x) from the Chebyshev points, which are near; it converges in far fewer steps
  // than the most. P_n by Legendre's recurrence n P_n = (2n - 1) x P_{n-1} - (n - 1) P_{n-2}.
  constexpr int mostSteps = 60;
  std::vector<Extended> points(degree + 1);
  for (int i = 0; i <= degree; ++i)
  {
    Extended x = -std::cos(3.14159265358979323846264338L * i / degree);
    for (int step = 0; step < mostSteps && i > 0 && i < degree; ++step)
    {
      Extended previous = 1.0L;
      Extended legendre = x;
      for (int n = 2; n <= degree; ++n)
      {
        const Extended next = ((2 * n - 1) * x * legendre - (n - 1) * previous) / n;
        previous = legendre;
        legendre = next;
      }
      // (1 - x^2) P'_n = n (P_{n-1} - x P_n), and its derivative is -n (n + 1) P_n.
      x += (previous - x * legendre) / ((degree + 1) * legendre);
    }
    points[i] = 0.5L * (1.0L + x);
  }
  points.front() = 0.0L;
  points.back() = 1.0L;
  return points;
}

const ConversionMatrix& equispacedToBernstein(int dimension, int degree)
{
  return cached({ dimension, degree, 0 },
    [&]() { return makeConversion(dimension, degree, equispacedNodes(dimension, degree)); });
}

const ConversionMatrix& gaussLobattoToBernstein(int degree)
{
  return cached({ 1, degree, 1 },
    [&]()
    {
      std::vector<Barycentric> nodes;
      for (const Extended t : gaussLobattoPoints(degree))
      {
        nodes.push_back({ 1.0L - t, t, 0.0L, 0.0L });
      }
      return makeConversion(1, degree, nodes);
    });
}

NodalBasis::NodalBasis(Domain domain, const Degrees& degrees)
  : ItsDomain(domain)
  , ItsDegrees(degrees)
  , Coefficients(hop::coefficientCount(domain, degrees))
{
  const auto [lowest, highest] = std::minmax_element(degrees.begin(), degrees.end());
  if (*lowest < 1 || *highest > maximumInputDegree(domain))
  {
    throw std::invalid_argument(
      "degree outside 1 to " + std::to_string(maximumInputDegree(domain)));
  }
}

NodalBasis NodalBasis::lagrange(Domain domain, const Degrees& degrees,
  const std::vector<LatticePoint>& order, NodeSpacing spacing)
{
  NodalBasis basis(domain, degrees);
  basis.placeNodes(order);
  basis.addLatticeFactors(domain == Domain::Hexahedron ? spacing : NodeSpacing::Uniform);
  return basis;
}

NodalBasis NodalBasis::bezier(
  Domain domain, const Degrees& degrees, const std::vector<LatticePoint>& order)
{
  NodalBasis basis(domain, degrees);
  basis.placeNodes(order);
  return basis;
}

NodalBasis NodalBasis::sampled(
  Domain domain, const Degrees& degrees, const std::vector<double>& shapeAtLattice)
{
  NodalBasis basis(domain, degrees);
  if (shapeAtLattice.empty() || shapeAtLattice.size() % basis.Coefficients != 0)
  {
    throw std::invalid_argument("the shape functions do not fit the element");
  }
  basis.Nodes = static_cast<int>(shapeAtLattice.size()) / basis.Coefficients;
  basis.Dense = shapeAtLattice;
  basis.addLatticeFactors(NodeSpacing::Uniform);
  std::vector<double> converted(basis.Dense.size());
  for (const Factor& factor : basis.Factors)
  {
    applyFactor(
      factor.matrix->rounded, factor.size, factor.stride * basis.Nodes, basis.Dense, converted);
    basis.Dense.swap(converted);
  }
  basis.Factors.clear();
  basis.Norm = infinityNorm(basis.Dense, basis.Nodes);
  return basis;
}

void NodalBasis::placeNodes(const std::vector<LatticePoint>& order)
{
  std::vector<int> nodeAt(this->Coefficients, -1);
  for (const LatticePoint& point : order)
  {
    if (!inLattice(this->ItsDomain, this->ItsDegrees, point))
    {
      throw std::invalid_argument("a node lies outside the element's lattice");
    }
    const int index = coefficientIndex(this->ItsDomain, this->ItsDegrees, point);
    nodeAt[index] = static_cast<int>(this->Place.size());
    this->Place.push_back(index);
  }
  if (static_cast<int>(order.size()) != this->Coefficients ||
    std::count(nodeAt.begin(), nodeAt.end(), -1) > 0)
  {
    throw std::invalid_argument("the nodes do not fill the element's lattice");
  }
  this->Nodes = this->Coefficients;
}

int NodalBasis::addFactor(const ConversionMatrix& matrix, int stride)
{
  const int size = static_cast<int>(std::lround(std::sqrt(matrix.rounded.size())));
  this->Factors.push_back({ &matrix, size, stride });
  this->Norm *= infinityNorm(matrix.rounded, size);
  return size;
}

void NodalBasis::addLatticeFactors(NodeSpacing spacing)
{
  int stride = 1;
  for (const SimplexFactor& simplex : facts(this->ItsDomain).factors)
  {
    const int degree = this->ItsDegrees[simplex.axis];
    const ConversionMatrix& matrix = spacing == NodeSpacing::Uniform
      ? equispacedToBernstein(simplex.dimension, degree)
      : gaussLobattoToBernstein(degree);
    stride *= this->addFactor(matrix, stride);
  }
}

bool NodalBasis::isIllConditioned() const
{
  // Norm of the conversion from which on it is done in extended precision. Below it doubles lose 6 of their 16 digits
  // at most, so that more are left than single precision has. Larger: fewer conversions pay for extended precision;
  // smaller: more do.
  constexpr double illConditioned = 1e6;
  return this->Norm > illConditioned;
}

double NodalBasis::conversionError() const
{
  // Epsilons of rounding that an entry of the matrix and the sum over its row are allowed together.
  constexpr double epsilons = 4.0;
  const double epsilon =
    this->isIllConditioned() && this->Dense.empty() && sizeof(Extended) > sizeof(double)
    ? static_cast<double>(std::numeric_limits<Extended>::epsilon())
    : std::numeric_limits<double>::epsilon();
  return epsilons * epsilon * this->Norm;
}

template <class Number>
void NodalBasis::convert(const double* nodal, int components, double* coefficients) const
{
  std::vector<Number> values(static_cast<std::size_t>(this->Coefficients) * components);
  std::vector<Number> converted(values.size());
  for (int node = 0; node < this->Nodes; ++node)
  {
    std::copy_n(nodal + static_cast<std::ptrdiff_t>(node) * components, components,
      values.begin() + static_cast<std::ptrdiff_t>(this->Place[node]) * components);
  }
  for (const Factor& factor : this->Factors)
  {
    applyFactor(
      entries<Number>(*factor.matrix), factor.size, factor.stride * components, values, converted);
    values.swap(converted);
  }
  std::copy(values.begin(), values.end(), coefficients);
}

void NodalBasis::toBernstein(const double* nodal, int components, double* coefficients) const
{
  if (!this->Dense.empty())
  {
    multiply(this->Dense.data(), this->Coefficients, this->Nodes, nodal, components, coefficients);
  }
  else if (this->isIllConditioned())
  {
    this->convert<Extended>(nodal, components, coefficients);
  }
  else
  {
    this->convert<double>(nodal, components, coefficients);
  }
}

} // namespace hop
