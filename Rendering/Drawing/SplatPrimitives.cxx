#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "Drawing/SplatPrimitives.h"

#include "Common/SplatProfile.h"

#include "Drawing/Culling.h"
#include "Drawing/SplatDrawing.h"
#include "Drawing/SplatView.h"
#include "OpenGL/ShaderDefine.h"
#include "Particles/SplatBuffers.h"
#include "Particles/SplatParticles.h"
#include "SplatDiskGlsl.h"
#include "SplatEdgeGlsl.h"
#include "SplatPassFragmentGlsl.h"
#include "SplatPassVSGlsl.h"
#include "SplatRayGlsl.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace hop
{
namespace
{
/** Splats of few pixels. Both numbers were chosen by experiment. */
struct SmallSplats
{
  /**
   * Smallest radius of a splat in the picture, pixels. Smaller splats fall between the middles of pixels and leave
   * holes; larger ones blur the picture and its outline.
   */
  static constexpr double LeastPixels = 0.75;
  /**
   * Points are pushed away from the eye by their thickness over the cosine between normal and view ray; the smallest
   * cosine so used, no unit. A larger one loses neighbours where the surface is seen at a slant, a smaller one takes
   * surfaces far behind for the same.
   */
  static constexpr double LeastCosine = 0.2;
};

/** How Mesa's renderers in software are fed. Both numbers were measured on draw calls of 10^5 to 10^6 splats. */
struct SoftwareBatches
{
  /**
   * Splats a draw call. Where a call leaves some points out, Mesa goes through all its vertices again for every 4 KB of
   * vertices that it passes on: larger calls repeat more work, smaller ones cost more calls.
   */
  static constexpr vtkIdType Size = 512;
  /**
   * Draw calls between two flushes. Mesa keeps what it has set up of each primitive until it is flushed: with this
   * number it fits into the processor's cache, which halves the time of 10^6 splats. More fall out of the cache, fewer
   * leave its threads waiting.
   */
  static constexpr int CallsPerFlush = 8;
};

/** The cells in which is found what hides what, see Culling::Splats::CellSize. */
struct CullingCells
{
  /**
   * Side of a cell, as a share of the mean radius of splats in the picture. Chosen by experiment: smaller cells find
   * little more and cost more, larger ones are covered by hardly any splat.
   */
  static constexpr double Share = 0.33;
  /** Largest side, pixels. Splats that are so large are few. */
  static constexpr double LargestPixels = 64.;
};

// Factor on the weight with which a splat gives its colour to places beyond its cell: it is seen only where no particle
// of the cell that is seen reaches. Chosen by experiment: a larger one lets colours shine over borders, a smaller one
// is lost where sums are rounded.
constexpr double OtherShare = 1e-4;

// Factor on the weight of ghosts where the strongest particle is looked for: of two ranks one draws each pixel, and both
// do where rounding hides which is the stronger. A smaller share lets both draw more pixels, which only translucent
// surfaces show; a larger one leaves holes where positions are rounded to more than 1e-4 radii.
constexpr double GhostShare = 0.999;

int CornersOf(const SplatDrawing& drawing)
{
  return drawing.DrawsPoints() ? 1 : 3;
}

std::vector<unsigned int> VerticesOf(const std::vector<unsigned int>& splats, unsigned int corners)
{
  std::vector<unsigned int> vertices;
  vertices.reserve(corners * splats.size());
  for (const unsigned int splat : splats)
  {
    for (unsigned int corner = 0; corner < corners; ++corner)
    {
      vertices.push_back(corners * splat + corner);
    }
  }
  return vertices;
}

bool IsDrawnInSoftware()
{
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name && (std::strstr(name, "llvmpipe") || std::strstr(name, "softpipe"));
}

// Lets Mesa's threads draw what was flushed while more is set up. At most two flushes are under way, as they share the
// processor's cache; and llvmpipe, once it has had 64 unfinished ones, draws and sets up in turns for good.
class SoftwareFlushes
{
public:
  SoftwareFlushes() = default;
  ~SoftwareFlushes() { glDeleteSync(this->Last); }

  void Flush()
  {
    const GLsync before = this->Last;
    this->Last = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
    if (before)
    {
      glClientWaitSync(before, 0, GL_TIMEOUT_IGNORED);
      glDeleteSync(before);
    }
  }

private:
  SoftwareFlushes(const SoftwareFlushes&) = delete;
  void operator=(const SoftwareFlushes&) = delete;

  GLsync Last = nullptr;
};

std::string Definitions(const SplatDrawing& drawing, const SplatPrimitives::Style& style)
{
  return ShaderDefine("SPLAT_POINTS", drawing.DrawsPoints()) +
    ShaderDefine("SPLAT_LEAST_PIXELS", SmallSplats::LeastPixels) +
    ShaderDefine("SPLAT_LEAST_COSINE", SmallSplats::LeastCosine) +
    ShaderDefine("SPLAT_HAS_CLIP", drawing.Buffers->GetHasClip()) +
    ShaderDefine("SPLAT_CLIP_PLANES",
      std::max(1, SplatParticles::ClipPlanesIn(drawing.Buffers->GetClipStride()))) +
    ShaderDefine("SPLAT_GAP_SHARE", SplatPrimitives::GapShare) +
    ShaderDefine("SPLAT_HAS_BORDERS", style.UsesBorders && drawing.Buffers->GetHasBorders()) +
    ShaderDefine("SPLAT_BORDERS", SplatParticles::MaximumNumberOfBorders) +
    ShaderDefine("SPLAT_OTHER_SHARE", OtherShare) +
    ShaderDefine("SPLAT_CURVED", drawing.DrawsCurved()) +
    ShaderDefine("SPLAT_SKIPS_HIDDEN", style.SkipsHidden && drawing.DrawsPoints()) +
    ShaderDefine("SPLAT_APART", drawing.TellsDepthsApart()) +
    ShaderDefine("SPLAT_LAYERS", drawing.TellsLayersApart()) +
    ShaderDefine("SPLAT_GHOSTS", drawing.Ghosts) + ShaderDefine("SPLAT_GHOST_SHARE", GhostShare) +
    ShaderDefine("SPLAT_CLIPPING_PLANES", drawing.NumberOfClippingPlanes);
}
}

SplatPrimitives::SplatPrimitives() = default;

SplatPrimitives::~SplatPrimitives() = default;

//------------------------------------------------------------------------------
double SplatPrimitives::GetLeastWeight(double sharpness)
{
  return GapShare * SplatProfile{ sharpness }.weight(splatReach());
}

//------------------------------------------------------------------------------
vtkShaderProgram* SplatPrimitives::Use(const SplatDrawing& drawing, const Style& style)
{
  const std::string definitions = Definitions(drawing, style);
  std::string vertex = SplatPassVSGlsl;
  std::string fragment = style.Fragment;
  vtkShaderProgram::Substitute(vertex, "//Splat::Disk::Dec", definitions + SplatDiskGlsl);
  vtkShaderProgram::Substitute(
    fragment, "//Splat::Fragment::Dec", definitions + SplatPassFragmentGlsl);
  vtkShaderProgram::Substitute(fragment, "//Splat::Ray::Dec", SplatRayGlsl);
  vtkShaderProgram::Substitute(fragment, "//Splat::Edge::Dec", SplatEdgeGlsl);
  vtkShaderProgram* program =
    drawing.Window->GetShaderCache()->ReadyShaderProgram(vertex.c_str(), fragment.c_str(), "");
  if (!program)
  {
    return nullptr;
  }
  drawing.SetUniforms(program);
  const double reach = splatReach();
  const float falloff[3] = { static_cast<float>(drawing.Sharpness),
    static_cast<float>(std::exp(-drawing.Sharpness)), static_cast<float>(reach * reach) };
  program->SetUniform3f("splatFalloff", falloff);
  program->SetUniformf("splatEdgeWidth", static_cast<float>(drawing.EdgeWidth));
  program->SetUniformf("splatPush", static_cast<float>(style.Push));
  program->SetUniformf("splatExtent", static_cast<float>(style.EndsAtReach ? reach : 1.));
  program->SetUniform4fv("splatClippingPlane", 6, drawing.ClippingPlanes);
  return program;
}

//------------------------------------------------------------------------------
void SplatPrimitives::Cull(const SplatDrawing& drawing, double push)
{
  this->NumberOfVisible.reset();
  const Culling::Camera camera = drawing.View->GetCamera();
  const double pixels =
    drawing.View->GetLargestPixels(drawing.RadiusScale * drawing.Buffers->GetMeanRadius());
  if (!IsDrawnInSoftware() || !drawing.DrawsAll() || drawing.DrawsCurved() || drawing.FacesViewer ||
    drawing.TellsLayersApart() || !std::isfinite(pixels) || !Culling::IsSimilarity(camera.MCVC))
  {
    return;
  }
  const int corners = CornersOf(drawing);
  const double mostPush = corners == 1 ? push / SmallSplats::LeastCosine : push;
  const int cellSize = corners == 1
    ? 1
    : static_cast<int>(std::clamp(CullingCells::Share * pixels, 1., CullingCells::LargestPixels));
  std::vector<unsigned int> visible;
  const bool found = drawing.Buffers->Read(
    [&](const SplatBuffers::Mapped& particles)
    {
      const auto [first, end] = drawing.GetDrawnRange();
      visible = Culling::FindVisible(camera,
        { particles.CentreRadius, particles.Normal, particles.Clip,
          drawing.Buffers->GetClipStride(), drawing.Stride, static_cast<float>(drawing.RadiusScale),
          static_cast<float>(SmallSplats::LeastPixels), static_cast<float>(mostPush),
          static_cast<float>(splatReach()), cellSize },
        first, end);
    });
  if (!found)
  {
    return;
  }
  this->NumberOfVisible = static_cast<vtkIdType>(visible.size());
  if (!visible.empty())
  {
    this->VertexArray->Bind();
    this->Visible->Upload(VerticesOf(visible, corners), vtkOpenGLBufferObject::ElementArrayBuffer);
    this->VertexArray->Release();
  }
}

void SplatPrimitives::DrawPiece(const SplatDrawing& drawing, vtkIdType first, vtkIdType size) const
{
  const int corners = CornersOf(drawing);
  const GLenum mode = corners == 1 ? GL_POINTS : GL_TRIANGLES;
  const auto count = static_cast<GLsizei>(corners * size);
  if (this->NumberOfVisible)
  {
    // OpenGL takes the offset into a buffer as a pointer.
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto* offset = reinterpret_cast<const void*>(corners * first * sizeof(GLuint));
    glDrawElements(mode, count, GL_UNSIGNED_INT, offset);
  }
  else
  {
    glDrawArrays(mode, static_cast<GLint>(corners * first), count);
  }
}

//------------------------------------------------------------------------------
void SplatPrimitives::Draw(const SplatDrawing& drawing)
{
  const std::array<vtkIdType, 2> visible{ 0, this->NumberOfVisible.value_or(0) };
  const auto [begin, end] = this->NumberOfVisible ? visible : drawing.GetDrawnRange();
  const bool software = IsDrawnInSoftware();
  const vtkIdType piece = software ? SoftwareBatches::Size : std::max<vtkIdType>(end - begin, 1);
  SoftwareFlushes flushes;
  this->VertexArray->Bind(); // OpenGL wants one, although there are no attributes
  for (vtkIdType first = begin; first < end; first += piece)
  {
    this->DrawPiece(drawing, first, std::min(piece, end - first));
    if (software && ((first - begin) / piece + 1) % SoftwareBatches::CallsPerFlush == 0)
    {
      flushes.Flush();
    }
  }
  this->VertexArray->Release();
}

void SplatPrimitives::ReleaseGraphicsResources()
{
  this->VertexArray->ReleaseGraphicsResources();
  this->Visible->ReleaseGraphicsResources();
  this->NumberOfVisible.reset();
}
}
