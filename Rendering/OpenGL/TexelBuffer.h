/**
 * @class TexelBuffer
 * @brief an array of texels: a buffer object and the texture through which shaders read it
 */

#pragma once

#include "vtkNew.h"
#include "vtkType.h"

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace hop
{
class TexelBuffer
{
public:
  TexelBuffer();
  ~TexelBuffer();

  ///@{
  /** Replaces the content. A texel has four numbers. */
  void Upload(vtkOpenGLRenderWindow* window, const float* rgba, vtkIdType texels);
  void Upload(vtkOpenGLRenderWindow* window, const unsigned char* rgba, vtkIdType texels);
  ///@}

  ///@{
  /**
   * The content that was uploaded as floats can be read between these two calls. Map() returns nullptr if the driver
   * cannot map buffers.
   */
  const float* Map();
  void Unmap();
  ///@}

  ///@{
  /** Programs can read the texture between these two calls. */
  void Activate();
  void Deactivate();
  ///@}

  /** Tells a program which texture unit its sampler of this name reads. The texture must be active. */
  void SetSampler(vtkShaderProgram* program, const char* name);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  template <typename T>
  void UploadTexels(vtkOpenGLRenderWindow* window, const T* rgba, vtkIdType texels, int vtkType);

  vtkNew<vtkOpenGLBufferObject> Buffer;
  vtkNew<vtkTextureObject> Texture;
};
}
