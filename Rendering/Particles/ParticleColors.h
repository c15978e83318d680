/**
 * @file  ParticleColors.h
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
 * The RGBA colour that scalars give each particle. Empty if there are no colours, if they do not have four components,
 * or if there are fewer ids than particles.
 * @param colors made by vtkMapper::MapScalars()
 * @param ids number of the tuple of each particle. There may be more than particles; there are none where cells are
 *   coloured but particles are no cells.
 * @param count number of particles
 */
std::vector<unsigned char> GatherColors(
  vtkUnsignedCharArray* colors, const std::vector<vtkIdType>& ids, vtkIdType count);

/**
 * Puts the cells' own colours and opacities in place of the colours that the scalars gave, see
 * vtkSurfaceSplatMapper::SetCellColorArrayName().
 * @param rgba colours by scalars; if it is empty, the property's colour and opacity are taken instead
 */
void ReplaceColors(std::vector<unsigned char>& rgba, vtkDataArray* cellColors,
  const std::vector<vtkIdType>& cellIds, vtkIdType count, vtkProperty* property);

/**
 * Colours that clip at borders need one number a particle to tell whether they jump: the brightness, 0 to 1, of colours
 * or the position in the table; not a number where a texel has none.
 */
std::vector<float> BrightnessOf(const std::vector<unsigned char>& rgba);
std::vector<float> PositionsOf(const std::vector<float>& lookupTexels);

/**
 * Lookup coordinates, ready to be averaged: position in the table, 1, 0, 0. The last two are room for the position's
 * derivatives along the disk, per radius. A particle whose value is no number has
 * four zeros, so that it has no part in the mean.
 * @param coordinates as vtkMapper makes them: position in the table, and a second coordinate that tells numbers from
 *   values that are none
 */
std::vector<float> LookupTexels(
  vtkFloatArray* coordinates, const std::vector<vtkIdType>& pointIds, vtkIdType count);
}
