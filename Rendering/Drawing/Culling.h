/**
 * @namespace Culling
 * @brief which flat splats are hidden for certain
 *
 * Mesa's software renderers take vertices one after the other, which is most of what many small splats cost, and have
 * no processors to spare for pixels that nobody sees. Splats that lie behind others everywhere are found here on all
 * cores, and left out. The picture stays the same to the bit: the coordinates are those of glsl/PassVS.glsl, and a
 * splat is drawn wherever rounding, or the way in which it is drawn, may decide.
 */

#pragma once

#include "vtkType.h"

#include <glm/mat4x4.hpp>

#include <vector>

namespace hop
{
namespace Culling
{
/** How the splats are seen. */
struct Camera
{
  glm::mat4 MCVC; ///< turns, moves, and scales all axes alike: see IsSimilarity()
  glm::mat4 VCDC;
  bool Parallel;
  int Width;  ///< of the picture, pixels
  int Height; ///< of the picture, pixels
};

/** Every Stride-th of some particles, in arrays like the ones of SplatParticles, and how they are drawn. */
struct Splats
{
  const float* CentreRadius;
  const float* Normal;
  const float* Clip; ///< nullptr without planes
  int ClipStride;    ///< numbers a particle
  int Stride;
  float RadiusScale; ///< factor on all radii
  float LeastPixels; ///< smallest radius of a splat in the picture, pixels
  float
    Push; ///< largest distance, in radii, by which a splat is moved away from the eye before it hides others
  float Solid; ///< distance from the middle, in radii, up to which a splat hides others
  int
    CellSize; ///< side, in pixels, of the square cells that one splat has to cover to hide others there
};

/** Whether a matrix scales all axes alike and keeps right angles. */
bool IsSimilarity(const glm::mat4& matrix);

/** The numbers, from the first to before the second, of the splats that may be seen; in order. */
std::vector<unsigned int> FindVisible(
  const Camera& camera, const Splats& splats, vtkIdType first, vtkIdType end);
}
}
