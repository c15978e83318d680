#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "Passes/SplatPass.h"

#include "Drawing/SplatDrawing.h"
#include "Drawing/SplatView.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <array>

namespace hop
{
namespace
{
// Textures have a multiple of four texels both ways, so that the visibility pass can halve its texture twice.
std::array<unsigned int, 2> TextureSize(const SplatView& view)
{
  const auto padded = [](int size) { return static_cast<unsigned int>((size + 3) / 4 * 4); };
  return { padded(view.GetWidth()), padded(view.GetHeight()) };
}

// True if there was a texture already; it has the right size now.
bool Resize(
  vtkTextureObject* texture, vtkOpenGLRenderWindow* window, const std::array<unsigned int, 2>& size)
{
  texture->SetContext(window);
  if (texture->GetHandle() == 0)
  {
    return false;
  }
  if (texture->GetWidth() != size[0] || texture->GetHeight() != size[1])
  {
    texture->Resize(size[0], size[1]);
  }
  return true;
}
}

SplatPass::SplatPass(LayerSide side)
  : Side(side)
{
}

SplatPass::~SplatPass() = default;

//------------------------------------------------------------------------------
void SplatPass::PrepareTexture(
  const SplatDrawing& drawing, vtkTextureObject* texture, const Format& format)
{
  const std::array<unsigned int, 2> size = TextureSize(*drawing.View);
  if (!Resize(texture, drawing.Window, size))
  {
    texture->SetInternalFormat(format.Internal);
    texture->SetFormat(format.External);
    texture->SetDataType(format.Type);
    texture->Allocate2D(size[0], size[1], format.Components, format.VtkType);
  }
}

//------------------------------------------------------------------------------
bool SplatPass::PrepareFramebuffer(
  const SplatDrawing& drawing, const std::vector<vtkTextureObject*>& colors)
{
  const std::array<unsigned int, 2> size = TextureSize(*drawing.View);
  if (!Resize(this->Depth, drawing.Window, size))
  {
    this->Depth->AllocateDepth(size[0], size[1], vtkTextureObject::Float32);
  }
  if (this->Framebuffer == 0)
  {
    glGenFramebuffers(1, &this->Framebuffer);
  }
  drawing.Window->GetState()->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
  std::vector<GLenum> buffers;
  for (vtkTextureObject* color : colors)
  {
    buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, color->GetHandle(), 0);
  }
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, this->Depth->GetHandle(), 0);
  // Not through vtkOpenGLState: it caches draw buffers for one framebuffer only.
  glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

//------------------------------------------------------------------------------
void SplatPass::Activate()
{
  for (const Output& output : this->Outputs)
  {
    if (output.Texture->GetHandle() != 0)
    {
      output.Texture->Activate();
    }
  }
}

void SplatPass::Deactivate()
{
  for (const Output& output : this->Outputs)
  {
    if (output.Texture->GetHandle() != 0)
    {
      output.Texture->Deactivate();
    }
  }
}

void SplatPass::SetSamplers(vtkShaderProgram* program, const std::string& prefix) const
{
  for (const Output& output : this->Outputs)
  {
    const std::string name = prefix + output.Name;
    if (program->IsUniformUsed(name.c_str()))
    {
      program->SetUniformi(name.c_str(), output.Texture->GetTextureUnit());
    }
  }
}

//------------------------------------------------------------------------------
void SplatPass::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->Framebuffer != 0)
  {
    glDeleteFramebuffers(1, &this->Framebuffer);
    this->Framebuffer = 0;
  }
  for (const Output& output : this->Outputs)
  {
    output.Texture->ReleaseGraphicsResources(window);
  }
  this->Depth->ReleaseGraphicsResources(window);
}
}
