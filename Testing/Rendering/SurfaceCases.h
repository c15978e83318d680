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
  // Particles of the filter at its own default spacing, and that spacing.
  vtkSmartPointer<vtkPolyData> Particles;
  double Spacing = 0.;
};

// "sphere", "torus", "rim" (a sphere that leaves the domain), "kink" (two spheres that meet in one,
// their fields joined at element faces), "hexahedron" (one of order 8), "cylinder" (flow around one).
// Particles beside rim and kink carry the planes there. Throws std::invalid_argument for other names.
SurfaceCase MakeSurfaceCase(const std::string& name);

// All of these names.
const std::vector<std::string>& SurfaceCaseNames();

// Stock Contour's triangles of the same grid, with smooth normals.
vtkSmartPointer<vtkPolyData> ContourOf(const SurfaceCase& surface);
