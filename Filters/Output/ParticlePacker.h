#pragma once

#include "Output/ForeignCorners.h"
#include "Output/OutputRows.h"

#include <string>
#include <vector>

namespace hop
{

/// What outputs have besides what pictures need.
struct PassedArrays
{
  /// All arrays of Output/OutputArrays.h, the report included.
  bool diagnostics = false;
  /// The arrays of Output/DerivativeArrays.h.
  bool derivatives = false;
};

/// Writes particles, or meshes between them, one output a block: points, cells, the particles' own arrays, the
/// point arrays of the block's grid evaluated and its cell arrays copied. Particles are vertices and triangles polygons
/// of vtkPolyData; curved triangles are Lagrange triangles of vtkUnstructuredGrid. See vtkHighOrderParticleIsosurface for
/// names and meaning of the arrays.
/// \param elements coefficients and neighbours are not needed
/// \return for each block the rows whose corners are at home on other ranks, see askForForeignCorners()
/// \throw Interrupted if work's monitor asks for an early end; the outputs are unfinished then
std::vector<ForeignCorners> packParticles(const InputBlocks& blocks, const GridElements& elements,
  const std::vector<IsovalueParticles>& isovalues, const PassedArrays& passed, Interruptible& work);

/// Names the arrays of the input that packParticles() does not pass on because the output has an array of its own with
/// this name: "point array 'Radius'", each once. Arrays without a meaning on the surface, ids for instance, are left
/// out.
std::vector<std::string> replacedArrays(
  const std::vector<InputBlock>& blocks, const PassedArrays& passed);

} // namespace hop
