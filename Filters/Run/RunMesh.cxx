#include "Run/RunMesh.h"

#include "Mesh/CurvedTriangles.h"
#include "Mesh/LiftedField.h"
#include "Mesh/SharedEdges.h"
#include "Mesh/Slivers.h"
#include "Mesh/SurfaceMesh.h"
#include "Mesh/TriangleNormal.h"
#include "Support/Interruptible.h"
#include "Topology/TopologyComparison.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

namespace hop
{

namespace
{

/// A component of the surface on which the mesh has no triangle.
MeshComponent missingComponent(const ElementMesh& mesh, const SurfaceComponent& component)
{
  const Element& element = mesh.elements[component.element];
  const Jet jet = evaluateGradient(mesh.form(component.element), middleOf(facts(element.domain)));
  return { { glm::dvec3(jet.value) }, element.cell, component.eulerCharacteristic,
    component.boundaryLoops, false };
}

/// The parts of a mesh, and what it lacks.
std::vector<MeshComponent> partsOf(const ElementMesh& elements, const Buffer<Particle>& particles,
  const SurfaceTopology& topology, const TopologyComparison& comparison)
{
  std::vector<MeshComponent> parts;
  for (const ComponentComparison& part : comparison.meshComponents)
  {
    const Particle& vertex = particles[part.vertex];
    parts.push_back({ vertex.position, elements.elements[vertex.location.element].cell,
      part.eulerCharacteristic, part.boundaryLoops, part.proven });
  }
  for (const int missing : comparison.missingComponents)
  {
    parts.push_back(missingComponent(elements, topology.components[missing]));
  }
  return parts;
}

/// Compares a mesh with what is proven of the surface.
/// \param topology that is proven
/// \param isCut whether the mesh covers a part of the surface only, of which nothing is proven
/// \param mesh whose vertices are known; receives what comes out
void compare(const ElementMesh& elements, const SurfaceTopology& topology,
  const Buffer<Particle>& particles, std::vector<std::array<int, 3>> triangles, bool isCut,
  ParticleMesh& mesh, const ParallelFor& parallelFor)
{
  for (std::array<int, 3>& corners : triangles)
  {
    for (int& corner : corners)
    {
      corner = mesh.vertices[corner];
    }
  }
  TopologyComparison comparison = compareTopology(topology, particles, triangles, parallelFor);
  if (isCut)
  {
    comparison.missingComponents.clear();
  }
  mesh.components = static_cast<std::int64_t>(comparison.meshComponents.size());
  mesh.parts = partsOf(elements, particles, topology, comparison);
  mesh.unprovenComponents = std::count_if(
    mesh.parts.begin(), mesh.parts.end(), [](const MeshComponent& part) { return !part.proven; });
  mesh.isProven = comparison.proven;
}

/// What is proven of a surface, of which a part only may be meshed.
void prove(bool isCut, MeshedSurface& own, const ParallelFor& parallelFor)
{
  if (own.topology)
  {
    return;
  }
  const ElementMesh& mesh = *own.surface.mesh;
  const FaceLocator locator(mesh, own.surface.isovalue, parallelFor);
  own.topology = findTopology(mesh, own.surface.isovalue, &locator, parallelFor);
  for (SurfaceComponent& component : own.topology->components)
  {
    component.proven = component.proven && !isCut;
  }
}

/// Joins the particles to triangles, and says what is known of them.
SurfaceMesh join(MeshedSurface& own, const ConstrainedEdges& edges, bool isCut,
  IsovalueParticles& some, const Work& work)
{
  Distribution& distribution = some.distribution;
  SurfaceMesh mesh = meshSurface(own.surface, edges, distribution, work.monitor, work.parallelFor);
  some.mesh.openLoops = mesh.openLoops;
  some.mesh.openLength = mesh.openLength;
  some.mesh.longestLoop = mesh.longestLoop;
  some.mesh.onLongestLoop = mesh.onLongestLoop;
  some.mesh.particles = static_cast<std::int64_t>(distribution.particles.size());
  some.mesh.atFaults = std::move(mesh.atFaults);
  some.mesh.unusedParticles = mesh.unusedParticles;
  some.mesh.turnedTriangles = mesh.turnedTriangles;
  some.mesh.nodesPerCell = 3;
  some.mesh.vertices = firstInPlace(distribution.edges, distribution.particles.size());
  some.mesh.shared = sharedPlaces(some.mesh.vertices);
  Interruptible loops(work.monitor, work.parallelFor);
  prove(isCut, own, std::ref(loops));
  compare(*own.surface.mesh, *own.topology, distribution.particles, mesh.triangles, isCut,
    some.mesh, std::ref(loops));
  if (some.mesh.openLoops == 0 && some.mesh.isProven)
  {
    // The mesh has all of the surface without them.
    some.mesh.unusedParticles = 0;
    some.mesh.atFaults.clear();
  }
  if (lackOf(some.mesh) == 0)
  {
    // There will be no other mesh.
    own.topology.reset();
    own.boxes = {};
  }
  return mesh;
}

/// Bends the triangles of a mesh.
void bend(const Isosurface& surface, const std::vector<std::array<int, 3>>& triangles, int order,
  IsovalueParticles& some, const ParallelFor& parallelFor)
{
  const FaceLocator locator(*surface.mesh, surface.isovalue, parallelFor);
  Isosurface located = surface;
  located.locator = &locator;
  ParticleMesh& mesh = some.mesh;
  Buffer<Particle>& particles = some.distribution.particles;
  CurvedTriangles curved =
    bendTriangles(located, triangles, mesh.vertices, order, particles, parallelFor);
  mesh.nodesPerCell = CurvedTriangles::nodeCount(order);
  mesh.nodes = std::move(curved.nodes);
  mesh.straightNodes = curved.straightNodes;
  // Each new node is alone in its place.
  const std::size_t corners = mesh.vertices.size();
  mesh.vertices.resize(particles.size());
  std::iota(mesh.vertices.begin() + static_cast<std::ptrdiff_t>(corners), mesh.vertices.end(),
    static_cast<int>(corners));
  some.distribution.report.evaluations += curved.evaluations + locator.evaluations();
}

/// Shares the area around particles with those that were added in their places.
void shareAreas(const std::vector<std::array<int, 2>>& copies, std::vector<double>& areas)
{
  std::map<int, std::vector<int>> copiesOf;
  for (const auto& [particle, copy] : copies)
  {
    copiesOf[particle].push_back(copy);
  }
  for (const auto& [particle, all] : copiesOf)
  {
    areas[particle] /= static_cast<double>(all.size() + 1);
    for (const int copy : all)
    {
      areas[copy] = areas[particle];
    }
  }
}

/// Shares the areas of triangles equally among their corners: of particles that were put back, whose neighbours are not
/// where curves along edges of the mesh would look for them.
std::vector<double> areasOf(
  const std::vector<std::array<int, 3>>& triangles, const Buffer<Particle>& particles)
{
  std::vector<double> areas(particles.size(), 0.0);
  for (const std::array<int, 3>& corners : triangles)
  {
    const double third = glm::length(doubleAreaNormal(particles, corners)) / 6.0;
    for (const int corner : corners)
    {
      areas[corner] += third;
    }
  }
  return areas;
}

/// Triangles that are turned away from the normal of a corner once their corners were put back.
std::int64_t countTurnedOver(
  const std::vector<std::array<int, 3>>& triangles, const Buffer<Particle>& particles)
{
  return std::count_if(triangles.begin(), triangles.end(),
    [&](const std::array<int, 3>& corners) { return isTurnedOver(particles, corners); });
}

/// Gives all particles in one place what those of them that cells use have together: the mean normal, and the area.
void mergePlaces(ParticleMesh& mesh, Buffer<Particle>& particles)
{
  std::vector<char> isUsed(particles.size(), 0);
  for (const int node : mesh.nodes)
  {
    isUsed[node] = 1;
  }
  struct Sum
  {
    WorldVector normal;
    double area = 0.0;
  };
  std::map<int, Sum> places;
  for (const auto& [vertex, p] : mesh.shared)
  {
    Sum& place = places[vertex];
    if (isUsed[p])
    {
      place.normal = place.normal + particles[p].normal;
      place.area += particles[p].area;
    }
  }
  for (auto& [vertex, place] : places)
  {
    const WorldVector& own = particles[vertex].normal;
    const bool isMean = place.normal.xyz != own.xyz && length(place.normal) > 0.0;
    place.normal = isMean ? (1.0 / length(place.normal)) * place.normal : own;
  }
  for (const auto& [vertex, p] : mesh.shared)
  {
    const Sum& place = places.at(vertex);
    if (particles[p].normal.xyz != place.normal.xyz)
    {
      particles[p].sideNormal = particles[p].normal.xyz;
      mesh.hasCreases = true;
    }
    particles[p].normal = place.normal;
    particles[p].area = place.area;
  }
}

} // namespace

bool addMesh(const Isosurface& surface, MeshedSurface& own, OutputType type, int order, bool isCut,
  IsovalueParticles& some, const Work& work)
{
  Distribution& distribution = some.distribution;
  const ParallelFor& parallelFor = work.parallelFor;
  Interruptible loops(work.monitor, parallelFor);
  if (type != OutputType::Particles)
  {
    uniteEnds(distribution);
  }
  const ConstrainedEdges edges(distribution);
  SurfaceMesh mesh;
  if (type != OutputType::Particles)
  {
    mesh = join(own, edges, isCut, some, work);
  }
  std::vector<double> areas;
  bool areOn = true;
  if (own.surface.mesh == surface.mesh && own.surface.isovalue == surface.isovalue)
  {
    areas = particleAreas(distribution, edges, work.monitor, parallelFor);
    shareAreas(mesh.copies, areas);
  }
  else
  {
    areOn = putBack(surface, distribution, std::ref(loops));
    loops.ask();
    removeSlivers(edges, distribution.particles, some.mesh.vertices, mesh.triangles);
    loops.ask();
    some.mesh.shared = sharedPlaces(some.mesh.vertices);
    some.mesh.turnedTriangles = countTurnedOver(mesh.triangles, distribution.particles);
    areas = areasOf(mesh.triangles, distribution.particles);
  }
  forAll(
    parallelFor, areas.size(), [&](std::size_t p) { distribution.particles[p].area = areas[p]; });
  if (type == OutputType::CurvedTriangles)
  {
    bend(surface, mesh.triangles, order, some, std::ref(loops));
  }
  else
  {
    some.mesh.nodes.reserve(3 * mesh.triangles.size());
    for (const std::array<int, 3>& corners : mesh.triangles)
    {
      some.mesh.nodes.insert(some.mesh.nodes.end(), corners.begin(), corners.end());
    }
  }
  mergePlaces(some.mesh, distribution.particles);
  return areOn;
}

std::int64_t lackOf(const ParticleMesh& mesh)
{
  return mesh.openLoops + mesh.unusedParticles + (mesh.isProven ? 0 : 1);
}

} // namespace hop
