#pragma once

#include "Isolation/MonotoneTest.h"
#include "Support/DisjointSets.h"

#include <optional>

namespace hop
{

/// Decides whether the zeros of a polynomial in Bernstein form meet the boundary of its domain, which is a piece of an
/// element, in one closed curve at most. Prepared once for a domain and degrees.
///
/// The zeros of a field that rises along some direction (MonotoneTest.h) may still be several surfaces in the domain:
/// one wavy sheet may cut off two corners of a box, for instance. Each of these surfaces ends on the boundary of the
/// domain in a closed curve. Coefficients along an edge that only rise or only fall allow one zero there, and only if
/// the signs of the ends differ. A face on which the field rises along some direction has no closed curve of zeros
/// inside, so that two of its edges with a zero are the ends of one curve. Uniting edges through faces counts the
/// closed curves.
/// Derivation: Documentation/algorithm.md, section Isolation.
class PieceBoundaryTest
{
public:
  PieceBoundaryTest(Domain domain, const Degrees& degrees);

  /// \param values one coefficient a lattice point
  /// \param slack coefficients this close to zero count as zero
  /// \return true only if there is one closed curve of zeros at most
  bool isCrossedOnce(const std::vector<double>& values, double slack) const;

private:
  /// The two corners of an edge, and the storage indices of its lattice points from the first corner to the second.
  struct EdgeLattice
  {
    std::array<int, 2> corners{};
    std::vector<int> points;
  };

  /// A face taken for a hexahedron or wedge of degree 1 in height, whose two layers are both the face: MonotoneTest
  /// knows three-dimensional domains only.
  struct FaceLattice
  {
    MonotoneTest monotone;
    /// Storage indices of the lattice points of both layers.
    std::vector<int> points;
    /// Indices of the face's edges among `Edges`.
    std::vector<int> edges;
  };

  void addEdges(const Face& face, FaceLattice& lattice);
  std::optional<std::vector<char>> crossedEdges(
    const std::vector<double>& values, double slack) const;
  static bool uniteEdges(const FaceLattice& face, const std::vector<char>& crossed,
    const std::vector<double>& values, double slack, DisjointSets& curves);

  Domain ItsDomain;
  Degrees ItsDegrees;
  std::vector<EdgeLattice> Edges;
  std::vector<FaceLattice> Faces;
};

} // namespace hop
