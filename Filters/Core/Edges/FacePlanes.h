#pragma once

#include "Edges/FaceJumps.h"
#include "Surface/Particles.h"

#include <algorithm>
#include <array>

namespace hop
{

/// Largest distance from a particle, in units of its spacing, at which an edge of the surface is of interest: a splat
/// reaches one spacing, and planes of edges a little farther off tell the renderer on which side of them it is. Chosen
/// by experiment; a larger one takes planes of a particle for edges that do not cut its splat.
constexpr double ClipReach = 1.5;

/// Smallest cosine between the normals of two planes that belong to the same edge: 37 degrees. Chosen by experiment.
/// Nearer to 1 two planes of a particle may be one bent edge twice; farther from 1 blunt corners have one plane only.
constexpr double SameEdge = 0.8;

/// Gives a particle a plane that is within reach, if the plane comes before one that the particle has. Boundary curves
/// nearer than a spacing come first, then creases (CreaseAngle) and boundary curves farther off, then faces with a
/// smaller dihedral angle; of two alike the nearer one. The planes of a particle belong to different edges; a crease
/// clearly before a boundary curve along it is one.
void offerPlane(Particle& particle, const ClipPlane& plane);

/// Puts an edge into its place among the edges that come first, and drops edges that are the same as one before.
/// \param comesBefore whether the first of two edges comes before the second
/// \param isSame whether two edges are one
template <class Edge, std::size_t Count, class ComesBefore, class IsSame>
void insertEdge(
  std::array<Edge, Count>& edges, Edge edge, const ComesBefore& comesBefore, const IsSame& isSame)
{
  std::array<Edge, Count> result;
  std::size_t filled = 0;
  const auto add = [&](const Edge& next)
  {
    const auto end = result.begin() + filled;
    if (filled < Count &&
      std::none_of(result.begin(), end, [&](const Edge& before) { return isSame(before, next); }))
    {
      result[filled++] = next;
    }
  };
  bool isAdded = false;
  for (const Edge& other : edges)
  {
    if (!isAdded && (!other.exists() || comesBefore(edge, other)))
    {
      add(edge);
      isAdded = true;
    }
    if (other.exists())
    {
      add(other);
    }
  }
  edges = result;
}

/// Offers a particle the faces of its element that have a dihedral angle. At a crease the plane touches the edge where
/// the edge is nearest, as the particle sees field and face to second order; elsewhere it is the face to first order.
/// \param jet, point at the particle's place
void offerFaces(const Isosurface& surface, const FaceJumps& jumps, const Jet& jet,
  const FieldPoint& point, Particle& particle);

} // namespace hop
