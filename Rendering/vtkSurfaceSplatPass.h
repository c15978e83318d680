/**
 * @class vtkSurfaceSplatPass
 * @brief one pass of the splatting: what it draws into, textures of the size of the viewport
 */

#ifndef vtkSurfaceSplatPass_h
#define vtkSurfaceSplatPass_h

#include "vtkNew.h"

#include <string>
#include <vector>

class vtkShaderProgram;
class vtkSurfaceSplatPrimitives;
class vtkTextureObject;
class vtkWindow;
struct vtkSurfaceSplatDrawing;

/** Which of the surfaces along a view ray is meant. */
enum class vtkSurfaceSplatSide
{
  Front, // seen first from the eye
  Back   // seen last
};

class vtkSurfaceSplatPass
{
public:
  virtual ~vtkSurfaceSplatPass();

  /** Makes the textures of the pass, or changes their size. False if the driver cannot draw into them. */
  virtual bool Prepare(const vtkSurfaceSplatDrawing& drawing) = 0;

  virtual void Draw(
    const vtkSurfaceSplatDrawing& drawing, vtkSurfaceSplatPrimitives& primitives) = 0;

  ///@{
  /** Between these two, programs can read those textures that there are. */
  void Activate();
  void Deactivate();
  ///@}

  /** Tells a program where they are, under their names behind a prefix; they must be active. */
  void SetSamplers(vtkShaderProgram* program, const std::string& prefix = "splat") const;

  void ReleaseGraphicsResources(vtkWindow* window);

protected:
  explicit vtkSurfaceSplatPass(vtkSurfaceSplatSide side);

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
    const vtkSurfaceSplatDrawing& drawing, vtkTextureObject* texture, const Format& format);
  /** Of these textures and of Depth. */
  bool PrepareFramebuffer(
    const vtkSurfaceSplatDrawing& drawing, const std::vector<vtkTextureObject*>& colors);

  bool IsFront() const { return this->Side == vtkSurfaceSplatSide::Front; }

  const vtkSurfaceSplatSide Side;
  std::vector<Output> Outputs; // textures that other passes read
  vtkNew<vtkTextureObject> Depth;
  unsigned int Framebuffer = 0;

private:
  vtkSurfaceSplatPass(const vtkSurfaceSplatPass&) = delete;
  void operator=(const vtkSurfaceSplatPass&) = delete;
};

#endif
