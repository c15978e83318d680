/**
 * @class SplatPass
 * @brief base class of the passes of the splatting, and the textures that a pass draws into
 *
 * The textures have the size of the viewport.
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
  Front, // the first one from the eye
  Back   // the last one
};

class SplatPass
{
public:
  virtual ~SplatPass();

  /** Makes the textures of the pass, or changes their size. False if the driver cannot draw into them. */
  virtual bool Prepare(const SplatDrawing& drawing) = 0;

  virtual void Draw(const SplatDrawing& drawing, SplatPrimitives& primitives) = 0;

  ///@{
  /** Programs can read the textures that have been made between these two calls. */
  void Activate();
  void Deactivate();
  ///@}

  /** Tells a program where the textures are, which must be active. Samplers are named by prefix and name. */
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
  /** Makes the framebuffer of these textures and of Depth. */
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
