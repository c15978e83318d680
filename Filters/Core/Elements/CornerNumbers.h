#pragma once

#include "Elements/ElementMesh.h"

namespace hop
{

/// For each element how far its corners, and the middles of its faces, may be from corners and middles of other
/// elements and still coincide with them, world units. Files may hold single precision or six decimal digits, whatever
/// the type of their arrays; but corners of one element that are joined by an edge must stay apart.
std::vector<double> cornerTolerances(const ElementMesh& mesh, const ParallelFor& parallelFor = {});

/// Gives coincident corners equal numbers (Element::corners): most solvers write every cell with points of its own.
/// \param tolerances one an element
void numberCorners(
  ElementMesh& mesh, const std::vector<double>& tolerances, const ParallelFor& parallelFor = {});

/// Joins elements at their faces: numbers their corners and finds their neighbours. All that is needed before particles
/// can be distributed on them.
void joinElements(ElementMesh& mesh, const ParallelFor& parallelFor = {});

} // namespace hop
