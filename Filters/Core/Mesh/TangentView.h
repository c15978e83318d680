#pragma once

#include "Kernel/Kernels.h"
#include "Mesh/ConstrainedEdges.h"
#include "Mesh/TangentPlane.h"
#include "Support/SpacedPoints.h"
#include "Support/SpacingGrid.h"

#include <glm/glm.hpp>

#include <vector>

namespace hop
{

/// Where particles are, without what else is known of them.
struct ParticlePlaces
{
  /// \pre the distribution outlives it
  ParticlePlaces(const Distribution& distribution, const ParallelFor& parallelFor);

  /// Whether two particles are on one piece of the surface.
  bool areOnOnePiece(int a, int b) const
  {
    return this->pieces.areOne() ||
      this->pieces.areSame(this->particles[a].location, this->particles[b].location);
  }

  bool isReplaced(int particle) const { return this->normals[particle] == glm::vec3(0.0f); }

  const Buffer<Particle>& particles;
  const SurfacePieces& pieces;
  SpacedPoints points;
  /// Zero, which is on no sheet, for those that are replaced (SurfaceEdges.h).
  Buffer<glm::vec3> normals;
  /// Whether the two sides of creases may be a little apart.
  bool hasJumps;
  /// Marks those in whose places there are others.
  std::vector<char> isShared;
};

/// Who is near whom on the surface.
struct ParticleNeighbors : ParticlePlaces
{
  /// Largest circumradius of a triangle in a star, in units of the spacing: 1/sqrt(3) in hexagonal packing, about 1
  /// where a particle is missing. Chosen by experiment. Larger: triangles across thin gaps, and more neighbours to look
  /// at; smaller: holes where particles stand unevenly.
  static constexpr double LargestRadius = 1.2;
  /// No neighbour farther away is in an empty circle: its diameter.
  static constexpr double Reach = 2.0 * LargestRadius;

  /// \pre the distribution outlives it
  ParticleNeighbors(const Distribution& distribution, const ParallelFor& parallelFor);

  /// The particles within reach of a particle.
  Span<int> of(int particle) const
  {
    const auto p = static_cast<std::size_t>(particle);
    return { this->seen.begin(p), static_cast<std::size_t>(this->seen.count(p)) };
  }

  SeenLists seen;
};

/// A neighbour of a particle in its tangent plane, at its distance in space; in units of the particle's spacing.
struct FlatNeighbor
{
  glm::dvec2 place{ 0.0 };
  int index = -1;
};

/// The surface around one particle after the other, laid into the tangent plane. Each thread needs one of its own.
class TangentView
{
public:
  TangentView(const ParticlePlaces& particles, const ConstrainedEdges& edges)
    : Particles(particles)
    , Edges(edges)
  {
  }

  /// A part of the plane around the particle in which the surface goes on: counterclockwise from one neighbour on a
  /// constrained edge to another; from a neighbour around to itself where only one edge ends at the particle.
  struct Sector
  {
    std::vector<FlatNeighbor> neighbors;
    int first = 0;
    int last = 0;
  };

  /// Lays the neighbours of a particle into its plane that are on the same sheet. Those that a constrained edge hides
  /// are left out.
  /// \param near the particles around, without itself
  void lookFrom(int particle, Span<int> near);

  const TangentPlane& plane() const { return this->Plane; }
  const std::vector<FlatNeighbor>& neighbors() const { return this->Neighbors; }
  /// Whether there are constrained edges around.
  bool isNearEdge() const { return this->IsNearEdge; }
  /// Empty for a particle that is on no constrained edge.
  Span<Sector> sectors() const { return { this->Sectors.data(), this->SectorCount }; }

private:
  struct FlatEdge
  {
    FlatNeighbor from, to;
  };

  bool isOnSheet(int particle) const;
  bool turnsAsExpected(int particle) const;
  FlatNeighbor flat(int particle) const
  {
    return { this->Plane.flat(this->Particles.points.positions[particle]), particle };
  }
  bool isAcrossSlit(const FlatNeighbor& neighbor) const;
  void lookAtEdges();
  bool collectEdgesOf(const FlatNeighbor& neighbor);
  void findCrossed();
  bool isHidden(const FlatNeighbor& neighbor) const;
  void makeSectors();
  void makeSector(const FlatNeighbor& start);
  Sector& nextSector();

  const ParticlePlaces& Particles;
  const ConstrainedEdges& Edges;
  int Middle = -1;
  glm::vec3 Normal{ 0.0f };
  TangentPlane Plane;
  std::vector<FlatNeighbor> Neighbors;
  /// Edges with the middle to their left that end at neighbours.
  std::vector<FlatEdge> FlatEdges;
  /// The neighbours whose edges are collected; edges that end at them, which may begin at others.
  std::vector<int> EdgesCollected;
  std::vector<FlatEdge> IncomingEdges;
  /// The neighbours' places, and, more than zero, that the way to them crosses one of the edges.
  std::vector<double> X, Y, Crossed;
  std::vector<kernel::FlatSegment> Segments;
  /// The other ends of the edges at the middle.
  std::vector<FlatNeighbor> Ends;
  /// Their memory only grows.
  std::vector<Sector> Sectors;
  std::size_t SectorCount = 0;
  bool IsNearEdge = false;
};

} // namespace hop
