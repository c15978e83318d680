#pragma once

#include "Conversion/GridElements.h"
#include "Support/Interruptible.h"
#include "Surface/Particles.h"

#include <string>
#include <vector>

/// Particles of one isovalue.
struct IsovalueParticles
{
  double isovalue = 0.0;
  hop::Distribution distribution;
};

/// Writes particles as vtkPolyData, one a block: points, vertex cells, the particles' own arrays, the
/// point arrays of the block's grid evaluated and its cell arrays copied. Particles in ghost cells are
/// left out: they belong to another rank. See vtkHighOrderParticleIsosurface for names and meaning of
/// the arrays.
/// \throw hop::Interrupted if work's monitor asks for an early end; the outputs are unfinished then
void packParticles(const InputBlocks& blocks, const GridElements& elements,
  const std::vector<IsovalueParticles>& isovalues, hop::Interruptible& work);

/// Whether packParticles() makes a point array of that name itself.
bool isOwnPointArray(const std::string& name);

/// What packParticles() does not pass on, as the output has an array of its own of that name: "point array
/// 'Radius'", each once. Arrays that mean nothing on the surface, as ids, do not count.
std::vector<std::string> replacedArrays(const std::vector<InputBlock>& blocks);
