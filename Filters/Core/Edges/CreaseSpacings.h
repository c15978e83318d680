#pragma once

#include "Edges/FaceJumps.h"

namespace hop
{

/// The spacing that particles want at a crease of a dihedral angle (radians): the same as on a surface whose normal
/// turns by that angle within one spacing s, D = angle/s. With rho = 0 it is s.
/// Derivation: Documentation/algorithm.md, section Boundary curves and creases.
inline double spacingAtCrease(const SizingFunction& sizing, double angle)
{
  return sizing.at(angle / sizing.spacing);
}

/// Places along the creases that were found, half a spacing apart at most, and the spacings wanted there
/// (Meyer et al. 2007, section 4.3: particles stand closer near faces across which the normal is discontinuous).
/// None with rho = 0.
/// \param evaluations is increased by the number of evaluations
std::vector<SizingField::Limit> findCreaseSpacings(const Isosurface& surface,
  const SurfaceProxy& proxy, const FaceJumps& jumps, const ParallelFor& parallelFor,
  std::int64_t& evaluations);

} // namespace hop
