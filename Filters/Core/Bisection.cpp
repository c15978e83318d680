#include "Bisection.h"

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

} // namespace hop
