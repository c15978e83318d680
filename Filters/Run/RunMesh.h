#pragma once

#include "Output/OutputRows.h"
#include "Surface/SurfaceWalker.h"

namespace hop
{

/// What the output is made of.
enum class OutputType
{
  Particles,
  Triangles,
  CurvedTriangles
};

/// The mesh that goes with the type of the output; none for particles. Particles may be added: where holes are filled,
/// and as nodes of curved triangles.
/// \param order of curved triangles
/// \param isCut whether the particles cover a part of the surface only, of whose topology nothing is proven
/// \param some whose mesh and areas are computed
/// \throw Interrupted
void addMesh(const Isosurface& surface, OutputType type, int order, bool isCut,
  IsovalueParticles& some, const Monitor& monitor, const ParallelFor& parallelFor);

} // namespace hop
