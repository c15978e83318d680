#pragma once

#include "Edges/FaceJumps.h"
#include "Surface/Particles.h"

namespace hop
{

/// How far from a particle, in units of its spacing, an edge is of interest: splats overlap that far.
constexpr double ClipReach = 1.5;

/// Two planes whose normals are nearer than that, by cosine, are the same edge.
constexpr double SameEdge = 0.8;

/// Keeps a plane that is within reach, if it comes before one that the particle has: boundary curves that cut its splat come
/// before creases (CreaseAngle), these before faces at which the surface is almost smooth, near ones before others.
/// The second plane belongs to another edge than the first.
void offerPlane(Particle& particle, const ClipPlane& plane);

/// Offers a particle the faces of its element at which the normal turns. Near a crease that is the plane which touches
/// the edge where it is nearest, as the particle sees field and face to second order; elsewhere the face to first
/// order.
/// \param jet, point at the particle's place
void offerFaces(const Isosurface& surface, const FaceJumps& jumps, const Jet& jet,
  const FieldPoint& point, Particle& particle);

} // namespace hop
