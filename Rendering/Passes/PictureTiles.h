/**
 * @class PictureTiles
 * @brief the part of the picture that splats can reach, in square tiles of which each is one point
 *
 * Fragment stages that look up many texels are dear where there is no graphics card, and branches save
 * nothing there. So the vertex stage (glsl/ResolveVS.glsl) decides, a tile at a time,
 * what is worth drawing.
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
  /** Pixels along the side of a tile. Tiles begin at a multiple of 4. */
  static constexpr int Size = 8;

  /** What a tile must hold to be drawn; may be combined. */
  enum Kind
  {
    Inside = 1, // surface, but no edge of it
    Edges = 2,
    Folds = 4 // for programs that look for these only: the surface in front of itself
  };

  explicit PictureTiles(const SplatView& view);

  /** Left, bottom, width and height, within the viewport or around it, of all that drawing tiles looks at. */
  static std::array<int, 4> GetNeighborhood(const SplatView& view);

  void SetUniforms(vtkShaderProgram* program, int kinds) const;

  /** With the program that is in use. */
  void Draw() const;

private:
  std::array<int, 2> First; // left and bottom, pixels
  std::array<int, 2> Count; // columns and rows
};
}
