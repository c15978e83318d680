#pragma once

#include "Surface/Particles.h"

#include <optional>

namespace hop
{

/// Values from which a field is taken away.
enum class LiftedValues
{
  /// The isovalue.
  Isovalue,
  /// Values near it, too.
  Near
};

/// A mesh with another field where nodes, edges or faces of elements have the isovalue, or nearly so: there the field is
/// farther from it by a small number, on its own side, and above where it was the isovalue itself. So the surface passes
/// beside them, and no piece of it is narrower than its curves can tell apart: what simulation of simplicity does with
/// symbols (Edelsbrunner and Mücke 1990). Where the surface lies in edges of the mesh its boundary curves and creases are
/// undecided otherwise.
/// \param height by which the field is farther from the isovalue, in its unit, about the change over an element. Larger:
/// flat components of the surface are lost, and particles do not find back to it where they stand close; smaller: strips
/// beside edges of the mesh are too narrow for triangles where particles stand far apart.
/// \return nothing where no coefficient is such a value, or particles stand on other fields than those of coefficients
std::optional<ElementMesh> liftedMesh(
  const ElementMesh& mesh, double isovalue, LiftedValues which, double height);

/// Puts the particles on a lifted surface, and all that are on one place together, onto the surface itself: some
/// thousandth of an element, and by singular points up to a spacing on flat surfaces. At most one particle a sheet has no
/// place of its own there, as the tip of a hyperboloid on the cone; it goes beside the point.
/// \return whether all of them are on it
bool putBack(const Isosurface& surface, Distribution& distribution, const ParallelFor& parallelFor);

/// Whether near every corner of a mesh a corner of another one stands, a spacing on flat surfaces away at most: so that no
/// part of the surface is lost.
/// \param corners,otherCorners indices of particles, repeated at will
bool isCoveredBy(const Buffer<Particle>& particles, const std::vector<int>& corners,
  const Buffer<Particle>& others, const std::vector<int>& otherCorners,
  const ParallelFor& parallelFor = {});

} // namespace hop
