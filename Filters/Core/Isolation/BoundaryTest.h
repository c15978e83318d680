#pragma once

#include "Isolation/MonotoneTest.h"

namespace hop
{

/// Decides whether a polynomial in Bernstein form is zero along one closed curve at most on the
/// boundary of its domain. Prepared once for a domain and degrees.
///
/// A field that rises along some direction (MonotoneTest) may still cut its domain in several pieces:
/// two corners of a box, say, clipped by one wavy sheet. Every piece reaches the boundary in a closed
/// curve. On an edge, coefficients that only rise or fall allow one zero, where the signs of the ends
/// differ; on a face, a field that rises along some direction has no closed curve of zeros, so that two
/// edges with a zero are the ends of one curve. Joining edges through faces counts the closed curves.
class BoundaryTest
{
public:
  BoundaryTest(Domain domain, const Degrees& degrees);

  /// \param values one coefficient a lattice point
  /// \param slack coefficients this close to zero count as zero
  /// \return true only if there is one closed curve of zeros at most
  bool crossedOnce(const std::vector<double>& values, double slack) const;

private:
  /// The lattice points on an edge, from its first corner to its second.
  struct EdgeLattice
  {
    std::array<int, 2> corners{};
    std::vector<int> points;
  };

  /// The lattice points on a face, twice: as a hexahedron or wedge without change in its height.
  struct FaceLattice
  {
    MonotoneTest monotone;
    std::vector<int> points;
    std::vector<int> edges;
  };

  void addEdges(const Face& face, FaceLattice& lattice);

  Domain ItsDomain;
  Degrees ItsDegrees;
  std::vector<EdgeLattice> Edges;
  std::vector<FaceLattice> Faces;
};

} // namespace hop
