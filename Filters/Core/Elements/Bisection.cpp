#include "Elements/Bisection.h"

#include "Elements/KernelAccess.h"

#include <algorithm>
#include <cmath>

namespace hop
{

LatticeLines::LatticeLines(Domain domain, const Degrees& degrees, const LatticePoint& direction)
{
  for (const LatticePoint& start : latticePoints(domain, degrees))
  {
    const auto along = [&](int step)
    {
      return LatticePoint{ start.i + step * direction.i, start.j + step * direction.j,
        start.k + step * direction.k };
    };
    if (inLattice(domain, degrees, along(-1)))
    {
      continue; // not the first point of its line
    }
    this->Begin.push_back(static_cast<int>(this->Index.size()));
    for (int step = 0; inLattice(domain, degrees, along(step)); ++step)
    {
      this->Index.push_back(coefficientIndex(domain, degrees, along(step)));
    }
  }
  this->Begin.push_back(static_cast<int>(this->Index.size()));
}

void LatticeLines::bisect(Buffer<Coefficient>& coefficients, Buffer<Coefficient>& second) const
{
  second.resize(coefficients.size());
  kernel::current().bisection(this->lines(), &coefficients.front().x, &second.front().x);
}

void LatticeLines::bisect(std::vector<double>& numbers, std::vector<double>& second) const
{
  static_assert(MaximumPolynomialDegree <= 2 * kernel::MaximumDegree, "lines are no longer");
  second.resize(numbers.size());
  kernel::current().numberBisection(this->lines(), numbers.data(), second.data());
}

kernel::Lines LatticeLines::lines() const
{
  return { this->Begin.data(), this->Index.data(),
    static_cast<std::ptrdiff_t>(this->Begin.size()) - 1 };
}

double LatticeLines::variation(const std::vector<double>& coefficients) const
{
  double sum = 0.0;
  for (std::size_t l = 0; l + 1 < this->Begin.size(); ++l)
  {
    for (int at = this->Begin[l] + 1; at < this->Begin[l + 1]; ++at)
    {
      sum += std::abs(coefficients[this->Index[at]] - coefficients[this->Index[at - 1]]);
    }
  }
  return sum;
}

} // namespace hop
