#pragma once

#include "Isolation/SurfaceBox.h"
#include "Surface/Particles.h"

namespace hop
{

/// Counts the boxes that isolation could not decide, and what makes them so: fills the report's boxes,
/// boxesUndecided, undecidedCells and singularPoints.
void reportUndecided(
  const Isosurface& surface, const std::vector<SurfaceBox>& boxes, DistributionReport& report);

} // namespace hop
