#include "vtkSurfaceSplatGL.h" // before everything that may include an OpenGL header

#include "vtkSurfaceSplatBuffers.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkSurfaceSplatParticles.h"
#include "vtkTextureObject.h"

#include <algorithm>

vtkSurfaceSplatTexels::vtkSurfaceSplatTexels()
{
  this->Buffer->SetType(vtkOpenGLBufferObject::TextureBuffer);
}

vtkSurfaceSplatTexels::~vtkSurfaceSplatTexels() = default;

//------------------------------------------------------------------------------
template <typename T>
void vtkSurfaceSplatTexels::UploadTexels(
  vtkOpenGLRenderWindow* window, const std::vector<T>& rgba, int vtkType)
{
  this->Texture->SetContext(window);
  this->Buffer->Upload(rgba, vtkOpenGLBufferObject::TextureBuffer);
  this->Texture->CreateTextureBuffer(
    static_cast<unsigned int>(rgba.size() / 4), 4, vtkType, this->Buffer);
}

void vtkSurfaceSplatTexels::Upload(vtkOpenGLRenderWindow* window, const std::vector<float>& rgba)
{
  this->UploadTexels(window, rgba, VTK_FLOAT);
}

void vtkSurfaceSplatTexels::Upload(
  vtkOpenGLRenderWindow* window, const std::vector<unsigned char>& rgba)
{
  this->UploadTexels(window, rgba, VTK_UNSIGNED_CHAR);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatTexels::Activate()
{
  this->Texture->Activate();
}

void vtkSurfaceSplatTexels::Deactivate()
{
  this->Texture->Deactivate();
}

void vtkSurfaceSplatTexels::SetSampler(vtkShaderProgram* program, const char* name)
{
  if (program->IsUniformUsed(name))
  {
    program->SetUniformi(name, this->Texture->GetTextureUnit());
  }
}

void vtkSurfaceSplatTexels::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Texture->ReleaseGraphicsResources(window);
  this->Buffer->ReleaseGraphicsResources();
}

namespace
{
std::vector<unsigned char> IdsAsBytes(const std::vector<vtkIdType>& ids, vtkIdType count)
{
  std::vector<unsigned char> bytes;
  bytes.reserve(4 * count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    for (int shift = 0; shift < 32; shift += 8)
    {
      bytes.push_back(static_cast<unsigned char>((ids[i] >> shift) & 0xff));
    }
  }
  return bytes;
}

std::vector<float> FirstTexels(const std::vector<float>& texels, vtkIdType count)
{
  return std::vector<float>(texels.begin(), texels.begin() + 4 * count);
}
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatBuffers::Upload(
  vtkOpenGLRenderWindow* window, const vtkSurfaceSplatParticles& particles)
{
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  const vtkIdType count = particles.GetNumberOfParticles();
  this->NumberOfParticles = std::min<vtkIdType>(count, limit);
  this->Origin = particles.Origin;
  if (this->NumberOfParticles == 0)
  {
    return;
  }
  const bool all = this->NumberOfParticles == count;
  this->CentreRadius.Upload(window,
    all ? particles.CentreRadius : FirstTexels(particles.CentreRadius, this->NumberOfParticles));
  this->Normal.Upload(
    window, all ? particles.Normal : FirstTexels(particles.Normal, this->NumberOfParticles));
  this->PointIds.Upload(window, IdsAsBytes(particles.PointIds, this->NumberOfParticles));
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatBuffers::Activate()
{
  this->CentreRadius.Activate();
  this->Normal.Activate();
  this->PointIds.Activate();
}

void vtkSurfaceSplatBuffers::Deactivate()
{
  this->CentreRadius.Deactivate();
  this->Normal.Deactivate();
  this->PointIds.Deactivate();
}

void vtkSurfaceSplatBuffers::SetSamplers(vtkShaderProgram* program)
{
  this->CentreRadius.SetSampler(program, "splatCentreRadius");
  this->Normal.SetSampler(program, "splatNormal");
  this->PointIds.SetSampler(program, "splatPointIds");
}

void vtkSurfaceSplatBuffers::ReleaseGraphicsResources(vtkWindow* window)
{
  this->CentreRadius.ReleaseGraphicsResources(window);
  this->Normal.ReleaseGraphicsResources(window);
  this->PointIds.ReleaseGraphicsResources(window);
  this->NumberOfParticles = 0;
}
