#pragma once

#include "Output/ParticleRow.h"

#include <string>
#include <vector>

class vtkPointData;

namespace hop
{

/// Whether addDerivatives() writes an array of that name.
bool isDerivativeArray(const std::string& name);

/// Adds the derivatives of the contoured array at particles, in world space, by the polynomials of their own cells:
/// `Gradient`, three numbers a component, du_i/dx_j with j running fastest; of vectors of three components `Vorticity`
/// and `Q_Criterion`, too. A row that is at home on another rank gets the numbers of its stand-in. Numbers that are not
/// finite, as they may be where a cell is collapsed, become the largest double.
/// \param rows sorted by element for the most part
void addDerivatives(const InputBlocks& blocks, const GridElements& elements,
  const std::vector<ParticleRow>& rows, vtkPointData* target, const ParallelFor& parallelFor);

} // namespace hop
