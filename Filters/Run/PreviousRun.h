#pragma once

#include "Surface/DistributionParameters.h"
#include "Surface/Particles.h"
#include "Surface/WarmStart.h"

#include <cstdint>
#include <string>
#include <vector>

/// What one isosurface was made of. From one run to the next its particles go on if only the isovalue or
/// the data changed.
struct RunOrigin
{
  double isovalue = 0.0;
  /// When the data changed last.
  std::uint64_t dataTime = 0;
  /// Name and component of the array.
  std::string array;
  int component = 0;
  /// Of the input.
  std::int64_t cells = 0;
  std::int64_t points = 0;
  int nodeSpacing = 0;
  hop::DistributionParameters parameters;

  /// Whether particles of `before` may go on in this run. They may not where nothing changed: the same
  /// input and properties give the same particles.
  bool continues(const RunOrigin& before) const;
};

/// Where the particles of the last run stood, isosurface by isosurface; 32 bytes a particle.
class PreviousRun
{
public:
  /// Where particles of isosurface `index` may go on, in the mesh at hand; empty if it starts anew.
  std::vector<hop::Location> startOf(
    std::size_t index, const RunOrigin& origin, const hop::ElementMesh& mesh) const;

  /// Takes the place of what was known of that isosurface; nothing is kept of an aborted run.
  void remember(std::size_t index, const RunOrigin& origin, const hop::ElementMesh& mesh,
    const hop::Distribution& distribution, const hop::ParallelFor& parallelFor);

  void forget() { this->Surfaces.clear(); }

private:
  struct Surface
  {
    RunOrigin origin;
    hop::Buffer<hop::CellPlace> places;
  };
  std::vector<Surface> Surfaces;
};
