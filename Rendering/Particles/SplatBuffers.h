/**
 * @class SplatBuffers
 * @brief the particles on the GPU, as buffer textures that shaders index by particle
 *
 * All methods need the OpenGL context of the window that Upload() was called with.
 */

#pragma once

#include "OpenGL/TexelBuffer.h"

#include "vtkType.h"

#include <array>
#include <functional>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace hop
{
struct SplatParticles;

class SplatBuffers
{
public:
  /**
   * Replaces the content. The number of particles is cut to what the driver can address
   * (GL_MAX_TEXTURE_BUFFER_SIZE); compare GetNumberOfParticles() to notice.
   */
  void Upload(vtkOpenGLRenderWindow* window, const SplatParticles& particles);

  /** Replaces the colours: four numbers a particle, for shaders as `splatColor`. */
  template <typename T>
  void UploadColors(vtkOpenGLRenderWindow* window, const std::vector<T>& rgba)
  {
    this->Color.Upload(window, rgba.data(), static_cast<vtkIdType>(rgba.size() / 4));
    this->HasColor = true;
  }

  vtkIdType GetNumberOfParticles() const { return this->NumberOfParticles; }

  /** How many isovalues the particles tell apart, at least one. */
  int GetNumberOfIsovalues() const { return static_cast<int>(this->IsovalueRanges.size()); }

  /** The particles of one isovalue, see SplatParticles::IsovalueRanges. */
  const std::array<vtkIdType, 2>& GetIsovalueRange(int isovalue) const
  {
    return this->IsovalueRanges[isovalue];
  }

  /** Whether particles carry clip planes. */
  bool GetHasClip() const { return this->HasClip; }

  /** See SplatParticles::ClipStride. */
  int GetClipStride() const { return this->ClipStride; }

  /** Whether particles know the borders of their cells. */
  bool GetHasBorders() const { return this->HasBorders; }

  /** Whether particles carry shape operators. */
  bool GetHasShape() const { return this->HasShape; }

  /** See SplatParticles::HasLayers. */
  bool GetHasLayers() const { return this->HasLayers; }

  /** See SplatParticles::HasGhosts. */
  bool GetHasGhosts() const { return this->HasGhosts; }

  ///@{
  /** Radius of the particles that are drawn, in model coordinates; 0 if none is. */
  double GetMeanRadius() const { return this->MeanRadius; }
  double GetLargestRadius() const { return this->LargestRadius; }
  ///@}

  /** What was subtracted from the model coordinates. */
  const std::array<double, 3>& GetOrigin() const { return this->Origin; }

  /** The particles as they are on the GPU, in arrays like the ones of SplatParticles. */
  struct Mapped
  {
    const float* CentreRadius = nullptr;
    const float* Normal = nullptr;
    const float* Clip = nullptr;    ///< nullptr if there are no planes
    const float* Borders = nullptr; ///< nullptr if there are none, or if they were not asked for
  };
  /** Calls with the particles. Returns false, without a call, if the driver cannot map buffers. */
  bool Read(const std::function<void(const Mapped&)>& use, bool withBorders = false);

  ///@{
  /** Programs can read the textures between these two calls. */
  void Activate();
  void Deactivate();
  ///@}

  /** Tells a program where the textures are; they must be active. */
  void SetSamplers(vtkShaderProgram* program);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void MeasureRadii(const std::vector<float>& centreRadius);
  std::vector<TexelBuffer*> GetFilled();

  vtkIdType NumberOfParticles = 0;
  std::vector<std::array<vtkIdType, 2>> IsovalueRanges;
  double MeanRadius = 0.;
  double LargestRadius = 0.;
  std::array<double, 3> Origin = { 0., 0., 0. };
  TexelBuffer CentreRadius;
  TexelBuffer Normal;
  TexelBuffer Clip;    // three or five texels a particle; empty without clip planes
  TexelBuffer Borders; // four texels a particle; empty without borders
  TexelBuffer Shape;   // two texels a particle; empty where the surface is nearly flat
  TexelBuffer Color;
  TexelBuffer PointIds; // four bytes a particle, as the selection passes write them
  bool HasClip = false;
  int ClipStride = 0;
  bool HasBorders = false;
  bool HasShape = false;
  bool HasLayers = false;
  bool HasGhosts = false;
  bool HasColor = false;
};
}
