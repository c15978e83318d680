/**
 * @file  MarkLayers.h
 * @brief particles beside which the surface makes a step, so that one layer lies near another
 */

#pragma once

namespace hop
{
struct SplatParticles;

/**
 * Marks particles near an end of their layer behind which the surface goes on a step higher or lower, as at jumps of
 * discontinuous fields, in SplatParticles::Normal; and sets SplatParticles::HasLayers. Layers nearer to each other than
 * a splat's thickness would else be averaged where one hides the other.
 */
void MarkLayers(SplatParticles& particles);
}
