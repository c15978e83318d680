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
namespace
{
// Writes the sums of colours. Lookup coordinates that end at borders have derivatives, see CellColors.
std::string ColorCode(const SplatDrawing& drawing)
{
  return std::string("vec4 color = texelFetch(splatColor, splatParticle);\n") +
    (drawing.ColorGradients ? "  color = vec4(color.x + splatDiskToRadius * dot(color.zw, "
                              "splatDiskCoord), color.y, 0.0, 0.0);\n"
                            : "") +
    "  gl_FragData[2] = colorWeight * color;";
}

// Writes the sums of borders to an output. Colours without borders keep the weight of the splat.
std::string BorderCode(const SplatDrawing& drawing, int output)
{
  return "float cellWeight = weight * splatCellShare(beyondCell);\n  gl_FragData[" +
    std::to_string(output) +
    "] = cellWeight * vec4(1.0, splatEdgeCoverage(beyondCell), 0.0, 0.0);\n" +
    (drawing.ClipsColors ? "  colorWeight = cellWeight;" : "");
}
}

AccumulationPass::AccumulationPass(LayerSide side, VisibilityPass& visibility)
  : SplatPass(side)
  , Visibility(visibility)
{
  this->Outputs = { { "NormalWeight", this->NormalWeight }, { "OffsetDepth", this->OffsetDepth },
    { "ColorSum", this->ColorSum }, { "BorderSum", this->BorderSum } };
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
  if (drawing.UsesBorders())
  {
    PrepareTexture(drawing, this->BorderSum, { GL_RG32F, GL_RG, GL_FLOAT, 2, VTK_FLOAT });
    sums.push_back(this->BorderSum);
  }
  this->NumberOfSums = static_cast<int>(sums.size());
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
  for (int sum = 0; sum < this->NumberOfSums; ++sum)
  {
    glClearBufferfv(GL_COLOR, sum, nothing);
  }
  SplatPrimitives::Style style;
  style.Fragment = SplatAccumulationFSGlsl;
  style.SkipsHidden = true;
  style.UsesBorders = drawing.UsesBorders();
  vtkShaderProgram::Substitute(style.Fragment, "//Splat::Border::Impl",
    style.UsesBorders ? BorderCode(drawing, this->NumberOfSums - 1) : "");
  vtkShaderProgram::Substitute(
    style.Fragment, "//Splat::Color::Impl", drawing.Colors ? ColorCode(drawing) : "");
  this->Visibility.DrawBy(drawing, primitives, style);
}
}
