#pragma once

#include <vtkSmartPointer.h>

#include <string>

class vtkUnstructuredGrid;

namespace hop::testing
{

/// A grid to measure on, with the field's point array: a file, or one of these names, whose field "f"
/// is positive inside the surface {f = 0}:
///  - sphere_DOMAIN, torus_DOMAIN: in 4^3 bent cubes of Lagrange hexahedra, tetrahedra or wedges
///    (DOMAIN = hexahedra, tetrahedra, wedges) of degree 4, that hold a sphere of radius 0.6 and a
///    torus of radii 0.5 and 0.22;
///  - teardrop: x^5/2 + x^4/2 = y^2 + z^2 for -1.05 <= x <= 0.1 in reference space, with its cusp at 0,
///    under a quadratic B-spline map of 2^3 spans, each one Bezier hexahedron of degree 5;
///  - gyroid: one period in 16^3 bent Lagrange hexahedra of degree 3; it ends at the cube's faces.
/// \return nullptr if there is no such thing
vtkSmartPointer<vtkUnstructuredGrid> benchmarkGrid(const std::string& name);

} // namespace hop::testing
