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
  /// Which of the elements of the cell, where cells are divided. Their number may be another one in the next run: the place
  /// is then in another part of the cell, from where the surface is found as well.
  int ofCell = 0;
  ReferencePoint u;
};

/// Where the particles of a run stood, without the particles on boundary curves: the next run places its own.
Buffer<CellPlace> cellPlaces(
  const ElementMesh& mesh, const Buffer<Particle>& particles, const ParallelFor& parallelFor);

/// The places whose cells are elements of this mesh, and that lie inside these elements.
std::vector<Location> findPlaces(const ElementMesh& mesh, const Buffer<CellPlace>& places);

} // namespace hop
