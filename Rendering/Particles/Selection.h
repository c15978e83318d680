/**
 * @file  Selection.h
 * @brief which particle, and which cell, a pixel of a hardware selection stands for
 */

#pragma once

#include <string>
#include <vector>

class vtkHardwareSelector;
class vtkIdTypeArray;
class vtkPolyData;
class vtkUnsignedIntArray;

namespace hop
{
/**
 * GLSL that writes the bytes of a particle's number that one pass of vtkHardwareSelector asks for: of the number of its
 * point, or of its own number as the number of a cell. Empty for passes that ask for neither.
 *
 * VTK's own code would write gl_VertexID and gl_PrimitiveID, which do not number particles. Cells are numbered through
 * the vertex cells in order, as particles are; without vertex cells see SelectCells().
 */
std::string SelectionCode(int pass);

/**
 * Replaces the numbers of points in the pixels of a selection by cells. The cell of a point is the first one that uses
 * it. A point that no cell uses is not selected.
 * @param ids the number by which each cell is selected; nullptr: its place in the input
 * @param pixels where the pixels that show the input begin in the selector's buffers
 */
void SelectCells(vtkPolyData* input, vtkIdTypeArray* ids, vtkHardwareSelector* selector,
  const std::vector<unsigned int>& pixels);

/**
 * Writes the rank of the point into the pixels of a selection, after the passes for numbers of points.
 * @param ranks one a point of the input
 * @param pixels where the pixels that show the input begin in the selector's buffers
 */
void SelectRanks(vtkUnsignedIntArray* ranks, vtkHardwareSelector* selector,
  const std::vector<unsigned int>& pixels);
}
