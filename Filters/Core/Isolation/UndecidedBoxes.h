#pragma once

#include "Isolation/SurfaceBox.h"
#include "Surface/Particles.h"

namespace hop
{

/// Counts the boxes that isolation could not decide, and the singular points that are their reason. Fills the report's
/// boxes, boxesUndecided, undecidedCells and singularPoints.
/// \param boxes in the order of the elements
void reportUndecided(
  const Isosurface& surface, const std::vector<SurfaceBox>& boxes, DistributionReport& report);

} // namespace hop
