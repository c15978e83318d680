/**
 * @file  Particles/Selection.h
 * @brief which particle, and which cell, a pixel of a hardware selection stands for
 */

#pragma once

#include <string>
#include <vector>

class vtkHardwareSelector;
class vtkPolyData;

namespace hop
{
/**
 * Code that writes those bytes of a particle's number that a pass of vtkHardwareSelector asks for: of its point,
 * or its own as the number of a cell. Empty for other passes. VTK's own code would take gl_VertexID and
 * gl_PrimitiveID, which are not those of particles. Its numbers of cells count through the vertex cells in order,
 * as particles do; where there are none, see SelectCells().
 */
std::string SelectionCode(int pass);

/**
 * Takes the points' numbers out of the pixels of a selection by cells and puts those of cells in: of the first that
 * uses the point. Points that none uses are not selected.
 * @param pixels that show the input: where each begins in the selector's buffers
 */
void SelectCells(
  vtkPolyData* input, vtkHardwareSelector* selector, const std::vector<unsigned int>& pixels);
}
