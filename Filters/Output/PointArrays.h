#pragma once

#include "Conversion/GridElements.h"
#include "Surface/Particles.h"

/// A particle on its way to its row of the output.
struct ParticleRow
{
  const hop::Particle* particle = nullptr;
  double isovalue = 0.0;
};

/// A point array of the grid, and where its values at the particles go: as many components a row.
struct EvaluatedArray
{
  vtkDataArray* source = nullptr;
  double* target = nullptr;
};

/// Evaluates point arrays at particles by the basis functions of their elements, rational ones included:
/// all arrays of an element are converted to Bernstein form once, and evaluated at all its particles.
/// \param rows sorted by element, all in the block whose arrays these are
void evaluatePointArrays(const InputBlocks& blocks, const GridElements& elements,
  const std::vector<EvaluatedArray>& arrays, const std::vector<ParticleRow>& rows,
  const hop::ParallelFor& parallelFor);
