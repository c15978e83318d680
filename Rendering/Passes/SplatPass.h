/**
 * @class SplatPass
 * @brief one pass of the splatting: what it draws into, textures of the size of the viewport
 */

#pragma once

#include "vtkNew.h"

#include <string>
#include <vector>

class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace hop
{
class SplatPrimitives;
struct SplatDrawing;

/** Which of the surfaces along a view ray is meant. */
enum class LayerSide
{
  Front, // seen first from the eye
  Back   // seen last
};

class SplatPass
{
public:
  virtual ~SplatPass();

  /** Makes the textures of the pass, or changes their size. False if the driver cannot draw into them. */
  virtual bool Prepare(const SplatDrawing& drawing) = 0;

  virtual void Draw(const SplatDrawing& drawing, SplatPrimitives& primitives) = 0;

  ///@{
  /** Between these two, programs can read those textures that there are. */
  void Activate();
  void Deactivate();
  ///@}

  /** Tells a program where they are, under their names behind a prefix; they must be active. */
  void SetSamplers(vtkShaderProgram* program, const std::string& prefix = "splat") const;

  void ReleaseGraphicsResources(vtkWindow* window);

protected:
  explicit SplatPass(LayerSide side);

  struct Format
  {
    unsigned int Internal, External, Type;
    int Components, VtkType;
  };

  struct Output
  {
    std::string Name;
    vtkTextureObject* Texture;
  };

  static void PrepareTexture(
    const SplatDrawing& drawing, vtkTextureObject* texture, const Format& format);
  /** Of these textures and of Depth. */
  bool PrepareFramebuffer(
    const SplatDrawing& drawing, const std::vector<vtkTextureObject*>& colors);

  bool IsFront() const { return this->Side == LayerSide::Front; }

  const LayerSide Side;
  std::vector<Output> Outputs; // textures that other passes read
  vtkNew<vtkTextureObject> Depth;
  unsigned int Framebuffer = 0;

private:
  SplatPass(const SplatPass&) = delete;
  void operator=(const SplatPass&) = delete;
};
}
