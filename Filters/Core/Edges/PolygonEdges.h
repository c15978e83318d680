#pragma once

#include "Edges/BoundaryCurves.h"
#include "Surface/Anchor.h"
#include "Surface/PlanePolygon.h"

namespace hop
{

/// Cuts the boundary curves of a surface that is a plane to a polygon, and puts particles on the polygon's edges: in its
/// corners, evenly between them, and where an edge leaves the mesh. They end the surface as boundary curves do.
/// \param spacing of particles on the plane
/// \param near particles that move, close to the surface: a place of the mesh is looked for from those around it
/// \param nearPatches theirs come first
/// \return the places of the polygon's edges among curves.particles: they come last
std::size_t addPolygonEdges(const Isosurface& surface, const PlanePolygon& polygon, double spacing,
  const Buffer<Anchor>& near, const Buffer<Patch>& nearPatches, BoundaryCurves& curves);

} // namespace hop
