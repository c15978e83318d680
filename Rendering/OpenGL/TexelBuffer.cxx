#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "OpenGL/TexelBuffer.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace hop
{
TexelBuffer::TexelBuffer()
{
  this->Buffer->SetType(vtkOpenGLBufferObject::TextureBuffer);
}

TexelBuffer::~TexelBuffer() = default;

//------------------------------------------------------------------------------
template <typename T>
void TexelBuffer::UploadTexels(
  vtkOpenGLRenderWindow* window, const T* rgba, vtkIdType texels, int vtkType)
{
  this->Texture->SetContext(window);
  this->Texture->ResetFormatAndType(); // colours may be bytes in one upload and floats in the next
  this->Buffer->Upload(
    rgba, static_cast<std::size_t>(4 * texels), vtkOpenGLBufferObject::TextureBuffer);
  this->Texture->CreateTextureBuffer(static_cast<unsigned int>(texels), 4, vtkType, this->Buffer);
}

void TexelBuffer::Upload(vtkOpenGLRenderWindow* window, const float* rgba, vtkIdType texels)
{
  this->UploadTexels(window, rgba, texels, VTK_FLOAT);
}

void TexelBuffer::Upload(vtkOpenGLRenderWindow* window, const unsigned char* rgba, vtkIdType texels)
{
  this->UploadTexels(window, rgba, texels, VTK_UNSIGNED_CHAR);
}

//------------------------------------------------------------------------------
const float* TexelBuffer::Map()
{
  return this->Buffer->Bind()
    ? static_cast<const float*>(glMapBuffer(GL_TEXTURE_BUFFER, GL_READ_ONLY))
    : nullptr;
}

void TexelBuffer::Unmap()
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
void TexelBuffer::Activate()
{
  this->Texture->Activate();
}

void TexelBuffer::Deactivate()
{
  this->Texture->Deactivate();
}

void TexelBuffer::SetSampler(vtkShaderProgram* program, const char* name)
{
  if (program->IsUniformUsed(name))
  {
    program->SetUniformi(name, this->Texture->GetTextureUnit());
  }
}

void TexelBuffer::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Texture->ReleaseGraphicsResources(window);
  this->Buffer->ReleaseGraphicsResources();
}
}
