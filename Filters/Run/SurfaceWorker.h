#pragma once

#include "Elements/ElementMesh.h"
#include "Output/OutputRows.h"
#include "Run/ParticleRun.h"
#include "Run/RankBlocks.h"
#include "Run/Work.h"

#include <cstddef>
#include <functional>

namespace hop
{

/// Distributes particles on isosurfaces of a mesh that holds the elements of all ranks, and tells of what could not be
/// done.
class SurfaceWorker
{
public:
  /// \param mesh joined; its cells are numbered as in `blocks`
  /// \pre all arguments outlive the worker
  SurfaceWorker(const ElementMesh& mesh, const RankBlocks& blocks, const RunProperties& properties,
    const RunScale& scale, const RunCaller& caller, PreviousRun& previous);

  /// Distributes the particles of an isosurface, and joins them to a mesh if one is asked for.
  /// \param fieldIsovalue the value of the mesh's field where the chosen scalar has the isovalue
  /// \param number tells the isosurfaces of a run from one another
  /// \param some whose isovalue is given
  /// \throw Interrupted
  void distribute(
    double fieldIsovalue, std::size_t number, const Work& work, IsovalueParticles& some) const;

  /// What particles on an isosurface are asked for.
  DistributionParameters parametersOf(double isovalue) const
  {
    return this->makeOrigin(isovalue).parameters;
  }

  /// Tells of what could not be done.
  void review(double isovalue, double fieldIsovalue, const Distribution& distribution,
    const Work& work) const;

private:
  SizingFunction sizingAt(double spacing) const;
  RunOrigin makeOrigin(double isovalue) const;
  PlanePolygon polygonOf(double isovalue) const;
  void reviewSpacing(double isovalue, double fieldIsovalue, const Distribution& distribution,
    const Work& work) const;

  const ElementMesh& Mesh;
  const RankBlocks& Blocks;
  const RunProperties& Properties;
  const RunScale& Scale;
  const RunCaller& Caller;
  PreviousRun& Previous;
};

} // namespace hop
