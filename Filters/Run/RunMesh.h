#pragma once

#include "Isolation/SurfaceBox.h"
#include "Output/OutputRows.h"
#include "Run/Work.h"
#include "Surface/SurfaceWalker.h"
#include "Topology/SurfaceTopology.h"

#include <optional>
#include <vector>

namespace hop
{

/// What the output is made of.
enum class OutputType
{
  Particles,
  Triangles,
  CurvedTriangles
};

/// A surface that may be meshed several times, and what is known of it from one time to the next.
struct MeshedSurface
{
  Isosurface surface;
  /// See DistributionParameters::boxes.
  std::vector<SurfaceBox> boxes;
  /// Found with the first mesh.
  std::optional<SurfaceTopology> topology;
};

/// The mesh that goes with the type of the output; none for particles. Particles may be added: where holes are filled,
/// and as nodes of curved triangles.
/// \param own the surface that the particles are on; the same as `surface`, or one whose field or isovalue is lifted
/// (LiftedField.h), from which particles are put back onto the surface once they are joined
/// \param order of curved triangles
/// \param isCut whether the particles cover a part of the surface only, of whose topology nothing is proven
/// \param some whose mesh and areas are computed
/// \return whether all particles are on the surface
/// \throw Interrupted
bool addMesh(const Isosurface& surface, MeshedSurface& own, OutputType type, int order, bool isCut,
  IsovalueParticles& some, const Work& work);

/// How much a mesh lacks: its holes, particles without a triangle, and one more where its topology is not proven.
std::int64_t lackOf(const ParticleMesh& mesh);

} // namespace hop
