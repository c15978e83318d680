#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "Passes/PictureTiles.h"

#include "Drawing/SplatView.h"
#include "vtkShaderProgram.h"

namespace hop
{
//------------------------------------------------------------------------------
PictureTiles::PictureTiles(const SplatView& view)
{
  const std::array<int, 2> size = { view.GetWidth(), view.GetHeight() };
  const std::array<int, 4>& rectangle = view.GetRectangle();
  for (int axis = 0; axis < 2; ++axis)
  {
    // OpenGL drops points whose middle is outside of the viewport, whatever they would cover. Where the last tile would
    // be dropped, all tiles are moved by half a tile.
    const int left = size[axis] % Size;
    const int shift = left > 0 && left < Size / 2 ? Size / 2 : 0;
    this->First[axis] = (rectangle[axis] + shift) / Size * Size - shift;
    this->Count[axis] =
      (rectangle[axis] + rectangle[2 + axis] - this->First[axis] + Size - 1) / Size;
  }
}

//------------------------------------------------------------------------------
std::array<int, 4> PictureTiles::GetNeighborhood(const SplatView& view)
{
  // Tiles begin and end less than one and a half tiles beyond the splats, and the shader looks at half a tile around
  // each.
  constexpr int margin = 2 * Size;
  const std::array<int, 4>& rectangle = view.GetRectangle();
  return { rectangle[0] - margin, rectangle[1] - margin, rectangle[2] + 2 * margin,
    rectangle[3] + 2 * margin };
}

//------------------------------------------------------------------------------
void PictureTiles::SetUniforms(vtkShaderProgram* program, int kinds) const
{
  program->SetUniform2i("splatFirstTile", this->First.data());
  program->SetUniformi("splatTilesInRow", this->Count[0]);
  program->SetUniformi("splatTilesWith", kinds);
}

//------------------------------------------------------------------------------
void PictureTiles::Draw() const
{
  const bool enabled =
    glIsEnabled(GL_PROGRAM_POINT_SIZE) != 0; // vtkOpenGLState does not know this one
  glEnable(GL_PROGRAM_POINT_SIZE);
  glDrawArrays(GL_POINTS, 0, this->Count[0] * this->Count[1]);
  if (!enabled)
  {
    glDisable(GL_PROGRAM_POINT_SIZE);
  }
}
}
