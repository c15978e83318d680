#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "Particles/SplatBuffers.h"

#include "Particles/SplatParticles.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <algorithm>

namespace hop
{
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
void SplatBuffers::Upload(vtkOpenGLRenderWindow* window, const SplatParticles& particles)
{
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  this->HasClip = !particles.Clip.empty();
  this->ClipStride = particles.ClipStride;
  this->HasBorders = !particles.Borders.empty();
  this->HasShape = !particles.Shape.empty();
  this->HasLayers = particles.HasLayers;
  this->HasGhosts = particles.HasGhosts;
  this->HasColor = false;
  constexpr int borders = SplatParticles::MaximumNumberOfBorders;
  // Texels of one particle in the longest buffer.
  const GLint texels = std::max({ this->HasClip ? this->ClipStride / 4 : 1,
    this->HasBorders ? borders : 1, this->HasShape ? 2 : 1 });
  const vtkIdType count = std::min<vtkIdType>(particles.GetNumberOfParticles(), limit / texels);
  this->NumberOfParticles = count;
  this->IsovalueRanges = particles.IsovalueRanges;
  for (std::array<vtkIdType, 2>& range : this->IsovalueRanges)
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
    this->Clip.Upload(window, particles.Clip.data(), this->ClipStride / 4 * count);
  }
  if (this->HasBorders)
  {
    this->Borders.Upload(window, particles.Borders.data(), borders * count);
  }
  if (this->HasShape)
  {
    this->Shape.Upload(window, particles.Shape.data(), 2 * count);
  }
  this->PointIds.Upload(window, IdsAsBytes(particles.PointIds, count).data(), count);
}

//------------------------------------------------------------------------------
void SplatBuffers::MeasureRadii(const std::vector<float>& centreRadius)
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
std::vector<TexelBuffer*> SplatBuffers::GetFilled()
{
  std::vector<TexelBuffer*> filled = { &this->CentreRadius, &this->Normal, &this->PointIds };
  if (this->HasClip)
  {
    filled.push_back(&this->Clip);
  }
  if (this->HasBorders)
  {
    filled.push_back(&this->Borders);
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
void SplatBuffers::Activate()
{
  for (TexelBuffer* texels : this->GetFilled())
  {
    texels->Activate();
  }
}

void SplatBuffers::Deactivate()
{
  for (TexelBuffer* texels : this->GetFilled())
  {
    texels->Deactivate();
  }
}

void SplatBuffers::SetSamplers(vtkShaderProgram* program)
{
  this->CentreRadius.SetSampler(program, "splatCentreRadius");
  this->Normal.SetSampler(program, "splatNormal");
  this->PointIds.SetSampler(program, "splatPointIds");
  // A sampler that no shader reads must still name a texture of its kind: drivers check that.
  (this->HasClip ? this->Clip : this->CentreRadius).SetSampler(program, "splatClip");
  (this->HasBorders ? this->Borders : this->CentreRadius).SetSampler(program, "splatBorders");
  (this->HasShape ? this->Shape : this->CentreRadius).SetSampler(program, "splatShape");
  (this->HasColor ? this->Color : this->CentreRadius).SetSampler(program, "splatColor");
  program->SetUniformi("splatClipTexels", this->HasClip ? this->ClipStride / 4 : 0);
}

//------------------------------------------------------------------------------
bool SplatBuffers::Read(const std::function<void(const Mapped&)>& use, bool withBorders)
{
  const bool borders = withBorders && this->HasBorders;
  const Mapped mapped = { this->CentreRadius.Map(), this->Normal.Map(),
    this->HasClip ? this->Clip.Map() : nullptr, borders ? this->Borders.Map() : nullptr };
  const bool readable = mapped.CentreRadius && mapped.Normal && (mapped.Clip || !this->HasClip) &&
    (mapped.Borders || !borders);
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
  if (borders)
  {
    this->Borders.Unmap();
  }
  return readable;
}

//------------------------------------------------------------------------------
void SplatBuffers::ReleaseGraphicsResources(vtkWindow* window)
{
  this->CentreRadius.ReleaseGraphicsResources(window);
  this->Normal.ReleaseGraphicsResources(window);
  this->Clip.ReleaseGraphicsResources(window);
  this->Borders.ReleaseGraphicsResources(window);
  this->Shape.ReleaseGraphicsResources(window);
  this->Color.ReleaseGraphicsResources(window);
  this->PointIds.ReleaseGraphicsResources(window);
  this->NumberOfParticles = 0;
}
}
