#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "Passes/AccumulationPass.h"

#include "Drawing/SplatDrawing.h"
#include "Drawing/SplatPrimitives.h"
#include "Passes/VisibilityPass.h"
#include "SplatAccumulationFSGlsl.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace hop
{
AccumulationPass::AccumulationPass(LayerSide side, VisibilityPass& visibility)
  : SplatPass(side)
  , Visibility(visibility)
{
  this->Outputs = { { "NormalWeight", this->NormalWeight }, { "OffsetDepth", this->OffsetDepth },
    { "ColorSum", this->ColorSum } };
}

AccumulationPass::~AccumulationPass() = default;

//------------------------------------------------------------------------------
bool AccumulationPass::Prepare(const SplatDrawing& drawing)
{
  std::vector<vtkTextureObject*> sums = { this->NormalWeight, this->OffsetDepth };
  if (drawing.Colors)
  {
    sums.push_back(this->ColorSum);
  }
  for (vtkTextureObject* sum : sums)
  {
    PrepareTexture(drawing, sum, { GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, VTK_FLOAT });
  }
  return this->PrepareFramebuffer(drawing, sums);
}

//------------------------------------------------------------------------------
void AccumulationPass::Draw(const SplatDrawing& drawing, SplatPrimitives& primitives)
{
  vtkOpenGLState* state = drawing.Window->GetState();
  state->vtkglBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Framebuffer);
  // The depth is copied, because shaders look up the first one while fragments are tested against it.
  this->Visibility.CopyDepth(drawing);
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendEquation(GL_FUNC_ADD);
  state->vtkglBlendFunc(GL_ONE, GL_ONE);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglDepthFunc(this->IsFront() ? GL_LEQUAL : GL_GEQUAL);
  const float nothing[4] = { 0.f, 0.f, 0.f, 0.f };
  for (int sum = 0; sum < (drawing.Colors ? 3 : 2); ++sum)
  {
    glClearBufferfv(GL_COLOR, sum, nothing);
  }
  SplatPrimitives::Style style;
  style.Fragment = SplatAccumulationFSGlsl;
  style.SkipsHidden = true;
  vtkShaderProgram::Substitute(style.Fragment, "//Splat::Color::Impl",
    drawing.Colors ? "gl_FragData[2] = weight * texelFetch(splatColor, splatParticle);" : "");
  this->Visibility.DrawBy(drawing, primitives, style);
}
}
