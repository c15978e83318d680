#pragma once

#include "Elements/ElementMesh.h"

namespace hop
{

/// How far apart corners, and middles of faces, of each element may be and still coincide with those of
/// others, world units. Files may hold single precision or six decimal digits, whatever the type of their
/// arrays; but corners of one element that are joined by an edge must stay apart.
std::vector<double> cornerTolerances(const ElementMesh& mesh, const ParallelFor& parallelFor = {});

/// Equal numbers for coincident corners: most solvers write every cell with points of its own.
/// \param tolerances one an element
void numberCorners(
  ElementMesh& mesh, const std::vector<double>& tolerances, const ParallelFor& parallelFor = {});

} // namespace hop
