/**
 * @namespace Culling
 * @brief which flat splats are hidden for certain
 *
 * Mesa's software renderers take vertices one after the other, most of what many small splats cost, and have no
 * processors to spare for pixels that are seen nowhere. Splats that lie behind others everywhere are found here
 * on all cores, and left out. No pixel changes by that: the coordinates are those of
 * glsl/PassVS.glsl, and where rounding or the way in which a splat is drawn may decide, it is drawn.
 */

#pragma once

#include "vtkType.h"

#include <glm/mat4x4.hpp>

#include <vector>

namespace hop
{
namespace Culling
{
struct Camera
{
  glm::mat4 MCVC; ///< turns, moves and scales, all axes alike: see IsSimilarity()
  glm::mat4 VCDC;
  bool Parallel;
  int Width; ///< of the picture in pixels, as is the next
  int Height;
};

/** Every Stride-th of some particles, in arrays like those of SplatParticles. */
struct Splats
{
  const float* CentreRadius;
  const float* Normal;
  const float* Clip; ///< nullptr without planes
  int Stride;
  float RadiusScale;
  float LeastPixels; ///< from middle to rim, all cover at least so many
  float Push; ///< radii by which splats are moved away from the eye at most before they hide others
  float Solid;  ///< radii from the middle to where they hide others
  int CellSize; ///< pixels; of the squares that have to be covered by one splat to hide others
};

/** Whether a matrix scales all axes alike and keeps right angles. */
bool IsSimilarity(const glm::mat4& matrix);

/** Of the numbers from the first to before the second, those of splats that may be seen. */
std::vector<unsigned int> FindVisible(
  const Camera& camera, const Splats& splats, vtkIdType first, vtkIdType end);
}
}
