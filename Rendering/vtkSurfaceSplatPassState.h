/**
 * @class vtkSurfaceSplatPassState
 * @brief OpenGL state of the private splat passes, for as long as it lives
 *
 * Whatever the passes change is as before when this object is destroyed.
 */

#ifndef vtkSurfaceSplatPassState_h
#define vtkSurfaceSplatPassState_h

#include "vtkOpenGLState.h"

#include <array>

class vtkSurfaceSplatPassState
{
public:
  /** @param rectangle left, bottom, width and height in pixels: nothing is drawn outside. */
  vtkSurfaceSplatPassState(vtkOpenGLState* state, const std::array<int, 4>& rectangle);
  ~vtkSurfaceSplatPassState();

private:
  vtkSurfaceSplatPassState(const vtkSurfaceSplatPassState&) = delete;
  void operator=(const vtkSurfaceSplatPassState&) = delete;

  vtkOpenGLState* State;
  int BlendEquation[2];
  vtkOpenGLState::ScopedglViewport Viewport;
  vtkOpenGLState::ScopedglScissor Scissor;
  vtkOpenGLState::ScopedglColorMask ColorMask;
  vtkOpenGLState::ScopedglDepthMask DepthMask;
  vtkOpenGLState::ScopedglDepthFunc DepthFunc;
  vtkOpenGLState::ScopedglBlendFuncSeparate BlendFunc;
  vtkOpenGLState::ScopedglEnableDisable Blend, DepthTest, ScissorTest, StencilTest, CullFace;
  unsigned char ProgramPointSize;
};

#endif
