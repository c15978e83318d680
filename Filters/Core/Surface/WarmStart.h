#pragma once

#include "Surface/Particles.h"

#include <cstdint>
#include <vector>

namespace hop
{

/// A place in a cell of the input. It outlives the mesh, which keeps only cells that can hold surface.
struct CellPlace
{
  std::int64_t cell = -1;
  ReferencePoint u;
};

/// Where the particles of a run stood, without the particles on boundary curves: the next run places its own.
Buffer<CellPlace> cellPlaces(
  const ElementMesh& mesh, const Buffer<Particle>& particles, const ParallelFor& parallelFor);

/// The places whose cells are elements of this mesh, and that lie inside these elements.
std::vector<Location> findPlaces(const ElementMesh& mesh, const Buffer<CellPlace>& places);

} // namespace hop
