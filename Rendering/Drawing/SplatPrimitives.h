/**
 * @class SplatPrimitives
 * @brief all splats as triangles or points: what is the same in every pass
 */

#pragma once

#include "vtkNew.h"
#include "vtkType.h"

#include <optional>
#include <string>

class vtkOpenGLBufferObject;
class vtkOpenGLVertexArrayObject;
class vtkShaderProgram;

namespace hop
{
struct SplatDrawing;

class SplatPrimitives
{
public:
  SplatPrimitives();
  ~SplatPrimitives();

  /** The smallest summed weight of a pixel with surface: of one splat at its reach, where it fills a gap. */
  static double GetLeastWeight(double sharpness);

  /**
   * Factor on the weight of a splat beyond its clip planes, where it fills gaps that others leave; no unit. Chosen by
   * experiment: a larger factor softens creases where both sides overlap; it must be far above the rounding of the
   * sums.
   */
  static constexpr double GapShare = 1e-3;

  /** How one pass draws the splats. */
  struct Style
  {
    std::string Fragment;     // source of the fragment stage
    double Push = 0.;         // by how many radii splats are moved away from the eye
    bool EndsAtReach = false; // splats end at splatReach(); otherwise at their rims
    bool SkipsHidden = false; // points whose middle is hidden are left out
    bool UsesBorders = false; // the fragment stage asks where cells end
  };

  /**
   * Puts the program of a style in use and sets all uniforms but the pass's own. nullptr if the driver does not take
   * the program; the shader cache has said why then.
   */
  vtkShaderProgram* Use(const SplatDrawing& drawing, const Style& style);

  /**
   * Leaves out the splats that are behind others for certain, until it is called again. It does so only where drawing
   * them in software costs more than finding them.
   * @param push Style::Push of the pass that finds what is hidden
   */
  void Cull(const SplatDrawing& drawing, double push);

  /** Draws with the program in use. */
  void Draw(const SplatDrawing& drawing);

  void ReleaseGraphicsResources();

private:
  SplatPrimitives(const SplatPrimitives&) = delete;
  void operator=(const SplatPrimitives&) = delete;

  void DrawPiece(const SplatDrawing& drawing, vtkIdType first, vtkIdType size) const;

  vtkNew<vtkOpenGLVertexArrayObject> VertexArray;
  vtkNew<vtkOpenGLBufferObject>
    Visible; // vertices of the splats that may be seen, if some are left out
  std::optional<vtkIdType> NumberOfVisible;
};
}
