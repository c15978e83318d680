#pragma once

#include "Isolation/MonotoneTest.h"

#include <optional>

namespace hop
{

/// What is proven of the surface in a leaf, a box of an element's cube (ElementCube.h).
enum class LeafSurface
{
  /// There is none.
  Empty,
  /// It is one disc. Its boundary crosses each edge of the leaf whose ends have different signs once, and no other
  /// edge; it is one arc in each face with two crossed edges, and there is nothing of it in the other faces.
  Disc,
  /// Not decided, and the field at a corner is zero to rounding, or was before it was lifted.
  ZeroAtCorner,
  Undecided
};

/// Tests a polynomial over the unit cube. Prepared once for degrees.
///
/// A leaf holds one disc if
///  - the field rises along a direction, so that the surface is a graph, each part of which meets the boundary;
///  - coefficients along each edge change their sign once at most, so that the edge holds one zero at most (Descartes);
///  - the field rises along a direction of each face that it changes its sign on, so that no closed curve lies in
///    the face, and two edges of the face hold a zero at most, which are then the ends of one arc;
///  - the arcs make one closed curve.
/// Derivation: Documentation/algorithm.md, section Topology.
class LeafTests
{
public:
  explicit LeafTests(const Degrees& degrees);

  const Degrees& degrees() const { return this->ItsDegrees; }

  /// \param values Bernstein coefficients, the first axis fastest
  /// \param slack coefficients this close to zero may have either sign
  /// \param signs receives a bit for each corner at which a Disc's field is positive
  LeafSurface examine(const std::vector<double>& values, double slack, std::uint8_t& signs) const;

private:
  struct Face
  {
    MonotoneTest monotone;
    /// Indices of the face's coefficients.
    std::vector<int> points;
  };

  bool isOneArc(const Face& face, const std::vector<double>& values) const;

  Degrees ItsDegrees;
  MonotoneTest Monotone;
  std::array<int, 8> Corners;
  std::vector<std::vector<int>> Edges;
  std::vector<Face> Faces;
};

/// Two corners of a cube, as in ElementCube, that an edge joins; the axis along which it runs.
struct CubeEdge
{
  int axis = 0;
  int first = 0;
  int second = 0;
};

/// The edges of a cube: edge 4 axis + n runs along that axis.
const std::array<CubeEdge, 12>& cubeEdges();

/// The edges of a face of a cube. Face 2 axis + side lies at 0 (side 0) or 1 (side 1) of that axis.
const std::array<int, 4>& edgesOfCubeFace(int face);

/// Whether an edge's ends have different signs.
inline bool isCrossed(const CubeEdge& edge, std::uint8_t signs)
{
  return ((signs >> edge.first ^ signs >> edge.second) & 1) != 0;
}

} // namespace hop
