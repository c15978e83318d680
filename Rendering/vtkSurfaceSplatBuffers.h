/**
 * @class vtkSurfaceSplatBuffers
 * @brief the particles on the GPU, as buffer textures that shaders index by particle
 *
 * All methods need the OpenGL context of the window that Upload() was called with.
 */

#ifndef vtkSurfaceSplatBuffers_h
#define vtkSurfaceSplatBuffers_h

#include "vtkNew.h"
#include "vtkType.h"

#include <array>
#include <functional>
#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;
struct vtkSurfaceSplatParticles;

/** One array of texels: a buffer object and the texture through which shaders read it. */
class vtkSurfaceSplatTexels
{
public:
  vtkSurfaceSplatTexels();
  ~vtkSurfaceSplatTexels();

  ///@{
  /** Replaces the content; there are four numbers a texel. */
  void Upload(vtkOpenGLRenderWindow* window, const float* rgba, vtkIdType texels);
  void Upload(vtkOpenGLRenderWindow* window, const unsigned char* rgba, vtkIdType texels);
  ///@}
  ///@{
  /** Between these two, what was uploaded as floats can be read; nullptr if the driver cannot do that. */
  const float* Map();
  void Unmap();
  ///@}
  void Activate();
  void Deactivate();
  void SetSampler(vtkShaderProgram* program, const char* name);
  void ReleaseGraphicsResources(vtkWindow* window);

private:
  template <typename T>
  void UploadTexels(vtkOpenGLRenderWindow* window, const T* rgba, vtkIdType texels, int vtkType);

  vtkNew<vtkOpenGLBufferObject> Buffer;
  vtkNew<vtkTextureObject> Texture;
};

class vtkSurfaceSplatBuffers
{
public:
  /**
   * Replaces the content. The number of particles is cut to what the driver can address
   * (GL_MAX_TEXTURE_BUFFER_SIZE); compare GetNumberOfParticles() to notice.
   */
  void Upload(vtkOpenGLRenderWindow* window, const vtkSurfaceSplatParticles& particles);

  /**
   * One RGBA colour, or four numbers, a particle, for shaders as `splatColor`.
   */
  template <typename T>
  void UploadColors(vtkOpenGLRenderWindow* window, const std::vector<T>& rgba)
  {
    this->Color.Upload(window, rgba.data(), static_cast<vtkIdType>(rgba.size() / 4));
    this->HasColor = true;
  }

  vtkIdType GetNumberOfParticles() const { return this->NumberOfParticles; }

  /** How many sheets the particles tell apart. */
  int GetNumberOfSheets() const { return static_cast<int>(this->SheetRanges.size()); }

  /** See vtkSurfaceSplatParticles::SheetRanges. */
  const std::array<vtkIdType, 2>& GetSheetRange(int sheet) const
  {
    return this->SheetRanges[sheet];
  }

  /** Whether particles carry clip planes. */
  bool GetHasClip() const { return this->HasClip; }

  /** Whether particles know how the surface bends. */
  bool GetHasShape() const { return this->HasShape; }

  ///@{
  /** Of those particles that are drawn; model coordinates. */
  double GetMeanRadius() const { return this->MeanRadius; }
  double GetLargestRadius() const { return this->LargestRadius; }
  ///@}

  /** What was subtracted from the model coordinates. */
  const std::array<double, 3>& GetOrigin() const { return this->Origin; }

  /** The particles as they are on the GPU, in arrays like those of vtkSurfaceSplatParticles. */
  struct Mapped
  {
    const float* CentreRadius = nullptr;
    const float* Normal = nullptr;
    const float* Clip = nullptr; ///< without planes it stays that
  };
  /** Calls with them; false, and nothing else, if the driver cannot do that. */
  bool Read(const std::function<void(const Mapped&)>& use);

  void Activate();
  void Deactivate();
  /** Tells a program where the textures are; they must be active. */
  void SetSamplers(vtkShaderProgram* program);
  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void MeasureRadii(const std::vector<float>& centreRadius);
  std::vector<vtkSurfaceSplatTexels*> GetFilled();

  vtkIdType NumberOfParticles = 0;
  std::vector<std::array<vtkIdType, 2>> SheetRanges;
  double MeanRadius = 0.;
  double LargestRadius = 0.;
  std::array<double, 3> Origin = { 0., 0., 0. };
  vtkSurfaceSplatTexels CentreRadius;
  vtkSurfaceSplatTexels Normal;
  vtkSurfaceSplatTexels Clip;  // three a particle; stays empty without clip planes
  vtkSurfaceSplatTexels Shape; // two a particle; stays empty where the surface is nearly flat
  vtkSurfaceSplatTexels Color;
  vtkSurfaceSplatTexels PointIds; // four bytes, as the selection passes write them
  bool HasClip = false;
  bool HasShape = false;
  bool HasColor = false;
};

#endif
