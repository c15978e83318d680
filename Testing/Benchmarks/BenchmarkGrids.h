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
///  - teardrop, needle: teardropMesh() and needleMesh() of TestMeshes.h, as Bezier hexahedra;
///  - quartic, tangle, octic: the surfaces of AnalyticFields.h, each in one straight Lagrange hexahedron of its degree;
///  - vortex_street: vortexStreetMesh() of TestMeshes.h, Lagrange hexahedra and wedges of degree 3;
///  - gyroid: one period in 16^3 bent Lagrange hexahedra of degree 3; it ends at the cube's faces.
/// \return nullptr if there is no such thing
vtkSmartPointer<vtkUnstructuredGrid> benchmarkGrid(const std::string& name);

} // namespace hop::testing
