// Grids whose isosurface is known exactly, and what is drawn of them.
#pragma once

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

struct SurfaceCase
{
  std::string Name;
  vtkSmartPointer<vtkUnstructuredGrid> Grid;
  std::string Array;
  double Isovalue = 0.;
  // Of the filter, and their spacing in world units; where the filter chose it, the largest one.
  vtkSmartPointer<vtkPolyData> Particles;
  double Spacing = 0.;
};

// "sphere", "torus", "boundary" (a sphere that leaves the domain, with a boundary curve), "crease" (two spheres that
// meet in a crease, their fields joined at element faces), "hexahedron" (one of order 8), "cylinder" (flow around one).
// Particles beside boundary curve and crease carry the planes there. Any other name is FILE.vtu:ARRAY:ISOVALUE.
// Throws std::invalid_argument if it is not, or if the file cannot be read or has no such array.
// The spacing is a share of the longest side of the grid, as the filter's own default is; 0 stands for that default.
SurfaceCase MakeSurfaceCase(const std::string& name, double spacing = 0.01);

// The isosurface of a grid's point array.
SurfaceCase MakeSurfaceCase(const std::string& name, vtkUnstructuredGrid* grid,
  const std::string& array, double isovalue, double spacing);

// The names of the cases that are no files.
const std::vector<std::string>& SurfaceCaseNames();

// Stock Contour's triangles of the same grid, with smooth normals.
vtkSmartPointer<vtkPolyData> ContourOf(const SurfaceCase& surface);
