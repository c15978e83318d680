#pragma once

#include "Elements/NodalBasis.h"
#include "Input/InputBlocks.h"
#include "Input/UserMessage.h"
#include "Output/ParticlePacker.h"
#include "Run/PreviousRun.h"
#include "Run/RunMesh.h"
#include "Run/RunScale.h"
#include "Support/Exchange.h"
#include "Surface/DistributionParameters.h"

#include <cstdint>
#include <functional>
#include <set>
#include <vector>

namespace hop
{

/// What a run reads of the filter's properties; see vtkHighOrderParticleIsosurface.
struct RunProperties
{
  /// Finite, each once.
  std::vector<double> isovalues;
  /// To what each isosurface is cut, where it is a plane, world units. Fast only, without a given number.
  std::vector<PlanePolygon> polygons;
  double angularDensity = 0.0;
  /// World units; 0 for the automatic one.
  double smallestSpacing = 0.0;
  /// What the scalars were made of by averages at nodes; Value: they were not.
  Quantity averaged = Quantity::Value;
  NodeSpacing nodeSpacing = NodeSpacing::Uniform;
  Quality quality = Quality::Standard;
  std::uint64_t seed = 1;
  /// 0: the spacing decides.
  std::int64_t numberOfParticles = 0;
  bool isClassic = false;
  /// That a worker of a slab is worth; 0: an isosurface has one worker.
  std::int64_t particlesPerWorker = 0;
  /// Whether particles of the previous run go on where they can.
  bool isWarmStart = true;
  PassedArrays passed;
  OutputType outputType = OutputType::Particles;
  /// Of curved triangles.
  int order = 2;
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
  /// Receives the number of particles that an isosurface will have, about, before they take their time.
  std::function<void(double)> expect;
};

/// What a run gives besides the particles.
struct RunResult
{
  /// The number of this rank's particles, one an isovalue.
  std::vector<std::int64_t> counts;
  /// Whether nothing has failed or been interrupted on any rank.
  bool isComplete = false;
};

/// The road of one request, from checked blocks to their particles. Blocks that share cells are put into different
/// groups. For each group, every rank converts its own cells to elements and sends those that can hold surface to the
/// workers: for each isosurface one rank, which distributes the particles as if it were alone, or, where there are many
/// particles, one a slab of it (Fast/SlabWorkers.h). Particles go home to the rank of their cell, which packs them into
/// the outputs of its blocks.
///
/// Where the run is interrupted or memory runs out on one rank, the group's blocks stay without particles on all.
class ParticleRun
{
public:
  /// \param previous holds the places of the particles of the previous run, and then of this run, of the isosurfaces
  /// that this rank is the worker of
  /// \pre all arguments outlive the run
  ParticleRun(const RunProperties& properties, const RunScale& scale, const RunCaller& caller,
    PreviousRun& previous);

  /// Every rank has to call this, also one without blocks.
  RunResult run(const InputBlocks& mine) const;

private:
  bool findGroups(
    Exchange& exchange, const InputBlocks& blocks, std::vector<std::set<int>>& groups) const;

  const RunProperties& Properties;
  const RunScale& Scale;
  const RunCaller& Caller;
  PreviousRun& Previous;
};

} // namespace hop
