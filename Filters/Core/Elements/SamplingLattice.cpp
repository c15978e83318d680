#include "Elements/SamplingLattice.h"

#include "Elements/BatchEvaluator.h"
#include "Elements/LatticeRows.h"
#include "Support/DisjointSets.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace hop
{
namespace
{

/// Fewer see errors too small; each costs as much as a node.
constexpr int CheckPointCount = 60;

/// The n-th number of the van der Corput sequence, in [0, 1].
double vanDerCorput(int n, int base)
{
  double result = 0.0;
  double digit = 1.0;
  for (; n > 0; n /= base)
  {
    digit /= base;
    result += digit * (n % base);
  }
  return result;
}

/// Pairs of points of a lattice that a step takes from one to the other.
std::vector<std::array<int, 2>> pairsAlong(
  Domain domain, const Degrees& degrees, const LatticePoint& step)
{
  std::vector<std::array<int, 2>> pairs;
  int n = 0;
  visitLatticePoints(domain, degrees,
    [&](const LatticePoint& point)
    {
      const LatticePoint next{ point.i + step.i, point.j + step.j, point.k + step.k };
      if (inLattice(domain, degrees, next))
      {
        pairs.push_back({ n, coefficientIndex(domain, degrees, next) });
      }
      ++n;
    });
  return pairs;
}

/// Points spread evenly over a domain, some of them on its faces (Halton 1960; on simplices by differences of sorted
/// numbers).
std::vector<ReferencePoint> spreadPoints(Domain domain, int count)
{
  std::vector<ReferencePoint> points;
  for (int n = 1; n <= count; ++n)
  {
    std::array<double, 3> u{};
    for (int a = 0; a < 3; ++a)
    {
      constexpr std::array<int, 3> bases{ 2, 3, 5 };
      u[a] = std::clamp(1.1 * vanDerCorput(n, bases[a]) - 0.05, 0.0, 1.0);
    }
    for (const SimplexFactor& factor : facts(domain).factors)
    {
      std::sort(u.begin() + factor.axis, u.begin() + factor.end());
      for (int a = factor.end() - 1; a > factor.axis; --a)
      {
        u[a] -= u[a - 1];
      }
    }
    points.push_back({ { u[0], u[1], u[2] } });
  }
  return points;
}

} // namespace

SamplingLattice::SamplingLattice(Domain domain, int degree)
  : degrees{ degree, degree, degree }
{
  const std::vector<LatticePoint> points = latticePoints(domain, this->degrees);
  if (domain == Domain::Hexahedron)
  {
    this->ofCube.emplace(degree);
  }
  else
  {
    this->basis = NodalBasis::lagrange(domain, this->degrees, points);
  }
  for (const LatticePoint& point : points)
  {
    this->nodes.push_back(latticePosition(this->degrees, point));
    if (this->ofCube)
    {
      const std::vector<double>& line = this->ofCube->line();
      this->nodes.back() = { { line[point.i], line[point.j], line[point.k] } };
    }
  }
  for (const LatticePoint& direction : facts(domain).edgeDirections)
  {
    this->edges.push_back(pairsAlong(domain, this->degrees, direction));
  }
}

const SamplingLattice& samplingLattice(Domain domain, int degree)
{
  static std::mutex mutex;
  static std::map<std::pair<Domain, int>, std::unique_ptr<const SamplingLattice>> known;
  const std::lock_guard<std::mutex> lock(mutex);
  std::unique_ptr<const SamplingLattice>& lattice = known[{ domain, degree }];
  if (!lattice)
  {
    lattice = std::make_unique<const SamplingLattice>(domain, degree);
  }
  return *lattice;
}

const std::vector<ReferencePoint>& checkPoints(Domain domain)
{
  static const std::array<std::vector<ReferencePoint>, 3> points{
    spreadPoints(Domain::Hexahedron, CheckPointCount),
    spreadPoints(Domain::Tetrahedron, CheckPointCount), spreadPoints(Domain::Wedge, CheckPointCount)
  };
  return points[static_cast<std::size_t>(domain)];
}

std::vector<Coefficient> coefficientsFrom(
  const SamplingLattice& lattice, const std::vector<Coefficient>& nodal)
{
  static_assert(sizeof(Coefficient) == 4 * sizeof(double), "rows of numbers are converted");
  std::vector<Coefficient> coefficients(nodal.size());
  if (lattice.ofCube)
  {
    const double* numbers = &nodal[0].x;
    const std::vector<double> converted =
      lattice.ofCube->toBernstein({ numbers, numbers + 4 * nodal.size() });
    std::copy(converted.begin(), converted.end(), &coefficients[0].x);
  }
  else
  {
    lattice.basis->toBernstein(&nodal[0].x, 4, &coefficients[0].x);
  }
  return coefficients;
}

std::vector<double> fieldAtNodes(const SamplingLattice& lattice, const BernsteinForm& form)
{
  const int count = coefficientCount(form.domain, form.degrees);
  std::vector<double> field;
  if (lattice.ofCube)
  {
    for (int i = 0; i < count; ++i)
    {
      field.push_back(form.coefficients[i].w);
    }
    const LineMatrix values = bernsteinValues(form.degrees[0], lattice.ofCube->line());
    return alongAxes({ &values, &values, &values }, field);
  }
  JetBatch jets;
  evaluateGradients(form, lattice.nodes.data(), static_cast<int>(lattice.nodes.size()), jets);
  const double* row = jets.row(quantity::value, 3);
  field.assign(row, row + lattice.nodes.size());
  return field;
}

bool hasSetWithoutMark(
  const SamplingLattice& lattice, const std::vector<char>& side, const std::vector<char>& mark)
{
  // Only sets of nodes without a mark are looked at, which are few. What touches a marked node of its side has one.
  std::vector<char> isMarked = mark;
  if (std::find(mark.begin(), mark.end(), 0) == mark.end())
  {
    return false;
  }
  DisjointSets sets(side.size());
  for (const std::vector<std::array<int, 2>>& direction : lattice.edges)
  {
    for (const auto& [a, b] : direction)
    {
      if (side[a] == side[b] && (mark[a] == 0 || mark[b] == 0))
      {
        const bool isOfMarked = mark[a] != mark[b];
        isMarked[mark[a] == 0 ? a : b] |= static_cast<char>(isOfMarked);
        if (!isOfMarked)
        {
          sets.unite(a, b);
        }
      }
    }
  }
  const int count = static_cast<int>(side.size());
  for (int n = 0; n < count; ++n)
  {
    isMarked[sets.root(n)] |= isMarked[n];
  }
  for (int n = 0; n < count; ++n)
  {
    if (isMarked[sets.root(n)] == 0)
    {
      return true;
    }
  }
  return false;
}

} // namespace hop
