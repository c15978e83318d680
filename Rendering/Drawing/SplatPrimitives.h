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

  /** Of the weights that a splat has, 1 in its middle, the smallest that makes a surface. */
  static double GetLeastWeight(double sharpness);

  /** Of the weights, what is left beyond clip planes where a splat fills gaps that others leave. */
  static constexpr double GapShare = 1e-3;

  /** What differs between the passes. */
  struct Style
  {
    std::string Fragment;     // source of the fragment stage
    double Push = 0.;         // by how many radii splats are moved away from the eye
    bool EndsAtReach = false; // splats end where they count too little to be seen alone
    bool SkipsHidden = false; // splats whose middle is hidden are left out, where they are points
  };

  /**
   * Puts the program of a style in use, with all uniforms but those of the pass's own. nullptr if the
   * driver does not take it; the shader cache has said why then.
   */
  vtkShaderProgram* Use(const SplatDrawing& drawing, const Style& style);

  /**
   * Leaves out, until it is called again, those splats that are behind others for certain, if that is worth it.
   * @param push as of the pass that finds what is hidden
   */
  void Cull(const SplatDrawing& drawing, double push);

  /** Draws, with the program in use. */
  void Draw(const SplatDrawing& drawing);

  void ReleaseGraphicsResources();

private:
  SplatPrimitives(const SplatPrimitives&) = delete;
  void operator=(const SplatPrimitives&) = delete;

  void DrawPiece(const SplatDrawing& drawing, vtkIdType first, vtkIdType size) const;

  vtkNew<vtkOpenGLVertexArrayObject> VertexArray;
  vtkNew<vtkOpenGLBufferObject>
    Visible; // numbers of the splats that are drawn, if some are left out
  std::optional<vtkIdType> NumberOfVisible;
};
}
