#include "Mesh/SurfaceMesh.h"

#include "Mesh/HoleFilling.h"
#include "Mesh/LooseParticles.h"
#include "Mesh/ManifoldVertices.h"
#include "Mesh/ParticleStars.h"
#include "Mesh/ParticlesAround.h"
#include "Mesh/SharedEdges.h"
#include "Mesh/SmallBodies.h"
#include "Mesh/TriangleNormal.h"
#include "Support/Interruptible.h"

#include <algorithm>
#include <functional>

namespace hop
{
namespace
{

/// Particles without a triangle, those in one place taken for one.
std::vector<int> findUnused(const std::vector<int>& places, const TriangleFans& fans)
{
  std::vector<char> isUsed(places.size(), 0);
  for (std::size_t p = 0; p < places.size(); ++p)
  {
    isUsed[places[p]] |= fans.hasTriangles(static_cast<int>(p)) ? 1 : 0;
  }
  std::vector<int> unused;
  for (int p = 0; p < static_cast<int>(places.size()); ++p)
  {
    if (places[p] == p && !isUsed[p])
    {
      unused.push_back(p);
    }
  }
  return unused;
}

/// Whether a particle stands on a strip between two boundary curves that is narrower than particles tell.
bool isOnStripWithoutWidth(const Particle& particle)
{
  // In units of the spacing: the distance of particles on two sides of a slit (BoundaryThinning.cpp).
  constexpr double none = 0.02;
  constexpr double opposite = -0.9; // cosine
  const auto isHere = [&](const ClipPlane& plane)
  { return plane.isBoundary() && plane.distance <= none * particle.spacing; };
  for (const ClipPlane& one : particle.clips)
  {
    for (const ClipPlane& other : particle.clips)
    {
      if (isHere(one) && isHere(other) && dot(one.normal, other.normal) < opposite)
      {
        return true;
      }
    }
  }
  return false;
}

/// Leaves out particles that a mesh in pieces, of whose topology nothing is proven, does not need if it has no holes: one
/// or two alone, in the midst of the surface and beside particles of the mesh, as where it bends within a spacing. A
/// component has more of them, and pieces have particles on their boundary curves. Those on strips without width have no
/// triangles.
void leaveOutSpare(
  const ParticleNeighbors& neighbors, const ConstrainedEdges& edges, std::vector<int>& unused)
{
  if (unused.empty())
  {
    return;
  }
  const std::vector<int> all = unused;
  const ParticlesAround around(neighbors.points);
  const auto isSpare = [&](int p)
  {
    if (isOnStripWithoutWidth(neighbors.particles[p]))
    {
      return true;
    }
    if (static_cast<std::size_t>(p) >= neighbors.seen.size() || edges.isOnEdge(p) ||
      neighbors.particles[p].jump != 0.0)
    {
      return false;
    }
    int used = 0, others = 0;
    for (const int other : around.of(p))
    {
      const bool isUnused = std::binary_search(all.begin(), all.end(), other);
      used += neighbors.areOnOnePiece(p, other) && !isUnused ? 1 : 0;
      others += isUnused ? 1 : 0;
    }
    return used > 0 && others < 2;
  };
  unused.erase(std::remove_if(unused.begin(), unused.end(), isSpare), unused.end());
}

/// Counts triangles that are turned away from the normal of a corner. A closed mesh has its faults, if it has any, where
/// they are turned from all corners.
void countTurned(const Buffer<Particle>& particles, SurfaceMesh& mesh)
{
  const bool areFaults = mesh.atFaults.empty();
  for (const std::array<int, 3>& corners : mesh.triangles)
  {
    if (isTurnedOver(particles, corners))
    {
      ++mesh.turnedTriangles;
      if (areFaults && isTurnedFromMean(particles, corners))
      {
        mesh.atFaults.insert(mesh.atFaults.end(), corners.begin(), corners.end());
      }
    }
  }
}

/// The edges of a loop at which the mesh lacks something. Where particles do not tell on which side of an edge the surface
/// is, and the mesh is on the other side, it may end there: such edges count only if a loop has no others.
std::vector<std::array<int, 2>> lackingEdges(
  const OpenLoop& loop, const ConstrainedEdges& edges, const TriangleFans& fans)
{
  std::vector<std::array<int, 2>> all, lacking;
  for (std::size_t n = 0; n < loop.edgeCount(); ++n)
  {
    const int a = loop.particles[n];
    const int b = loop.particles[(n + 1) % loop.particles.size()];
    const bool mayEnd = edges.has(a, b) && edges.has(b, a) && fans.apexOf(b, a) >= 0;
    all.push_back({ a, b });
    if (!mayEnd)
    {
      lacking.push_back({ a, b });
    }
  }
  return lacking.empty() ? all : lacking;
}

/// What is open.
void countOpen(const Isosurface& surface, const Distribution& distribution,
  const ConstrainedEdges& edges, const TriangleFans& fans, SurfaceMesh& mesh,
  const ParallelFor& parallelFor)
{
  const Buffer<Particle>& particles = distribution.particles;
  for (const OpenLoop& loop : findOpenLoops(particles, edges, fans, parallelFor))
  {
    if (isAlongEnds(*surface.mesh, distribution, loop, edges))
    {
      continue;
    }
    ++mesh.openLoops;
    double around = 0.0;
    for (const auto& [a, b] : lackingEdges(loop, edges, fans))
    {
      around += length(particles[b].position - particles[a].position);
      mesh.atFaults.insert(mesh.atFaults.end(), { a, b });
    }
    mesh.openLength += around;
    if (mesh.onLongestLoop < 0 || around > mesh.longestLoop)
    {
      mesh.longestLoop = around;
      mesh.onLongestLoop = loop.particles[0];
    }
  }
}

} // namespace

SurfaceMesh meshSurface(const Isosurface& whole, ConstrainedEdges edges, Distribution& distribution,
  const Monitor& monitor, const ParallelFor& parallelFor)
{
  Interruptible work(monitor, parallelFor);
  const ParallelFor parallel(std::ref(work));
  const std::vector<float> tolerances = distribution.pieces.jumpTolerances();
  Isosurface surface = whole;
  surface.jumpTolerances = tolerances.empty() ? whole.jumpTolerances : &tolerances;
  const ParticleNeighbors neighbors(distribution, parallel);
  TriangleFans fans = agreedTriangles(neighbors, edges, parallel);
  SurfaceMesh mesh;
  // Holes that touched in a vertex become one, which may be filled.
  constexpr int mostTimes = 2;
  bool isOpen = true;
  for (int n = 0; isOpen && n < mostTimes; ++n)
  {
    fillHoles(surface, neighbors, edges, distribution, fans, parallel);
    const auto copies = splitFans(edges, distribution.particles, fans, parallel);
    mesh.copies.insert(mesh.copies.end(), copies.begin(), copies.end());
    isOpen = keepOneFan(fans, parallel);
  }
  const auto openLoops = [&]()
  { return findOpenLoops(distribution.particles, edges, fans, parallel); };
  std::vector<OpenLoop> loops = openLoops();
  if (closeSmallBodies(neighbors, edges, loops, fans))
  {
    loops = openLoops();
  }
  joinLooseParticles(neighbors, edges, loops, fans);
  splitSharedEdges(surface, firstInPlace(distribution.edges, distribution.particles.size()),
    distribution, fans, parallel);
  const std::vector<int> places = firstInPlace(distribution.edges, distribution.particles.size());
  mesh.triangles = distribution.edges.coincident.empty() ? fans.triangles(parallel)
                                                         : keepManifold(places, fans, parallel);
  countOpen(surface, distribution, edges, fans, mesh, parallel);
  std::vector<int> unused = findUnused(places, fans);
  if (mesh.openLoops == 0 && !distribution.pieces.areOne())
  {
    leaveOutSpare(neighbors, edges, unused);
  }
  mesh.unusedParticles = static_cast<std::int64_t>(unused.size());
  mesh.atFaults.insert(mesh.atFaults.end(), unused.begin(), unused.end());
  countTurned(distribution.particles, mesh);
  std::sort(mesh.atFaults.begin(), mesh.atFaults.end());
  mesh.atFaults.erase(std::unique(mesh.atFaults.begin(), mesh.atFaults.end()), mesh.atFaults.end());
  return mesh;
}

} // namespace hop
