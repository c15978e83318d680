#pragma once

#include "Elements/NodalBasis.h"
#include "Input/InputBlocks.h"
#include "Surface/DistributionParameters.h"
#include "Surface/Particles.h"
#include "Surface/WarmStart.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hop
{

/// What one isosurface was made of. Its particles go on in the next run if only the isovalue or the data changed.
struct RunOrigin
{
  double isovalue = 0.0;
  /// Modification time of the data.
  std::uint64_t dataTime = 0;
  /// Name of the contoured array.
  std::string array;
  int component = 0;
  Quantity quantity = Quantity::Value;
  /// What the scalars were made of by averages at nodes; Value: they were not.
  Quantity averaged = Quantity::Value;
  /// Numbers of cells and points of the input.
  std::int64_t cells = 0;
  std::int64_t points = 0;
  NodeSpacing nodeSpacing = NodeSpacing::Uniform;
  /// Unit of the lengths in `parameters`, world units.
  double unit = 1.0;
  DistributionParameters parameters;

  /// Whether particles of the isosurface `before` may go on in this one. They may not where nothing changed: the same
  /// input and properties give the same particles.
  bool continues(const RunOrigin& before) const;
};

/// What the data say about the isosurfaces of a mesh; isovalue, averages, node spacing and parameters are left as they are.
/// \pre blocks.size() > 0
RunOrigin originOf(const InputBlocks& blocks);

/// The places of the particles of the last run, isosurface by isosurface; 32 bytes a particle.
class PreviousRun
{
public:
  /// The places, in the mesh at hand, from which particles of isosurface `index` go on; empty if it starts anew.
  std::vector<Location> startOf(
    std::size_t index, const RunOrigin& origin, const ElementMesh& mesh) const;

  /// Replaces what was known of isosurface `index`; nothing is kept of an aborted run.
  void remember(std::size_t index, const RunOrigin& origin, const ElementMesh& mesh,
    const Distribution& distribution, const ParallelFor& parallelFor);

  void forget() { this->Surfaces.clear(); }

private:
  struct Surface
  {
    RunOrigin origin;
    Buffer<CellPlace> places;
  };
  std::vector<Surface> Surfaces;
};

} // namespace hop
