#include "Isolation/SurfaceBoxes.h"

#include "ElementCases.h"
#include "Elements/NodalBasis.h"
#include "SurfaceSeeds.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>

namespace hop::testing
{
namespace
{

/// A random polynomial in Chebyshev form: the sum of c_ijk T_i(x) T_j(y) T_k(z), x = 2u - 1 and so on, over the lattice
/// of the element. It has as many waves as its degree allows, and is evaluated on a grid quickly.
class ChebyshevSum
{
public:
  ChebyshevSum(const ElementCase& which, Random& random)
    : Which(which)
    , Size(*std::max_element(which.degrees.begin(), which.degrees.end()) + 1)
    , Factors(static_cast<std::size_t>(Size) * Size * Size, 0.0)
  {
    for (const auto& [i, j, k] : latticePoints(which.domain, which.degrees))
    {
      this->Factors[i + Size * (j + Size * k)] = randomNumber(random);
    }
  }

  /// Values at the (n + 1)^3 points of a lattice of the unit cube, the first coordinate fastest, by
  /// one axis after the other.
  std::vector<double> onLattice(int n) const
  {
    std::vector<double> chebyshev;
    for (int i = 0; i < Size; ++i)
    {
      for (int a = 0; a <= n; ++a)
      {
        chebyshev.push_back(std::cos(i * std::acos(2.0 * a / n - 1.0)));
      }
    }
    std::vector<double> values = this->Factors;
    for (int axis = 0; axis < 3; ++axis)
    {
      values = this->expandLastAxis(values, chebyshev, n + 1);
    }
    return values;
  }

  /// One straight element that holds the polynomial over the reference domain.
  ElementMesh element() const
  {
    const auto lattice = latticePoints(this->Which.domain, this->Which.degrees);
    std::vector<Coefficient> nodal;
    for (const LatticePoint& point : lattice)
    {
      const ReferencePoint u = latticePosition(this->Which.degrees, point);
      nodal.emplace_back(u.xyz, this->at(u));
    }
    ElementMesh mesh;
    Element element;
    element.domain = this->Which.domain;
    element.degrees = this->Which.degrees;
    mesh.elements.push_back(element);
    mesh.coefficients.resize(lattice.size());
    NodalBasis::lagrange(this->Which.domain, this->Which.degrees, lattice)
      .toBernstein(&nodal[0].x, 4, &mesh.coefficients[0].x);
    findFaceNeighbors(mesh, 1e-9);
    return mesh;
  }

private:
  double at(const ReferencePoint& u) const
  {
    const glm::dvec3 angle = glm::acos(2.0 * u.xyz - 1.0);
    double sum = 0.0;
    for (const auto& [i, j, k] : latticePoints(this->Which.domain, this->Which.degrees))
    {
      sum += this->Factors[i + Size * (j + Size * k)] * std::cos(i * angle.x) *
        std::cos(j * angle.y) * std::cos(k * angle.z);
    }
    return sum;
  }

  /// Replaces the last axis, the slowest one, by values at `points` places and makes it the first axis.
  std::vector<double> expandLastAxis(
    const std::vector<double>& values, const std::vector<double>& chebyshev, int points) const
  {
    const std::size_t lines = values.size() / Size;
    std::vector<double> result(lines * points, 0.0);
    for (std::size_t line = 0; line < lines; ++line)
    {
      double* out = &result[line * points];
      for (int i = 0; i < Size; ++i)
      {
        const double factor = values[i * lines + line];
        const double* basis = &chebyshev[static_cast<std::size_t>(i) * points];
        for (int a = 0; a < points; ++a)
        {
          out[a] += factor * basis[a];
        }
      }
    }
    return result;
  }

  ElementCase Which;
  int Size;
  std::vector<double> Factors;
};

/// Components of a surface on a lattice of n^3 cubes over a reference domain: groups of neighbouring cells in which
/// values change their sign. Of a cube that leaves the domain only the corners inside count.
class LatticeComponents
{
public:
  LatticeComponents(Domain domain, int n, const std::vector<double>& values, double isovalue)
    : N(n)
    , CellNumber(static_cast<std::size_t>(n) * n * n, -1)
  {
    this->findCells(domain, values, isovalue);
    this->joinNeighbouringCells();
  }

  int count() const
  {
    int roots = 0;
    for (int c = 0; c < static_cast<int>(this->Parent.size()); ++c)
    {
      roots += this->Parent[c] == c;
    }
    return roots;
  }

  /// Marks the components within one cell of a point.
  void visit(const ReferencePoint& u, std::vector<char>& seen)
  {
    seen.resize(this->Parent.size(), 0);
    const glm::ivec3 cell(glm::floor(u.xyz * static_cast<double>(this->N)));
    this->forEachAround(cell, [&](int other) { seen[this->root(other)] = 1; });
  }

  int countUnseen(const std::vector<char>& seen) const
  {
    int unseen = 0;
    for (int c = 0; c < static_cast<int>(this->Parent.size()); ++c)
    {
      unseen += this->Parent[c] == c && (seen.empty() || !seen[c]);
    }
    return unseen;
  }

private:
  /// The side of the isovalue of each point, as a bit; no bit for points outside the domain.
  std::vector<unsigned char> sidesOfPoints(
    Domain domain, const std::vector<double>& values, double isovalue) const
  {
    std::vector<unsigned char> sides(values.size(), 0);
    const int n = this->N;
    for (int k = 0; k <= n; ++k)
    {
      for (int j = 0; j <= n; ++j)
      {
        const std::size_t row = this->pointIndex(0, j, k);
        for (int i = 0; i <= n && inLattice(domain, { n, n, n }, { i, j, k }); ++i)
        {
          sides[row + i] = values[row + i] < isovalue ? 1 : values[row + i] > isovalue ? 2 : 0;
        }
      }
    }
    return sides;
  }

  void findCells(Domain domain, const std::vector<double>& values, double isovalue)
  {
    const int n = this->N;
    const std::vector<unsigned char> sides = this->sidesOfPoints(domain, values, isovalue);
    std::vector<unsigned char> ofFour(n + 1);
    for (int k = 0; k < n; ++k)
    {
      for (int j = 0; j < n; ++j)
      {
        const unsigned char* rows[] = { &sides[this->pointIndex(0, j, k)],
          &sides[this->pointIndex(0, j + 1, k)], &sides[this->pointIndex(0, j, k + 1)],
          &sides[this->pointIndex(0, j + 1, k + 1)] };
        for (int i = 0; i <= n; ++i)
        {
          ofFour[i] = rows[0][i] | rows[1][i] | rows[2][i] | rows[3][i];
        }
        for (int i = 0; i < n; ++i)
        {
          if ((ofFour[i] | ofFour[i + 1]) == 3)
          {
            this->CellNumber[this->cellIndex({ i, j, k })] = static_cast<int>(this->Cells.size());
            this->Cells.emplace_back(i, j, k);
          }
        }
      }
    }
  }

  void joinNeighbouringCells()
  {
    this->Parent.resize(this->Cells.size());
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
    for (int c = 0; c < static_cast<int>(this->Cells.size()); ++c)
    {
      this->forEachAround(
        this->Cells[c], [&](int other) { this->Parent[this->root(other)] = this->root(c); });
    }
  }

  template <class Visit>
  void forEachAround(const glm::ivec3& cell, const Visit& visit) const
  {
    for (int around = 0; around < 27; ++around)
    {
      const glm::ivec3 other =
        cell + glm::ivec3(around % 3 - 1, around / 3 % 3 - 1, around / 9 - 1);
      if (glm::all(glm::greaterThanEqual(other, glm::ivec3(0))) &&
        glm::all(glm::lessThan(other, glm::ivec3(this->N))) &&
        this->CellNumber[this->cellIndex(other)] >= 0)
      {
        visit(this->CellNumber[this->cellIndex(other)]);
      }
    }
  }

  int root(int c)
  {
    while (this->Parent[c] != c)
    {
      c = this->Parent[c] = this->Parent[this->Parent[c]];
    }
    return c;
  }

  std::size_t pointIndex(int i, int j, int k) const
  {
    const std::size_t row = static_cast<std::size_t>(this->N) + 1;
    return i + row * (j + row * k);
  }

  std::size_t cellIndex(const glm::ivec3& cell) const
  {
    const std::size_t row = static_cast<std::size_t>(this->N);
    return cell.x + row * (cell.y + row * cell.z);
  }

  int N;
  std::vector<int> CellNumber;
  std::vector<glm::ivec3> Cells;
  std::vector<int> Parent;
};

class RandomPolynomials : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(SurfaceBoxes, RandomPolynomials,
  ::testing::Values(Domain::Hexahedron, Domain::Tetrahedron, Domain::Wedge),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

/// 500 polynomials of orders 2 to 8, and lattices of 40 to 160 cells an axis.
TEST_P(RandomPolynomials, LoseNoComponentThatALatticeTwentyTimesFinerSees)
{
  constexpr int trials = 500;
  constexpr double anySize = 10.0;
  const Domain domain = this->GetParam();
  Random random(100 + static_cast<int>(domain));
  int components = 0;
  std::size_t boxCount = 0;
  std::ptrdiff_t uncertified = 0;
  for (int trial = 0; trial < trials; ++trial)
  {
    const int degree = 2 + trial % 7;
    SCOPED_TRACE(::testing::Message() << "trial " << trial << ", degree " << degree);
    const ChebyshevSum polynomial({ domain, { degree, degree, degree } }, random);
    const ElementMesh mesh = polynomial.element();
    const int n = 20 * degree;
    const std::vector<double> values = polynomial.onLattice(n);
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    const double isovalue = *lowest + random.uniform() * (*highest - *lowest);
    LatticeComponents lattice(domain, n, values, isovalue);
    const std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, isovalue, anySize, {});
    std::vector<char> seen;
    for (const Location& seed : surfaceSeeds(mesh, isovalue, boxes))
    {
      lattice.visit(seed.u, seen);
    }
    EXPECT_EQ(lattice.countUnseen(seen), 0);
    components += lattice.count();
    boxCount += boxes.size();
    uncertified += uncertifiedCount(boxes);
  }
  RecordProperty("components", components);
  std::cout << domain << ": " << components << " components of " << trials << " polynomials, "
            << boxCount << " boxes, " << uncertified << " of them uncertified\n";
  EXPECT_GT(components, trials);
  EXPECT_LT(static_cast<double>(uncertified), 1e-3 * static_cast<double>(boxCount));
}

} // namespace
} // namespace hop::testing
