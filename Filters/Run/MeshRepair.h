#pragma once

#include "Output/OutputRows.h"
#include "Run/ParticleRun.h"
#include "Run/Work.h"
#include "Surface/DistributionParameters.h"
#include "Surface/SurfaceWalker.h"

#include <optional>

namespace hop
{

/// Makes meshes anew that lack something: of a field that differs a little where the surface passes through nodes or is
/// singular, and with particles nearer to each other around holes.
/// Derivation: Documentation/algorithm.md, section Mesh.
class MeshRepair
{
public:
  /// \param parameters of the particles that were joined, which cover all of the surface
  /// \pre all arguments outlive the repair
  MeshRepair(const Isosurface& surface, const DistributionParameters& parameters,
    const RunProperties& properties, const Work& work)
    : Surface(surface)
    , Parameters(parameters)
    , Properties(properties)
    , Task(work)
  {
  }

  /// \param some replaced where a new mesh lacks less, and is of all of the surface
  /// \throw Interrupted
  void run(IsovalueParticles& some) const;

private:
  void meshLifted(IsovalueParticles& some) const;
  bool meshBesideNodes(double height, IsovalueParticles& some) const;
  void meshAroundFaults(bool inPieces, IsovalueParticles& some) const;
  std::optional<IsovalueParticles> meshAnew(
    const Isosurface& own, const DistributionParameters& parameters, double isovalue) const;
  bool takeBetter(std::optional<IsovalueParticles> other, IsovalueParticles& some) const;
  bool isInPlaceOf(const IsovalueParticles& own, const IsovalueParticles& other) const;

  const Isosurface& Surface;
  const DistributionParameters& Parameters;
  const RunProperties& Properties;
  const Work& Task;
};

} // namespace hop
