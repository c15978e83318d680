#include "vtkSurfaceSplatGL.h" // before everything that may include an OpenGL header

#include "vtkSurfaceSplatLayer.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShaderProgram.h"
#include "vtkSurfaceSplatAccumulationFS.h"
#include "vtkSurfaceSplatBuffers.h"
#include "vtkSurfaceSplatDisk.h"
#include "vtkSurfaceSplatFragment.h"
#include "vtkSurfaceSplatPassState.h"
#include "vtkSurfaceSplatPassVS.h"
#include "vtkSurfaceSplatRay.h"
#include "vtkSurfaceSplatStrongestFS.h"
#include "vtkSurfaceSplatView.h"
#include "vtkSurfaceSplatVisibilityFS.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace
{
// Splats whose depths along the view ray differ by less than this many radii are of one surface.
constexpr double Thickness = 1.;

// Up to this many pixels from middle to rim, splats are drawn as points. The depth of a point is that
// of its middle, which is no great error then.
constexpr double LargestPoint = 2.;
constexpr double LeastPixels = 0.75;

// Mesa's rasterizers in software keep what they have set up of each primitive until they are flushed.
// As long as that fits into the processor's cache a picture of 10^6 splats takes half the time.
constexpr vtkIdType SoftwareBatch = 4096;

bool IsDrawnInSoftware()
{
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name && (std::strstr(name, "llvmpipe") || std::strstr(name, "softpipe"));
}

struct Format
{
  unsigned int Internal, External, Type;
  int Components, VtkType;
};
constexpr Format FloatSums = { GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, VTK_FLOAT };
constexpr Format TwoBytes = { GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 2, VTK_UNSIGNED_CHAR };
constexpr Format Count = { GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, VTK_UNSIGNED_INT };

void PrepareTexture(
  vtkTextureObject* texture, vtkOpenGLRenderWindow* window, const Format* format, int size[2])
{
  texture->SetContext(window);
  const unsigned int width = static_cast<unsigned int>(size[0]);
  const unsigned int height = static_cast<unsigned int>(size[1]);
  if (texture->GetHandle() != 0)
  {
    if (texture->GetWidth() != width || texture->GetHeight() != height)
    {
      texture->Resize(width, height);
    }
  }
  else if (format)
  {
    texture->SetInternalFormat(format->Internal);
    texture->SetFormat(format->External);
    texture->SetDataType(format->Type);
    texture->Allocate2D(width, height, format->Components, format->VtkType);
  }
  else
  {
    texture->AllocateDepth(width, height, vtkTextureObject::Float32);
  }
}

bool DrawsPoints(const vtkSurfaceSplatDrawing& drawing)
{
  const double radius = drawing.RadiusScale * drawing.Buffers->GetLargestRadius();
  return drawing.View->GetLargestPixels(radius) <= LargestPoint;
}

/** Where the weight of a splat has fallen to the least that makes a surface, in radii. */
double Rim(double sharpness)
{
  const double atRim = std::exp(-sharpness);
  const double least = vtkSurfaceSplatLayer::LeastWeight * (1. - atRim) + atRim;
  return std::sqrt(-std::log(least) / sharpness);
}

std::string WithColors(std::string source, const char* code)
{
  vtkShaderProgram::Substitute(source, "//Splat::Color::Impl", code);
  return source;
}

void SetSampler(vtkShaderProgram* program, const char* name, vtkTextureObject* texture)
{
  if (program->IsUniformUsed(name))
  {
    program->SetUniformi(name, texture->GetTextureUnit());
  }
}
}

//------------------------------------------------------------------------------
vtkSurfaceSplatLayer::vtkSurfaceSplatLayer(Side side)
  : WhichSide(side)
{
}

vtkSurfaceSplatLayer::~vtkSurfaceSplatLayer() = default;

//------------------------------------------------------------------------------
bool vtkSurfaceSplatLayer::Update(const vtkSurfaceSplatDrawing& drawing)
{
  if (!this->NeedsUpdate(drawing))
  {
    return true;
  }
  vtkSurfaceSplatPassState state(drawing.Window->GetState(), drawing.View->GetRectangle());
  if (!this->PrepareTextures(drawing))
  {
    this->Key.clear();
    return false;
  }
  this->VertexArray->Bind();
  this->FindVisible(drawing);
  this->Accumulate(drawing);
  if (drawing.Strongest)
  {
    this->FindStrongest(drawing);
  }
  this->VertexArray->Release();
  return true;
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatLayer::NeedsUpdate(const vtkSurfaceSplatDrawing& drawing)
{
  std::vector<double> key = drawing.Key;
  drawing.View->AppendTo(key);
  for (double value :
    { drawing.RadiusScale, drawing.Sharpness, double(drawing.Stride), double(drawing.Kind),
      double(drawing.FacesViewer), double(drawing.HiddenSide), double(drawing.Colors),
      double(drawing.Strongest), double(drawing.NumberOfClippingPlanes) })
  {
    key.push_back(value);
  }
  for (int plane = 0; plane < drawing.NumberOfClippingPlanes; ++plane)
  {
    key.insert(key.end(), drawing.ClippingPlanes[plane], drawing.ClippingPlanes[plane] + 4);
  }
  if (key == this->Key)
  {
    return false;
  }
  this->Key = std::move(key);
  return true;
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatLayer::PrepareTextures(const vtkSurfaceSplatDrawing& drawing)
{
  const auto padded = [](int size) { return (size + 3) / 4 * 4; }; // to be halved twice
  int size[2] = { padded(drawing.View->GetWidth()), padded(drawing.View->GetHeight()) };
  PrepareTexture(this->VisibleDepth, drawing.Window, nullptr, size);
  PrepareTexture(this->TestedDepth, drawing.Window, nullptr, size);
  this->Seen->SetMinificationFilter(vtkTextureObject::LinearMipmapNearest);
  this->Seen->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Seen->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Seen->SetMaxLevel(2);
  PrepareTexture(this->Seen, drawing.Window, &TwoBytes, size);
  PrepareTexture(this->NormalWeight, drawing.Window, &FloatSums, size);
  PrepareTexture(this->OffsetDepth, drawing.Window, &FloatSums, size);
  std::vector<vtkTextureObject*> sums = { this->NormalWeight, this->OffsetDepth };
  if (drawing.Colors)
  {
    PrepareTexture(this->ColorSum, drawing.Window, &FloatSums, size);
    sums.push_back(this->ColorSum);
  }
  this->PrepareFramebuffer(drawing, this->Visibility, { this->Seen }, this->VisibleDepth);
  this->PrepareFramebuffer(drawing, this->Accumulation, sums, this->TestedDepth);
  bool complete = this->Visibility.Complete && this->Accumulation.Complete;
  if (drawing.Strongest)
  {
    PrepareTexture(this->Number, drawing.Window, &Count, size);
    this->PrepareFramebuffer(drawing, this->Strongest, { this->Number }, this->TestedDepth);
    complete = complete && this->Strongest.Complete;
  }
  return complete;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::PrepareFramebuffer(const vtkSurfaceSplatDrawing& drawing,
  Framebuffer& framebuffer, const std::vector<vtkTextureObject*>& colors, vtkTextureObject* depth)
{
  if (framebuffer.Handle == 0)
  {
    glGenFramebuffers(1, &framebuffer.Handle);
  }
  drawing.Window->GetState()->vtkglBindFramebuffer(GL_FRAMEBUFFER, framebuffer.Handle);
  std::vector<GLenum> buffers;
  for (vtkTextureObject* color : colors)
  {
    buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, color->GetHandle(), 0);
  }
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth->GetHandle(), 0);
  // Not through vtkOpenGLState: it caches draw buffers for one framebuffer only.
  glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  framebuffer.Colors = static_cast<int>(buffers.size());
  framebuffer.Complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::ClearColors(const Framebuffer& framebuffer)
{
  const float nothing[4] = { 0.f, 0.f, 0.f, 0.f };
  for (int buffer = 0; buffer < framebuffer.Colors; ++buffer)
  {
    glClearBufferfv(GL_COLOR, buffer, nothing);
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::FindVisible(const vtkSurfaceSplatDrawing& drawing)
{
  this->StartWithDepth(drawing, this->Visibility);
  const double push = this->WhichSide == Front ? Thickness : -Thickness;
  if (this->ReadyProgram(
        drawing, { vtkSurfaceSplatVisibilityFS, push, Rim(drawing.Sharpness), false }))
  {
    this->DrawSplats(drawing);
  }
  this->AverageSeen();
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::StartWithDepth(
  const vtkSurfaceSplatDrawing& drawing, const Framebuffer& framebuffer)
{
  const bool front = this->WhichSide == Front;
  vtkOpenGLState* state = drawing.Window->GetState();
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, framebuffer.Handle);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(front ? GL_LESS : GL_GREATER);
  const float depth = front ? 1.f : 0.f;
  glClearBufferfv(GL_DEPTH, 0, &depth);
  ClearColors(framebuffer);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::AverageSeen()
{
  this->Seen->Activate();
  glGenerateMipmap(GL_TEXTURE_2D);
  this->Seen->Deactivate();
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::CopyVisibleDepth(const vtkSurfaceSplatDrawing& drawing)
{
  vtkOpenGLState* state = drawing.Window->GetState();
  const int right = drawing.View->GetWidth();
  const int top = drawing.View->GetHeight();
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, this->Visibility.Handle);
  state->vtkglBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Accumulation.Handle);
  glBlitFramebuffer(0, 0, right, top, 0, 0, right, top, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::Accumulate(const vtkSurfaceSplatDrawing& drawing)
{
  vtkOpenGLState* state = drawing.Window->GetState();
  this->CopyVisibleDepth(drawing);
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Accumulation.Handle);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendEquation(GL_FUNC_ADD);
  state->vtkglBlendFunc(GL_ONE, GL_ONE);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglDepthFunc(this->WhichSide == Front ? GL_LEQUAL : GL_GEQUAL);
  ClearColors(this->Accumulation);
  const std::string source = WithColors(vtkSurfaceSplatAccumulationFS,
    drawing.Colors ? "gl_FragData[2] = weight * texelFetch(splatColor, splatParticle);" : "");
  this->Seen->Activate();
  this->VisibleDepth->Activate();
  if (vtkShaderProgram* program =
        this->ReadyProgram(drawing, { source, 0., 1., DrawsPoints(drawing) }))
  {
    SetSampler(program, "splatSeen", this->Seen);
    SetSampler(program, "splatVisibleDepth", this->VisibleDepth);
    program->SetUniformf("splatNearer", this->WhichSide == Front ? 1.f : -1.f);
    this->DrawSplats(drawing);
  }
  this->VisibleDepth->Deactivate();
  this->Seen->Deactivate();
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::FindStrongest(const vtkSurfaceSplatDrawing& drawing)
{
  vtkOpenGLState* state = drawing.Window->GetState();
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Strongest.Handle);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LESS);
  const float far = 1.f;
  const GLuint nothing[4] = { 0, 0, 0, 0 };
  glClearBufferfv(GL_DEPTH, 0, &far);
  glClearBufferuiv(GL_COLOR, 0, nothing);
  this->Seen->Activate();
  this->VisibleDepth->Activate();
  if (vtkShaderProgram* program =
        this->ReadyProgram(drawing, { vtkSurfaceSplatStrongestFS, 0., 1., false }))
  {
    SetSampler(program, "splatSeen", this->Seen);
    SetSampler(program, "splatVisibleDepth", this->VisibleDepth);
    program->SetUniformf("splatNearer", this->WhichSide == Front ? 1.f : -1.f);
    this->DrawSplats(drawing);
  }
  this->VisibleDepth->Deactivate();
  this->Seen->Deactivate();
}

//------------------------------------------------------------------------------
vtkShaderProgram* vtkSurfaceSplatLayer::ReadyProgram(
  const vtkSurfaceSplatDrawing& drawing, const Pass& pass)
{
  const std::string definitions = "#define SPLAT_POINTS " + std::to_string(DrawsPoints(drawing)) +
    "\n#define SPLAT_LEAST_PIXELS " + std::to_string(LeastPixels) + "\n#define SPLAT_HAS_CLIP " +
    std::to_string(drawing.Buffers->GetHasClip()) + "\n#define SPLAT_CURVED " +
    std::to_string(
      drawing.Buffers->GetHasShape() && !drawing.FacesViewer && !DrawsPoints(drawing)) +
    "\n#define SPLAT_SKIPS_HIDDEN " + std::to_string(pass.SkipsHidden) +
    "\n#define SPLAT_CLIPPING_PLANES " + std::to_string(drawing.NumberOfClippingPlanes) + "\n";
  std::string vertex = vtkSurfaceSplatPassVS;
  std::string fragment = pass.Fragment;
  vtkShaderProgram::Substitute(vertex, "//Splat::Disk::Dec", definitions + vtkSurfaceSplatDisk);
  vtkShaderProgram::Substitute(
    fragment, "//Splat::Fragment::Dec", definitions + vtkSurfaceSplatFragment);
  vtkShaderProgram::Substitute(fragment, "//Splat::Ray::Dec", vtkSurfaceSplatRay);
  vtkShaderProgram* program =
    drawing.Window->GetShaderCache()->ReadyShaderProgram(vertex.c_str(), fragment.c_str(), "");
  if (!program)
  {
    return nullptr; // the shader cache has said why
  }
  drawing.Buffers->SetSamplers(program);
  drawing.View->SetUniforms(program);
  program->SetUniformf("splatRadiusScale", static_cast<float>(drawing.RadiusScale));
  const double rim = Rim(drawing.Sharpness);
  const float falloff[3] = { static_cast<float>(drawing.Sharpness),
    static_cast<float>(std::exp(-drawing.Sharpness)), static_cast<float>(rim * rim) };
  program->SetUniform3f("splatFalloff", falloff);
  program->SetUniformf("splatPush", static_cast<float>(pass.Push));
  program->SetUniformf("splatReach", static_cast<float>(pass.Reach));
  program->SetUniformf("splatHiddenSide", static_cast<float>(drawing.HiddenSide));
  program->SetUniformi("splatFacesViewer", drawing.FacesViewer ? 1 : 0);
  program->SetUniformi("splatStride", drawing.Stride);
  program->SetUniformi("splatKind", drawing.Kind);
  program->SetUniform4fv("splatClippingPlane", 6, drawing.ClippingPlanes);
  return program;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::DrawSplats(const vtkSurfaceSplatDrawing& drawing)
{
  const vtkIdType count =
    (drawing.Buffers->GetNumberOfParticles() + drawing.Stride - 1) / drawing.Stride;
  const bool points = DrawsPoints(drawing);
  const int corners = points ? 1 : 3;
  const vtkIdType batch = IsDrawnInSoftware() ? SoftwareBatch : count;
  for (vtkIdType first = 0; first < count; first += batch)
  {
    const vtkIdType size = std::min(batch, count - first);
    glDrawArrays(points ? GL_POINTS : GL_TRIANGLES, static_cast<GLint>(corners * first),
      static_cast<GLsizei>(corners * size));
    if (first + size < count)
    {
      glFlush();
    }
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::Activate()
{
  for (vtkTextureObject* texture : { this->Seen.Get(), this->NormalWeight.Get(),
         this->OffsetDepth.Get(), this->ColorSum.Get(), this->Number.Get() })
  {
    if (texture->GetHandle() != 0)
    {
      texture->Activate();
    }
  }
}

void vtkSurfaceSplatLayer::Deactivate()
{
  for (vtkTextureObject* texture : { this->Seen.Get(), this->NormalWeight.Get(),
         this->OffsetDepth.Get(), this->ColorSum.Get(), this->Number.Get() })
  {
    if (texture->GetHandle() != 0)
    {
      texture->Deactivate();
    }
  }
}

void vtkSurfaceSplatLayer::SetSamplers(
  vtkShaderProgram* program, const vtkSurfaceSplatLayer& front) const
{
  SetSampler(program, "splatSeen", this->Seen);
  SetSampler(program, "splatNormalWeight", this->NormalWeight);
  SetSampler(program, "splatOffsetDepth", this->OffsetDepth);
  SetSampler(program, "splatColorSum", this->ColorSum);
  SetSampler(program, "splatStrongest", this->Number);
  SetSampler(program, "splatFrontNormalWeight", front.NormalWeight);
  SetSampler(program, "splatFrontOffsetDepth", front.OffsetDepth);
  SetSampler(program, "splatFrontSeen", front.Seen);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::ReleaseGraphicsResources(vtkWindow* window)
{
  for (Framebuffer* framebuffer : { &this->Visibility, &this->Accumulation, &this->Strongest })
  {
    if (framebuffer->Handle != 0)
    {
      glDeleteFramebuffers(1, &framebuffer->Handle);
    }
    *framebuffer = Framebuffer();
  }
  for (vtkTextureObject* texture :
    { this->VisibleDepth.Get(), this->Seen.Get(), this->NormalWeight.Get(), this->OffsetDepth.Get(),
      this->ColorSum.Get(), this->Number.Get(), this->TestedDepth.Get() })
  {
    texture->ReleaseGraphicsResources(window);
  }
  this->VertexArray->ReleaseGraphicsResources();
  this->Key.clear();
}
