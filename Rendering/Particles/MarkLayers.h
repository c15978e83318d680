/**
 * @file  MarkLayers.h
 * @brief particles near which one layer of the surface lies over another
 */

#pragma once

namespace hop
{
struct SplatParticles;

/**
 * Marks particles near an end of their layer behind which the surface goes on a step higher or lower, as at jumps of
 * discontinuous fields, and particles right above or below another layer, in SplatParticles::Normal; and sets
 * SplatParticles::HasLayers. Layers nearer to each other than a splat's thickness would else be averaged where one hides
 * the other. Nothing is marked where no particle has a clip plane: layers mostly lie over each other where one ends.
 */
void MarkLayers(SplatParticles& particles);
}
