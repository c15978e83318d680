#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "Passes/PassState.h"

namespace hop
{
//------------------------------------------------------------------------------
PassState::PassState(vtkOpenGLState* state, const std::array<int, 4>& rectangle)
  : State(state)
  , Viewport(state)
  , Scissor(state)
  , ColorMask(state)
  , DepthMask(state)
  , DepthFunc(state)
  , BlendFunc(state)
  , Blend(state, GL_BLEND)
  , DepthTest(state, GL_DEPTH_TEST)
  , ScissorTest(state, GL_SCISSOR_TEST)
  , StencilTest(state, GL_STENCIL_TEST)
  , CullFace(state, GL_CULL_FACE)
  , ProgramPointSize(glIsEnabled(GL_PROGRAM_POINT_SIZE))
{
  state->PushFramebufferBindings();
  glGetIntegerv(GL_BLEND_EQUATION_RGB, &this->BlendEquation[0]);
  glGetIntegerv(GL_BLEND_EQUATION_ALPHA, &this->BlendEquation[1]);

  int viewport[4];
  glGetIntegerv(GL_VIEWPORT, viewport);
  state->vtkglViewport(0, 0, viewport[2], viewport[3]);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(rectangle[0], rectangle[1], rectangle[2], rectangle[3]);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_STENCIL_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  glEnable(GL_PROGRAM_POINT_SIZE); // vtkOpenGLState does not know this one
}

PassState::~PassState()
{
  if (!this->ProgramPointSize)
  {
    glDisable(GL_PROGRAM_POINT_SIZE);
  }
  this->State->vtkglBlendEquationSeparate(this->BlendEquation[0], this->BlendEquation[1]);
  this->State->PopFramebufferBindings();
}
}
