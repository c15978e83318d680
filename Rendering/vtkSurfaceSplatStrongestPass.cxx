#include "vtkSurfaceSplatGL.h" // before everything that may include an OpenGL header

#include "vtkSurfaceSplatStrongestPass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkSurfaceSplatDrawing.h"
#include "vtkSurfaceSplatPrimitives.h"
#include "vtkSurfaceSplatStrongestFS.h"
#include "vtkSurfaceSplatVisibilityPass.h"
#include "vtkTextureObject.h"

vtkSurfaceSplatStrongestPass::vtkSurfaceSplatStrongestPass(
  vtkSurfaceSplatSide side, vtkSurfaceSplatVisibilityPass& visibility)
  : vtkSurfaceSplatPass(side)
  , Visibility(visibility)
{
  this->Outputs = { { "Strongest", this->Number } };
}

vtkSurfaceSplatStrongestPass::~vtkSurfaceSplatStrongestPass() = default;

//------------------------------------------------------------------------------
bool vtkSurfaceSplatStrongestPass::Prepare(const vtkSurfaceSplatDrawing& drawing)
{
  if (!drawing.Strongest)
  {
    return true;
  }
  PrepareTexture(
    drawing, this->Number, { GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, VTK_UNSIGNED_INT });
  return this->PrepareFramebuffer(drawing, { this->Number });
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatStrongestPass::Draw(
  const vtkSurfaceSplatDrawing& drawing, vtkSurfaceSplatPrimitives& primitives)
{
  if (!drawing.Strongest)
  {
    return;
  }
  vtkOpenGLState* state = drawing.Window->GetState();
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LESS); // of weights, see the fragment stage
  const float weightless = 1.f;
  const GLuint nothing[4] = { 0, 0, 0, 0 };
  glClearBufferfv(GL_DEPTH, 0, &weightless);
  glClearBufferuiv(GL_COLOR, 0, nothing);
  vtkSurfaceSplatPrimitives::Style style;
  style.Fragment = vtkSurfaceSplatStrongestFS;
  this->Visibility.DrawBy(drawing, primitives, style);
}
