#pragma once

#include "Output/ParticleRow.h"

namespace hop
{

/// A point array of the grid, and the array that receives its values at the particles, with as many components.
struct EvaluatedArray
{
  vtkDataArray* source = nullptr;
  double* target = nullptr;
};

/// Evaluates point arrays at particles by the basis functions of their elements, rational ones included. The nodal
/// values of an element are converted to Bernstein form once, and then evaluated at all its particles.
/// \param block that has the arrays. At rows in other blocks their arrays of the same name are evaluated; where a block
/// lacks one, the row gets the value of its stand-in.
/// \param rows sorted by element for the most part
void evaluatePointArrays(const InputBlocks& blocks, std::size_t block, const GridElements& elements,
  const std::vector<EvaluatedArray>& arrays, const std::vector<ParticleRow>& rows,
  const ParallelFor& parallelFor);

} // namespace hop
