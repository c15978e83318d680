#pragma once

#include "Output/OutputRows.h"
#include "Run/ParticleRun.h"
#include "Run/RunMesh.h"
#include "Run/Work.h"
#include "Surface/DistributionParameters.h"

#include <memory>
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
  MeshRepair(MeshedSurface& surface, const DistributionParameters& parameters,
    const RunProperties& properties, const Work& work)
    : Whole(surface)
    , Surface(surface.surface)
    , Parameters(parameters)
    , Properties(properties)
    , Task(work)
  {
  }

  /// \param some replaced where a new mesh lacks less, and is of all of the surface
  /// \throw Interrupted
  void run(IsovalueParticles& some);

private:
  /// A surface beside the one to be meshed, on which particles can be told apart.
  struct LiftedSurface : MeshedSurface
  {
    /// Its field, if it is another one.
    std::optional<ElementMesh> mesh;
  };

  /// What came of making a mesh anew.
  enum class Try
  {
    /// There is none: particles did not come back to the surface, or enough was tried.
    None,
    /// It does not replace the one that there was.
    Worse,
    Better
  };

  void meshBesideNodes(IsovalueParticles& some);
  bool meshBesideNodes(double height, IsovalueParticles& some);
  bool meshBeside(IsovalueParticles& some);
  Try meshOn(std::unique_ptr<LiftedSurface> lifted, IsovalueParticles& some);
  void meshAroundFaults(bool inPieces, IsovalueParticles& some);
  std::optional<IsovalueParticles> meshAnew(
    MeshedSurface& own, DistributionParameters parameters, double isovalue);
  bool takeBetter(IsovalueParticles other, bool onAnother, IsovalueParticles& some) const;
  bool isInPlaceOf(
    const IsovalueParticles& own, const IsovalueParticles& other, bool onAnother) const;

  MeshedSurface& Whole;
  const Isosurface& Surface;
  const DistributionParameters& Parameters;
  const RunProperties& Properties;
  const Work& Task;
  /// Where the particles stand if not on the surface itself.
  std::unique_ptr<LiftedSurface> Lifted;
  /// That may still be distributed.
  std::int64_t ParticlesLeft = 0;
};

} // namespace hop
