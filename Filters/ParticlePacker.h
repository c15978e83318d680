#pragma once

#include "GridElements.h"
#include "Particles.h"

class vtkDataArray;
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
/// \param scalars the array whose isosurfaces these are
void packParticles(vtkUnstructuredGrid* grid, vtkDataArray* scalars,
  const GridElements& elements, const std::vector<IsovalueParticles>& isovalues,
  const hop::ParallelFor& parallelFor, vtkPolyData* output);
