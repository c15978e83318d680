#pragma once

#include "Surface/Particles.h"

#include <cstdint>
#include <vector>

namespace hop
{

/// A place in a cell of the input, whichever elements a mesh has kept of it.
struct CellPlace
{
  std::int64_t cell = -1;
  ReferencePoint u;
};

/// Where the particles of a run stood, but for those on boundary curves, which are placed anew.
Buffer<CellPlace> cellPlaces(
  const ElementMesh& mesh, const Buffer<Particle>& particles, const ParallelFor& parallelFor);

/// Those of the places whose cells are elements of this mesh.
/// \pre elements ascend by cell, as in the input
std::vector<Location> findPlaces(const ElementMesh& mesh, const Buffer<CellPlace>& places);

} // namespace hop
