#pragma once

#include "Isolation/SurfaceBox.h"
#include "Surface/SurfaceWalker.h"

namespace hop
{

/// Assigns each sheet of the surface that lies in a face of the mesh to exactly one element, the same for F = c and
/// -F = -c. Of the two elements at the face, the one in which F > c has the sheet; if F > c in both or in neither, the
/// first one. At the end of the mesh the only element has it, and where the surface is in the face for one element
/// only, by rounding, that one, unless the surface lies just behind the face for the other one.
///
/// Values of boxes at corners where F = c up to rounding errors become exactly zero. Marching and face crossings take
/// zero for below the isovalue: the other values of a box that has the sheet become positive, those of a box that does
/// not have the sheet become negative. A box without the sheet is dropped if F - c has the same sign in both elements,
/// as the sheet would have the opposite normal in it.
/// \return the boxes that are kept, in their order
std::vector<SurfaceBox> assignFaceSheets(
  const Isosurface& surface, std::vector<SurfaceBox> boxes, const ParallelFor& parallelFor);

} // namespace hop
