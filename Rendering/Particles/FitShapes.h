/**
 * @file  FitShapes.h
 * @brief how splats bend, fitted to the particles around
 *
 * A particle carries the surface's shape operator at its own place, and no word of how the operator changes over the
 * splat. At the faces of elements, where only the field itself is continuous, the operator jumps: the surface then
 * leaves the paraboloid of one side by a tenth of a radius at the rim of the splat. So each splat gets the paraboloid
 * that passes through its particle, is tangent to the surface there, and suits best the places and normals of the
 * particles around.
 */

#pragma once

namespace hop
{
struct SplatParticles;

/**
 * Replaces the shape operators of particles that have some. A neighbour does not count if one of the two lies behind a
 * clip plane of the other, or if it is turned away from the particle or stands a step higher or lower. It counts less if
 * the plane between them is one at which the surface is almost smooth.
 */
void FitShapes(SplatParticles& particles);
}
