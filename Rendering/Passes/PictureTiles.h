/**
 * @class PictureTiles
 * @brief the part of the picture that splats can reach, in square tiles of which each is one point
 *
 * Fragment stages that look up many texels are dear in software, where branches save nothing. So the vertex stage
 * (glsl/ResolveVS.glsl) decides tile by tile whether there is something to draw.
 */

#pragma once

#include <array>

class vtkShaderProgram;

namespace hop
{
class SplatView;

class PictureTiles
{
public:
  /**
   * Side of a tile in pixels. Tiles begin at a multiple of half a side. The shader tells tiles apart by averages over
   * 4 x 4 pixels that it interpolates to 8 x 8, so that this size is tied to the two levels of the visibility texture.
   */
  static constexpr int Size = 8;

  /** What a tile must hold to be drawn, in the numbers of splatTilesWith (glsl/ResolveVS.glsl); may be combined. */
  enum Kind
  {
    Inside = 1, // surface, but no edge of it in the picture
    Edges = 2,  // an edge of the surface in the picture
    // The surface in front of itself. Programs that are made for folds look for nothing else.
    Folds = 4
  };

  explicit PictureTiles(const SplatView& view);

  /** Left, bottom, width and height, in pixels, of all that drawing tiles looks at; it may exceed the viewport. */
  static std::array<int, 4> GetNeighborhood(const SplatView& view);

  void SetUniforms(vtkShaderProgram* program, int kinds) const;

  /** Draws the tiles with the program that is in use. */
  void Draw() const;

private:
  std::array<int, 2> First; // left and bottom, pixels
  std::array<int, 2> Count; // columns and rows
};
}
