#include "Mesh/SurfaceMesh.h"

#include "Mesh/ParticleStars.h"
#include "Support/Interruptible.h"

#include <functional>

namespace hop
{

SurfaceMesh meshSurface(const Isosurface&, Distribution& distribution, const Monitor& monitor,
  const ParallelFor& parallelFor)
{
  Interruptible work(monitor, parallelFor);
  const ParallelFor parallel(std::ref(work));
  const ConstrainedEdges edges(distribution);
  TriangleFans fans = agreedTriangles(distribution.particles, edges, parallel);
  SurfaceMesh mesh;
  mesh.triangles = fans.triangles(parallel);
  return mesh;
}

} // namespace hop
