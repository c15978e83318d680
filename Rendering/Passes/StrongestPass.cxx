#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "Passes/StrongestPass.h"

#include "Drawing/SplatDrawing.h"
#include "Drawing/SplatPrimitives.h"
#include "Passes/VisibilityPass.h"
#include "SplatStrongestFSGlsl.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace hop
{
StrongestPass::StrongestPass(LayerSide side, VisibilityPass& visibility)
  : SplatPass(side)
  , Visibility(visibility)
{
  this->Outputs = { { "Strongest", this->Number } };
}

StrongestPass::~StrongestPass() = default;

//------------------------------------------------------------------------------
bool StrongestPass::Prepare(const SplatDrawing& drawing)
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
void StrongestPass::Draw(const SplatDrawing& drawing, SplatPrimitives& primitives)
{
  if (!drawing.Strongest)
  {
    return;
  }
  vtkOpenGLState* state = drawing.Window->GetState();
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LESS); // the fragment stage writes weights as depths
  const float weightless = 1.f;
  const GLuint nothing[4] = { 0, 0, 0, 0 };
  glClearBufferfv(GL_DEPTH, 0, &weightless);
  glClearBufferuiv(GL_COLOR, 0, nothing);
  SplatPrimitives::Style style;
  style.Fragment = SplatStrongestFSGlsl;
  style.UsesBorders = true;
  this->Visibility.DrawBy(drawing, primitives, style);
}
}
