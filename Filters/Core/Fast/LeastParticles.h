#pragma once

#include "Fast/FinishParticles.h"
#include "Topology/ComponentTracer.h"

#include <functional>

namespace hop
{

/// A closed component of the surface on which too few particles stand.
struct SparseComponent
{
  /// Of the proxy, ascending.
  std::vector<int> boxes;
  /// Those that stand on it, ascending.
  std::vector<int> particles;
  /// As the proxy knows it, world units.
  double area = 0.0;
};

/// Particles that a closed component has at least, as in the paper.
constexpr std::size_t LeastParticles = 6;

/// Finds the closed components with fewer particles than LeastParticles. A component is sought where fewer particles
/// than that stand on the patch of a sample, and is proven to be closed: where there is none, this costs a search for
/// neighbours of each sample.
/// \param patches of all particles
/// \param particles finished ones
std::vector<SparseComponent> findSparseComponents(const Isosurface& surface,
  const SurfaceProxy& proxy, const Buffer<Patch>& patches, const Buffer<Particle>& particles,
  const ParallelFor& parallelFor);

/// Distributes particles on such components alone, evenly, at a spacing that goes with the area of each: a dozen, as on
/// an icosahedron, or up to half as many more.
/// \param jumps of the surface
/// \param finest no spacing is smaller, world units
FinishedParticles distributeOnComponents(const Isosurface& surface, const SurfaceProxy& proxy,
  const FaceJumps& jumps, const std::vector<SparseComponent>& components, double finest,
  std::uint64_t seed, const ParallelFor& parallelFor);

} // namespace hop
