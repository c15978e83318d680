#pragma once

#include <string>
#include <vector>

class vtkCellArray;
class vtkPointSet;

namespace hop::testing
{

/// The polygons of polydata, the cells of a grid.
vtkCellArray& cellsOf(vtkPointSet& output);

/// Adds what keeps a mesh, of flat or curved triangles, from being an oriented manifold with boundary: nodes that are
/// not there or twice in a triangle, points without triangle, two triangles on one side of an edge, and corners at which
/// two fans of triangles touch.
/// \param isPart whether the mesh lies in one of several blocks: it may touch itself in a corner
void judgeMesh(vtkPointSet& mesh, bool isPart, std::vector<std::string>& found);

} // namespace hop::testing
