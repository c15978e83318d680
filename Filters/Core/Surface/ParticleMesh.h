#pragma once

#include "Elements/GatheredMesh.h"
#include "Surface/Particles.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace hop
{

/// Where a particle is at home that is a corner here.
struct ForeignHome
{
  ElementHome element;
  /// The block of the element's cell, by its number on all ranks.
  int block = 0;
};

/// What is known of a mesh as a whole.
struct MeshNumbers
{
  /// Corners of a cell, and the nodes of a curved one; 0: there is no mesh, and each particle is a cell.
  int nodesPerCell = 0;
  /// Boundary loops that are no boundary curves of the surface, and their length, in the unit of the run.
  std::int64_t openLoops = 0;
  double openLength = 0.0;
  /// Particles that no cell uses.
  std::int64_t unusedParticles = 0;
  /// Triangles, before they are bent, that are turned away from the normal of a corner.
  std::int64_t turnedTriangles = 0;
  /// Nodes of curved cells that are not on the surface.
  std::int64_t straightNodes = 0;
  /// Whether particles in one place have normals of several sides.
  bool hasCreases = false;
  /// Connected parts of the mesh, and those that are not proven to be as the surface is, with the components of the
  /// surface that the mesh lacks.
  std::int64_t components = 0;
  std::int64_t unprovenComponents = 0;
  /// Whether the mesh is proven to have the topology of the surface.
  bool isProven = true;
};

/// A connected part of a mesh, or a component of the surface that the mesh lacks.
struct MeshComponent
{
  /// A vertex; of a component that the mesh lacks, the middle of an element that the component passes.
  WorldPoint place;
  /// The input's cell at this place, numbered as those of the elements are.
  std::int64_t cell = -1;
  /// Of the mesh; of a component that it lacks, the component's own, as far as they are proven.
  std::int64_t eulerCharacteristic = 0;
  std::int64_t boundaryLoops = 0;
  /// Whether it is proven to be as the surface is.
  bool proven = false;
};

/// Cells between the particles of one isovalue.
struct ParticleMesh : MeshNumbers
{
  /// By first vertices; last the components that the mesh lacks. The same on all ranks.
  std::vector<MeshComponent> parts;
  /// The longest of the open loops: its length, and a particle on it; -1 if there is none. Known to the worker alone.
  double longestLoop = 0.0;
  int onLongestLoop = -1;
  /// Particles without the nodes of curved cells that are no corners. Known to the worker alone.
  std::int64_t particles = 0;
  /// The particles on all of them, and those that no cell uses. Known to the worker alone.
  std::vector<int> atFaults;
  /// nodesPerCell indices into the particles a cell, the corners first.
  std::vector<int> nodes;
  /// For each particle the first particle in the same place: itself, but for creases.
  std::vector<int> vertices;
  /// For each place with several particles the first of them with each of them: in one order on all ranks.
  std::vector<std::array<int, 2>> shared;
  /// Where the last particles came from, if they are corners in elements of other ranks; in no element here.
  std::vector<ForeignHome> foreign;
};

/// Looks up which particles share their places.
/// \param first as ParticleMesh::vertices
std::vector<std::array<int, 2>> sharedPlaces(const std::vector<int>& first);

/// The number, the same on all ranks, of the block of a cell; cells are numbered as those of all ranks' elements are.
using BlockOfCell = std::function<int(std::int64_t cell)>;

/// Brings a mesh home: each cell to the rank of its first node, which also gets copies of the cell's other nodes, and of
/// all particles in their places. Every rank calls it, after bringHome(). A rank that is alone keeps its mesh.
/// \param whole on the worker, the distribution that bringHome() has brought home
/// \param mesh on the worker, the mesh of `whole`; receives this rank's
/// \param isDone whether this rank can take part
/// \param home this rank's particles; receives the copies behind them, whose elements are -1
/// \param parallelFor may throw Interrupted: then no rank has its part
/// \return whether every rank has its part; the same on all ranks
bool bringMeshHome(Exchange& exchange, int worker, const Distribution& whole, bool isDone,
  const GatheredMesh& all, const BlockOfCell& blockOf, ParticleMesh& mesh, Distribution& home,
  const ParallelFor& parallelFor);

} // namespace hop
