#pragma once

#include "Elements/Domain.h"

namespace hop
{

/// Number of lattice points (0, j, k), (1, j, k), ... of a row, which are stored one after the other; zero or less where
/// a simplex has no such row.
/// \pre 0 <= j <= degrees[1], 0 <= k <= degrees[2]
inline int latticeRowLength(Domain domain, const Degrees& degrees, int j, int k)
{
  switch (domain)
  {
    case Domain::Hexahedron:
      return degrees[0] + 1;
    case Domain::Tetrahedron:
      return degrees[0] + 1 - j - k;
    case Domain::Wedge:
      return degrees[0] + 1 - j;
  }
  unknownDomain();
}

/// Calls visit(j, k, length) for every row of a lattice, in storage order.
template <class Visit>
void visitLatticeRows(Domain domain, const Degrees& degrees, const Visit& visit)
{
  for (int k = 0; k <= degrees[2]; ++k)
  {
    for (int j = 0; j <= degrees[1]; ++j)
    {
      const int length = latticeRowLength(domain, degrees, j, k);
      if (length > 0)
      {
        visit(j, k, length);
      }
    }
  }
}

/// Calls visit(point) for every lattice point, in storage order.
template <class Visit>
void visitLatticePoints(Domain domain, const Degrees& degrees, const Visit& visit)
{
  visitLatticeRows(domain, degrees,
    [&](int j, int k, int length)
    {
      for (int i = 0; i < length; ++i)
      {
        visit(LatticePoint{ i, j, k });
      }
    });
}

} // namespace hop
