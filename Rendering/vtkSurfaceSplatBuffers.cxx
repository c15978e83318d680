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
  vtkOpenGLRenderWindow* window, const T* rgba, vtkIdType texels, int vtkType)
{
  this->Texture->SetContext(window);
  this->Texture->ResetFormatAndType(); // colours may be bytes now and floats then
  this->Buffer->Upload(
    rgba, static_cast<std::size_t>(4 * texels), vtkOpenGLBufferObject::TextureBuffer);
  this->Texture->CreateTextureBuffer(static_cast<unsigned int>(texels), 4, vtkType, this->Buffer);
}

void vtkSurfaceSplatTexels::Upload(
  vtkOpenGLRenderWindow* window, const float* rgba, vtkIdType texels)
{
  this->UploadTexels(window, rgba, texels, VTK_FLOAT);
}

void vtkSurfaceSplatTexels::Upload(
  vtkOpenGLRenderWindow* window, const unsigned char* rgba, vtkIdType texels)
{
  this->UploadTexels(window, rgba, texels, VTK_UNSIGNED_CHAR);
}

//------------------------------------------------------------------------------
const float* vtkSurfaceSplatTexels::Map()
{
  return this->Buffer->Bind()
    ? static_cast<const float*>(glMapBuffer(GL_TEXTURE_BUFFER, GL_READ_ONLY))
    : nullptr;
}

void vtkSurfaceSplatTexels::Unmap()
{
  this->Buffer->Bind();
  GLint mapped = GL_FALSE;
  glGetBufferParameteriv(GL_TEXTURE_BUFFER, GL_BUFFER_MAPPED, &mapped);
  if (mapped)
  {
    glUnmapBuffer(GL_TEXTURE_BUFFER);
  }
  this->Buffer->Release();
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
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatBuffers::Upload(
  vtkOpenGLRenderWindow* window, const vtkSurfaceSplatParticles& particles)
{
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  this->HasClip = !particles.Clip.empty();
  this->HasShape = !particles.Shape.empty();
  this->HasColor = false;
  const GLint texels = this->HasClip ? 3 : this->HasShape ? 2 : 1; // a particle, at most
  const vtkIdType count = std::min<vtkIdType>(particles.GetNumberOfParticles(), limit / texels);
  this->NumberOfParticles = count;
  this->SheetRanges = particles.SheetRanges;
  for (std::array<vtkIdType, 2>& range : this->SheetRanges)
  {
    range = { std::min(range[0], count), std::min(range[1], count) };
  }
  this->Origin = particles.Origin;
  this->MeasureRadii(particles.CentreRadius);
  if (count == 0)
  {
    return;
  }
  this->CentreRadius.Upload(window, particles.CentreRadius.data(), count);
  this->Normal.Upload(window, particles.Normal.data(), count);
  if (this->HasClip)
  {
    this->Clip.Upload(window, particles.Clip.data(), 3 * count);
  }
  if (this->HasShape)
  {
    this->Shape.Upload(window, particles.Shape.data(), 2 * count);
  }
  this->PointIds.Upload(window, IdsAsBytes(particles.PointIds, count).data(), count);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatBuffers::MeasureRadii(const std::vector<float>& centreRadius)
{
  double sum = 0.;
  double largest = 0.;
  vtkIdType drawn = 0;
  for (std::size_t i = 3; i < centreRadius.size(); i += 4)
  {
    const double radius = centreRadius[i];
    sum += radius;
    drawn += radius > 0.;
    largest = std::max(largest, radius);
  }
  this->MeanRadius = drawn > 0 ? sum / drawn : 0.;
  this->LargestRadius = largest;
}

//------------------------------------------------------------------------------
std::vector<vtkSurfaceSplatTexels*> vtkSurfaceSplatBuffers::GetFilled()
{
  std::vector<vtkSurfaceSplatTexels*> filled = { &this->CentreRadius, &this->Normal,
    &this->PointIds };
  if (this->HasClip)
  {
    filled.push_back(&this->Clip);
  }
  if (this->HasShape)
  {
    filled.push_back(&this->Shape);
  }
  if (this->HasColor)
  {
    filled.push_back(&this->Color);
  }
  return filled;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatBuffers::Activate()
{
  for (vtkSurfaceSplatTexels* texels : this->GetFilled())
  {
    texels->Activate();
  }
}

void vtkSurfaceSplatBuffers::Deactivate()
{
  for (vtkSurfaceSplatTexels* texels : this->GetFilled())
  {
    texels->Deactivate();
  }
}

void vtkSurfaceSplatBuffers::SetSamplers(vtkShaderProgram* program)
{
  this->CentreRadius.SetSampler(program, "splatCentreRadius");
  this->Normal.SetSampler(program, "splatNormal");
  this->PointIds.SetSampler(program, "splatPointIds");
  // Samplers that are not read must still name a buffer: drivers check their kind.
  (this->HasClip ? this->Clip : this->CentreRadius).SetSampler(program, "splatClip");
  (this->HasShape ? this->Shape : this->CentreRadius).SetSampler(program, "splatShape");
  (this->HasColor ? this->Color : this->CentreRadius).SetSampler(program, "splatColor");
  program->SetUniformi("splatHasClip", this->HasClip ? 1 : 0);
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatBuffers::Read(const std::function<void(const Mapped&)>& use)
{
  const Mapped mapped = { this->CentreRadius.Map(), this->Normal.Map(),
    this->HasClip ? this->Clip.Map() : nullptr };
  const bool readable = mapped.CentreRadius && mapped.Normal && (mapped.Clip || !this->HasClip);
  if (readable)
  {
    use(mapped);
  }
  this->CentreRadius.Unmap();
  this->Normal.Unmap();
  if (this->HasClip)
  {
    this->Clip.Unmap();
  }
  return readable;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatBuffers::ReleaseGraphicsResources(vtkWindow* window)
{
  this->CentreRadius.ReleaseGraphicsResources(window);
  this->Normal.ReleaseGraphicsResources(window);
  this->Clip.ReleaseGraphicsResources(window);
  this->Shape.ReleaseGraphicsResources(window);
  this->Color.ReleaseGraphicsResources(window);
  this->PointIds.ReleaseGraphicsResources(window);
  this->NumberOfParticles = 0;
}
