#pragma once

#include "Common/Monitor.h"
#include "Topology/ElementCube.h"
#include "Topology/LeafTests.h"

#include <optional>

namespace hop
{

/// A box of an element's cube, in units of the smallest leaf: its lower corner, and its size along each axis.
struct Leaf
{
  glm::ivec3 lower{ 0 };
  int size = 0;
  /// See LeafTests.
  std::uint8_t signs = 0;
};

/// The places of leaves: an octree whose first split lies beside the middle of each axis, and all others in the middle,
/// so that planes between leaves are not those to which surfaces of simple numbers are tangent.
struct LeafGrid
{
  /// Octants of octants of ... the cube at most. A component larger than 2^-Depth of an element is resolved. Larger:
  /// singular places take longer, and sheets closer to each other are told apart.
  static constexpr int Depth = 16;
  /// Leaves of the smallest size along an axis.
  static constexpr int Size = 1 << Depth;
  /// Where the first split divides each axis. Any numbers that have nothing to do with those of meshes and fields; far
  /// from 0.5 they make narrow leaves.
  static constexpr std::array<double, 3> FirstSplit{ 0.4767, 0.5219, 0.4871 };

  /// From the cube's coordinates to units of the smallest leaf, and back.
  static glm::dvec3 fromCube(const glm::dvec3& t);
  static glm::dvec3 toCube(const glm::dvec3& place);
};

/// The leaves of one element that are not empty.
struct ElementLeaves
{
  std::vector<Leaf> discs;
  /// Leaves of which nothing is proven.
  std::vector<Leaf> unresolved;
};

/// Splits an element's cube until nothing is undecided, or leaves are as small as they may be, or too many.
/// \param tests for the cube's degrees
/// \param partsOfCell elements that share the limits of a cell, at least 1
ElementLeaves findLeaves(const ElementCube& cube, const LeafTests& tests, int partsOfCell = 1,
  const ParallelFor& parallelFor = {});

/// The same where it takes little time, on one thread.
/// \return nothing where more than a sixteenth of the boxes that may be looked at would have to be
std::optional<ElementLeaves> findFewLeaves(
  const ElementCube& cube, const LeafTests& tests, int partsOfCell = 1);

} // namespace hop
