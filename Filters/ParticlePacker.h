#pragma once

#include "GridElements.h"
#include "Particles.h"

class vtkPolyData;
class vtkUnstructuredGrid;

/// Particles of one isovalue.
struct IsovalueParticles
{
  double isovalue = 0.0;
  hop::Distribution distribution;
};

/// Writes particles as vtkPolyData: points, vertex cells, the particles' own arrays, the grid's
/// point arrays evaluated and its cell arrays copied. Particles in ghost cells are left out: they
/// belong to another rank. See vtkHighOrderParticleIsosurface for names and meaning of the arrays.
/// \param scalars what the isosurfaces are of
void packParticles(vtkUnstructuredGrid* grid, const ScalarChoice& scalars,
  const GridElements& elements, const std::vector<IsovalueParticles>& isovalues,
  const hop::ParallelFor& parallelFor, vtkPolyData* output);
