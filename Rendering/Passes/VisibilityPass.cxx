#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "Passes/VisibilityPass.h"

#include "Drawing/SplatDrawing.h"
#include "Drawing/SplatPrimitives.h"
#include "Drawing/SplatView.h"
#include "SplatVisibilityFSGlsl.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <array>
#include <optional>

namespace hop
{
namespace
{
// Splats whose depths along the view ray differ by less than this many radii are of one surface. Chosen by experiment:
// a smaller thickness tears surfaces that are seen at a slant, a larger one averages surfaces that lie behind each
// other.
constexpr double Thickness = 1.;

// While the object lives, depths may be moved beyond the near and far planes, and clip distances cut in place of these
// planes. vtkOpenGLState does not know these states.
class PlanesAsClipDistances
{
public:
  PlanesAsClipDistances()
  {
    for (std::size_t i = 0; i < States.size(); ++i)
    {
      this->Before[i] = glIsEnabled(States[i]);
      glEnable(States[i]);
    }
  }

  ~PlanesAsClipDistances()
  {
    for (std::size_t i = 0; i < States.size(); ++i)
    {
      if (!this->Before[i])
      {
        glDisable(States[i]);
      }
    }
  }

private:
  PlanesAsClipDistances(const PlanesAsClipDistances&) = delete;
  void operator=(const PlanesAsClipDistances&) = delete;

  static constexpr std::array<GLenum, 3> States = { GL_DEPTH_CLAMP, GL_CLIP_DISTANCE0,
    GL_CLIP_DISTANCE1 };
  std::array<GLboolean, 3> Before;
};
}

VisibilityPass::VisibilityPass(LayerSide side)
  : SplatPass(side)
{
  this->Outputs = { { "Seen", this->Seen }, { "VisibleDepth", this->Depth } };
}

VisibilityPass::~VisibilityPass() = default;

//------------------------------------------------------------------------------
bool VisibilityPass::Prepare(const SplatDrawing& drawing)
{
  // Two more levels, of averages over 2 x 2 and 4 x 4 pixels: tiles are told apart by the last one.
  this->Seen->SetMinificationFilter(vtkTextureObject::LinearMipmapNearest);
  this->Seen->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Seen->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Seen->SetMaxLevel(2);
  PrepareTexture(drawing, this->Seen, { GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 2, VTK_UNSIGNED_CHAR });
  return this->PrepareFramebuffer(drawing, { this->Seen });
}

//------------------------------------------------------------------------------
double VisibilityPass::GetThickness() const
{
  return this->IsFront() ? Thickness : -Thickness;
}

//------------------------------------------------------------------------------
void VisibilityPass::Draw(const SplatDrawing& drawing, SplatPrimitives& primitives)
{
  vtkOpenGLState* state = drawing.Window->GetState();
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(this->IsFront() ? GL_LESS : GL_GREATER);
  const float farthest = this->IsFront() ? 1.f : 0.f;
  const float nothing[4] = { 0.f, 0.f, 0.f, 0.f };
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  glClearBufferfv(GL_COLOR, 0, nothing);
  SplatPrimitives::Style style;
  style.Fragment = SplatVisibilityFSGlsl;
  style.Push = drawing.TellsDepthsApart() ? 0. : this->GetThickness();
  style.EndsAtReach = true;
  if (this->IsFront())
  {
    primitives.Cull(drawing, style.Push);
  }
  if (primitives.Use(drawing, style))
  {
    primitives.Draw(drawing);
  }
  this->Seen->Activate();
  glGenerateMipmap(GL_TEXTURE_2D);
  this->Seen->Deactivate();
}

//------------------------------------------------------------------------------
void VisibilityPass::CopyDepth(const SplatDrawing& drawing) const
{
  const int right = drawing.View->GetWidth();
  const int top = drawing.View->GetHeight();
  drawing.Window->GetState()->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, this->Framebuffer);
  glBlitFramebuffer(0, 0, right, top, 0, 0, right, top, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

//------------------------------------------------------------------------------
void VisibilityPass::DrawBy(
  const SplatDrawing& drawing, SplatPrimitives& primitives, SplatPrimitives::Style style)
{
  std::optional<PlanesAsClipDistances> planes;
  if (drawing.TellsDepthsApart())
  {
    style.Push = -this->GetThickness();
    planes.emplace();
  }
  this->Activate();
  if (vtkShaderProgram* program = primitives.Use(drawing, style))
  {
    this->SetSamplers(program);
    program->SetUniformf("splatNearer", this->IsFront() ? 1.f : -1.f);
    primitives.Draw(drawing);
  }
  this->Deactivate();
}
}
