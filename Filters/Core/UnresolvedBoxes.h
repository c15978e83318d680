#pragma once

#include "Particles.h"
#include "SurfaceBox.h"

namespace hop
{

/// Counts the boxes that isolation could not decide, and what makes them so: fills the report's boxes,
/// boxesUnresolved, unresolvedCells and singularPoints.
void reportUnresolved(
  const Isosurface& surface, const std::vector<SurfaceBox>& boxes, DistributionReport& report);

} // namespace hop
