#pragma once

#include "Elements/NodalBasis.h"
#include "Input/InputBlocks.h"
#include "Input/UserMessage.h"
#include "Run/PreviousRun.h"
#include "Run/RunScale.h"
#include "Surface/DistributionParameters.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace hop
{

/// What a run reads of the filter's properties; see vtkHighOrderParticleIsosurface.
struct RunProperties
{
  /// Finite, each once.
  std::vector<double> isovalues;
  double angularDensity = 0.0;
  /// World units; 0 for the automatic one.
  double smallestSpacing = 0.0;
  NodeSpacing nodeSpacing = NodeSpacing::Uniform;
  Quality quality = Quality::Standard;
  std::uint64_t seed = 1;
  /// 0: the spacing decides.
  std::int64_t numberOfParticles = 0;
  bool isClassic = false;
  /// Whether particles of the previous run go on where they can.
  bool isWarmStart = true;
  /// Whether the output tells more than pictures need.
  bool passesDiagnostics = false;
};

/// How a run speaks to the filter.
struct RunCaller
{
  /// Receives the fraction of the run that is done, 0 to 1; returns false to ask for an early end.
  std::function<bool(double)> report;
  /// Whether the run is to end early.
  std::function<bool()> isAborted;
  /// Passes messages on to the user.
  std::function<void(const UserMessages&)> tell;
};

/// The road of one request, from checked blocks to their particles. Blocks that share cells are put into different
/// groups. For each group, cells are converted to elements, ranks share out the number of particles if it is given,
/// particles are distributed on each isosurface, and packed into the outputs of the blocks.
///
/// Where the run is interrupted or memory runs out, blocks stay without particles.
class ParticleRun
{
public:
  /// \param previous holds the places of the previous run's particles, and then of this run's
  /// \pre all arguments outlive the run
  ParticleRun(const RunProperties& properties, const RunScale& scale, const RunCaller& caller,
    PreviousRun& previous);

  /// Every rank has to call this, also one without blocks.
  /// \return the number of this rank's particles, one an isovalue
  std::vector<std::int64_t> run(const InputBlocks& blocks) const;

private:
  std::vector<InputBlocks> groupsOf(const InputBlocks& blocks) const;

  const RunProperties& Properties;
  const RunScale& Scale;
  const RunCaller& Caller;
  PreviousRun& Previous;
};

} // namespace hop
