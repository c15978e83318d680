/**
 * @file  Particles/ParticleColors.h
 * @brief what is uploaded as the colours of particles: four numbers each
 */

#pragma once

#include "vtkType.h"

#include <vector>

class vtkDataArray;
class vtkFloatArray;
class vtkProperty;
class vtkUnsignedCharArray;

namespace hop
{
/**
 * The RGBA colour of every particle that scalars give; empty if they give none.
 * @param ids of the tuples, one a particle; there may be more, and none where cells are coloured but
 *   particles are no cells
 * @param count of particles
 */
std::vector<unsigned char> GatherColors(
  vtkUnsignedCharArray* colors, const std::vector<vtkIdType>& ids, vtkIdType count);

/**
 * Puts the cells' own colours and opacities in place of those of the scalars, or of the property where
 * there are none of scalars (empty), see vtkSurfaceSplatMapper::SetCellColorArrayName().
 */
void ReplaceColors(std::vector<unsigned char>& rgba, vtkDataArray* cellColors,
  const std::vector<vtkIdType>& cellIds, vtkIdType count, vtkProperty* property);

/**
 * Lookup coordinates to be averaged: position in the table, 1, 0, 0. All 0 for values that are no
 * numbers, which have no part in the mean.
 * @param coordinates as vtkMapper makes them: position, and 0.75 or more for what is no number
 */
std::vector<float> LookupTexels(
  vtkFloatArray* coordinates, const std::vector<vtkIdType>& pointIds, vtkIdType count);
}
