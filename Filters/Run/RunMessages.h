#pragma once

#include "Conversion/CellCensus.h"
#include "Input/InputBlocks.h"
#include "Input/UserMessage.h"
#include "Output/OutputRows.h"
#include "Output/ParticlePacker.h"
#include "Run/RankBlocks.h"
#include "Run/SpacingAdvice.h"
#include "Surface/Particles.h"

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

namespace hop
{

// `numberOfParticles` is the filter's NumberOfParticles. The advice depends on it: where it is positive, Spacing is
// ignored.

/// What goes on while an isosurface gets its particles, of which noise makes many: the text beside the progress.
std::string describeExpected(double particles);

/// Tells of a run that ended in an exception.
UserMessage describeFailure(const std::exception& failure, std::int64_t numberOfParticles);

/// Tells which arrays are not passed on.
UserMessages reviewArrays(const std::vector<InputBlock>& blocks, const PassedArrays& passed);

/// Tells which cells are not as they should be.
/// \param census one census a block
UserMessages reviewCells(const InputBlocks& blocks, const std::vector<CellCensus>& census);

/// Tells what a distribution could not do.
UserMessages reviewDistribution(const RankBlocks& blocks, const Distribution& distribution,
  double isovalue, std::int64_t numberOfParticles);

/// Tells of a surface that bends faster than the spacing of its particles can follow.
/// \param cell of the particle advice.worst
UserMessage reviewUndersampled(const RankBlocks& blocks, const Distribution& distribution,
  const SpacingAdvice& advice, std::int64_t cell, double isovalue, std::int64_t numberOfParticles);

/// Tells what a mesh lacks.
/// \param unit of length of the run, world units
/// \param mesh the elements of all ranks
UserMessages reviewMesh(
  const RankBlocks& blocks, const ElementMesh& mesh, const IsovalueParticles& some, double unit);

/// Tells which isovalues have no surface in any block on any rank, and the range of the values. Every rank has to call
/// this.
/// \param counts of this rank's particles, one an isovalue
/// \param isExplained whether the run was ended early, or something else was told that may be the reason: then only
///   isovalues out of the range are named
UserMessages reviewSurfaces(const InputBlocks& blocks, const std::vector<double>& isovalues,
  const std::vector<std::int64_t>& counts, bool isExplained);

} // namespace hop
