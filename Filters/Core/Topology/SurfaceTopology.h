#pragma once

#include "Common/Monitor.h"
#include "Topology/ElementSurface.h"

namespace hop
{

class FaceLocator;

/// A component of the surface.
struct SurfaceComponent
{
  std::int64_t eulerCharacteristic = 0;
  /// Closed curves in which the component ends.
  std::int64_t boundaryLoops = 0;
  /// Whether both numbers are proven, and that this is all of one component. They mean nothing otherwise.
  bool proven = true;
  /// The first element that the component passes.
  int element = -1;
};

/// The topology of the surface {F = level}, proven component by component.
struct SurfaceTopology
{
  /// In the order of their first elements.
  std::vector<SurfaceComponent> components;
  /// Cells of the input in which the proof fails, ascending, each once: further components may be hidden there. A
  /// component that passes such a place is not proven.
  std::vector<std::int64_t> unresolvedCells;
  /// The surface in each element, and the component of each of its pieces.
  std::vector<ElementSurface> surfaces;
  std::vector<std::vector<int>> componentOfPiece;

  /// Whether every component is proven, and none may be missing.
  bool isProven() const;

  /// The element has no component.
  static constexpr int NoComponent = -1;
  /// The same, but what lies in its corners, edges and faces belongs to the elements around.
  static constexpr int AnyComponent = -2;

  /// The component that passes a place, or the one in the nearest leaf of the element.
  int componentAt(const Location& location) const;
};

/// Proves the topology of the isosurface. Every element is split until the surface in every leaf is a disc that the
/// signs at the leaf's corners describe (LeafTests.h). Leaves are joined to the surface of the element
/// (ElementSurface.h), and the elements' surfaces along joined faces:
///   Euler characteristic = sum over elements - curves in faces + points on edges.
/// Derivation: Documentation/algorithm.md, section Topology.
/// \param locator tells where elements may lie behind faces that are not joined; the surface there is not proven.
///   nullptr: the surface ends at these faces
/// \return the same for any number of threads
SurfaceTopology findTopology(const ElementMesh& mesh, double isovalue, const FaceLocator* locator,
  const ParallelFor& parallelFor);

} // namespace hop
