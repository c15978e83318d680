#include "NodalBasis.h"

#include "Bernstein.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

namespace hop
{
namespace
{

using Extended = long double;

/// Points (as powers of 1-sum, u, v, w) of the lattice of a line, triangle or tetrahedron.
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

/// B_index at the lattice point: degree! / prod(index!) prod(barycentric^index).
Extended bernsteinAt(const std::array<int, 4>& index, const std::array<int, 4>& point, int degree)
{
  Extended value = 1.0L;
  int n = degree;
  for (int c = 0; c < 4; ++c)
  {
    const Extended barycentric = static_cast<Extended>(point[c]) / degree;
    for (int power = 1; power <= index[c]; ++power, --n)
    {
      value *= barycentric * n / power;
    }
  }
  return value;
}

/// Gauss-Jordan elimination with row pivoting.
std::vector<double> invert(std::vector<Extended> a, int n)
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
  return { inverse.begin(), inverse.end() };
}

std::vector<double> makeConversion(int dimension, int degree)
{
  const auto lattice = simplexLattice(dimension, degree);
  const int n = static_cast<int>(lattice.size());
  std::vector<Extended> vandermonde(static_cast<std::size_t>(n) * n);
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      vandermonde[i * n + j] = bernsteinAt(lattice[j], lattice[i], degree);
    }
  }
  return invert(std::move(vandermonde), n);
}

double infinityNorm(const std::vector<double>& matrix, int n)
{
  double norm = 0.0;
  for (int i = 0; i < n; ++i)
  {
    double row = 0.0;
    for (int j = 0; j < n; ++j)
    {
      row += std::abs(matrix[i * n + j]);
    }
    norm = std::max(norm, row);
  }
  return norm;
}

} // namespace

const std::vector<double>& equispacedToBernstein(int dimension, int degree)
{
  static std::mutex mutex;
  static std::map<std::pair<int, int>, std::vector<double>> known;
  const std::lock_guard<std::mutex> lock(mutex);
  auto [entry, isNew] = known.try_emplace({ dimension, degree });
  if (isNew)
  {
    entry->second = makeConversion(dimension, degree);
  }
  return entry->second;
}

NodalBasis::NodalBasis(
  Domain domain, const Degrees& degrees, const std::vector<LatticePoint>& order)
  : ItsDomain(domain)
  , ItsDegrees(degrees)
{
  const auto [lowest, highest] = std::minmax_element(degrees.begin(), degrees.end());
  if (*lowest < 1 || *highest > MaximumDegree)
  {
    throw std::invalid_argument("degree outside 1 to " + std::to_string(MaximumDegree));
  }
  const int count = coefficientCount(domain, degrees);
  std::vector<int> nodeAt(count, -1);
  for (const LatticePoint& point : order)
  {
    if (!inLattice(domain, degrees, point))
    {
      throw std::invalid_argument("a node lies outside the element's lattice");
    }
    const int index = coefficientIndex(domain, degrees, point);
    nodeAt[index] = static_cast<int>(this->Place.size());
    this->Place.push_back(index);
  }
  if (static_cast<int>(order.size()) != count || std::count(nodeAt.begin(), nodeAt.end(), -1) > 0)
  {
    throw std::invalid_argument("the nodes do not fill the element's lattice");
  }
  for (std::size_t corner = 0; corner < facts(domain).corners.size(); ++corner)
  {
    this->CornerNodes.push_back(nodeAt[coefficientIndex(
      domain, degrees, cornerLatticePoint(domain, degrees, static_cast<int>(corner)))]);
  }

  const auto addFactor = [&](int dimension, int degree, int stride)
  {
    const std::vector<double>& matrix = equispacedToBernstein(dimension, degree);
    const int size = static_cast<int>(std::lround(std::sqrt(matrix.size())));
    this->Factors.push_back({ &matrix, size, stride });
    this->Norm *= infinityNorm(matrix, size);
    return size;
  };
  switch (domain)
  {
    case Domain::Tetrahedron:
      addFactor(3, degrees[0], 1);
      break;
    case Domain::Wedge:
      addFactor(1, degrees[2], addFactor(2, degrees[0], 1));
      break;
    default:
      addFactor(
        1, degrees[2], addFactor(1, degrees[0], 1) * addFactor(1, degrees[1], degrees[0] + 1));
  }
}

void NodalBasis::toBernstein(const double* nodal, int components, double* coefficients) const
{
  const int count = this->nodeCount();
  for (int node = 0; node < count; ++node)
  {
    std::copy_n(
      nodal + node * components, components, coefficients + this->Place[node] * components);
  }
  std::vector<double> line;
  for (const Factor& factor : this->Factors)
  {
    line.resize(static_cast<std::size_t>(factor.size) * components);
    const int block = factor.size * factor.stride;
    for (int start = 0; start < count; ++start)
    {
      if (start % block >= factor.stride)
      {
        continue; // not the first value of a line
      }
      std::fill(line.begin(), line.end(), 0.0);
      for (int row = 0; row < factor.size; ++row)
      {
        for (int column = 0; column < factor.size; ++column)
        {
          const double entry = (*factor.matrix)[row * factor.size + column];
          const double* value = coefficients + (start + column * factor.stride) * components;
          for (int c = 0; c < components; ++c)
          {
            line[row * components + c] += entry * value[c];
          }
        }
      }
      for (int row = 0; row < factor.size; ++row)
      {
        std::copy_n(line.data() + row * components, components,
          coefficients + (start + row * factor.stride) * components);
      }
    }
  }
}

} // namespace hop
