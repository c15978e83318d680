#pragma once

#include "Isolation/SurfaceBox.h"
#include "Surface/SurfaceWalker.h"

namespace hop
{

/// Where the surface coincides with faces of elements, exactly one element has it afterwards, the same for
/// F = c and -F = -c: of two elements that with F > c in it or, if both or neither are, the first; at the
/// end of the mesh the only one.
///
/// Values at corners that are c to rounding become so exactly. Those of a box that is to have the sheet on
/// a face of its element are turned to lie above, as marching and face crossings take zero for below.
/// Boxes of a sheet that is the other element's, and has its normals the other way round there, are left
/// out.
std::vector<SurfaceBox> giveFaceSheetsOnce(
  const Isosurface& surface, std::vector<SurfaceBox> boxes, const ParallelFor& parallelFor);

} // namespace hop
