/**
 * @class PassState
 * @brief OpenGL state of the private splat passes, for as long as the object lives
 *
 * When the object is destroyed, all that the passes change is as it was before.
 */

#pragma once

#include "vtkOpenGLState.h"

#include <array>

namespace hop
{
class PassState
{
public:
  /** @param rectangle left, bottom, width and height in pixels; nothing is drawn outside of it. */
  PassState(vtkOpenGLState* state, const std::array<int, 4>& rectangle);
  ~PassState();

private:
  PassState(const PassState&) = delete;
  void operator=(const PassState&) = delete;

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
}
