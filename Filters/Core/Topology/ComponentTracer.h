#pragma once

#include "Common/Monitor.h"
#include "Topology/CurveMatching.h"

#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hop
{

/// A piece of the surface, by its element and its number there.
using PieceNumber = std::pair<int, int>;

/// Follows components of the surface from element to element, without a look at the elements that they do not pass.
/// What it finds is proven, as by findTopology().
class ComponentTracer
{
public:
  ComponentTracer(const ElementMesh& mesh, double isovalue, ParallelFor parallelFor = {})
    : Mesh(mesh)
    , Isovalue(isovalue)
    , Parallel(std::move(parallelFor))
  {
  }

  /// Finds the surfaces in elements that will be looked at, in threads.
  /// \param elements ascending
  void prepare(const std::vector<int>& elements);

  /// The surface in an element. Not to be called from several threads: the caller is asked whether to go on.
  const ElementSurface& surfaceOf(int element);

  /// The piece at a place, or in the nearest leaf of its element; its number is -1 if there is none.
  PieceNumber pieceAt(const Location& location);

  /// The pieces of a closed component.
  /// \param passes passes(piece) is called for one piece after the other; false ends the search
  /// \return nothing if the component has a boundary, or passes a face beside hanging nodes, if its topology is not
  ///   proven, or if the search was ended
  std::vector<PieceNumber> closedComponent(
    const PieceNumber& start, const std::function<bool(const PieceNumber&)>& passes);

private:
  const ElementMesh& Mesh;
  double Isovalue;
  ParallelFor Parallel;
  std::unordered_map<int, std::unique_ptr<ElementSurface>> Surfaces;
  std::unordered_map<int, std::vector<CurveMatch>> Matches;
  std::optional<LeafTests> Tests;
};

} // namespace hop
