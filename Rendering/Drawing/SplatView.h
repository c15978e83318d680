/**
 * @class SplatView
 * @brief camera, actor and viewport of one drawing, as the splat shaders take them
 *
 * Model coordinates (MC) are relative to the middle of the particles; the shift is done in double precision.
 */

#pragma once

#include "Drawing/Culling.h"

#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <array>
#include <vector>

class vtkActor;
class vtkRenderer;
class vtkShaderProgram;

namespace hop
{
class SplatView
{
public:
  /**
   * Reads the active camera, the actor's matrix and GL_VIEWPORT.
   * @param origin what was subtracted from the particles' positions
   * @param bounds of the splats, model coordinates, not shifted
   */
  void Update(vtkRenderer* renderer, vtkActor* actor, const std::array<double, 3>& origin,
    const double bounds[6]);

  ///@{
  /** Size of the viewport in pixels. */
  int GetWidth() const { return this->Viewport[2]; }
  int GetHeight() const { return this->Viewport[3]; }
  ///@}

  /** By how much lengths grow from model to view coordinates, on average over the axes. */
  double GetScale() const;

  /**
   * How many pixels a length in model coordinates, anywhere in the bounds, may have at most.
   * Infinite if the bounds reach behind the eye.
   */
  double GetLargestPixels(double length) const;

  /** What SetUniforms() tells programs of the camera. */
  Culling::Camera GetCamera() const;

  /** Left, bottom, width and height, within the viewport, of the pixels that splats can reach. */
  const std::array<int, 4>& GetRectangle() const { return this->Rectangle; }

  /** Sets the uniforms of glsl/ that describe the view, as far as a program uses them. */
  void SetUniforms(vtkShaderProgram* program) const;

  /** Appends all that a picture of the splats depends on. */
  void AppendTo(std::vector<double>& key) const;

  ///@{
  /**
   * From shifted model coordinates to view and device coordinates. VTK keeps matrices for shaders
   * transposed, so that products read from left to right.
   */
  vtkNew<vtkMatrix4x4> MCVC;
  vtkNew<vtkMatrix4x4> MCDC;
  ///@}

private:
  void FindEye();
  double GetPixelSize() const; // VC, at distance 1, or everywhere if parallel
  void FindRectangle(const std::array<double, 3>& origin, const double bounds[6]);

  mutable vtkNew<vtkMatrix4x4> VCDC;
  mutable vtkNew<vtkMatrix3x3> NormalMatrix;
  std::array<float, 4> Eye = { 0.f, 0.f, 0.f, 1.f }; // MC; with w = 0 the direction to it
  bool Parallel = false;
  double NearestDepth =
    0.; // VC distance of the bounds before the eye; <= 0 if they reach behind it
  std::array<int, 4> Viewport = { 0, 0, 0, 0 };
  std::array<int, 4> Rectangle = { 0, 0, 0, 0 };
};
}
