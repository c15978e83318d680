/**
 * @class vtkSurfaceSplatLayer
 * @brief one layer of the splatted surface, as sums in textures: the first passes of the splatting
 *
 * The front layer is what is seen first from the eye, the back layer what is seen last (the far side
 * of a closed surface); together they make translucent surfaces. The passes are those of M. Botsch,
 * A. Hornung, M. Zwicker, L. Kobbelt, *High-Quality Surface Splatting on Today's GPUs*, 2005:
 * visibility and accumulation, here into floating-point textures of the size of the viewport; the
 * resolve pass is the mapper's. Passes run only if something that they depend on has changed.
 */

#ifndef vtkSurfaceSplatLayer_h
#define vtkSurfaceSplatLayer_h

#include "vtkNew.h"

#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkOpenGLVertexArrayObject;
class vtkShaderProgram;
class vtkSurfaceSplatBuffers;
class vtkSurfaceSplatView;
class vtkTextureObject;
class vtkWindow;

/** What the passes draw, and how. */
struct vtkSurfaceSplatDrawing
{
  vtkOpenGLRenderWindow* Window = nullptr;
  vtkSurfaceSplatBuffers* Buffers = nullptr;
  const vtkSurfaceSplatView* View = nullptr;
  double RadiusScale = 1.;
  double Sharpness = 2.;
  int Kind = 2;             // 0: opaque particles; 1: translucent ones; 2: all
  int Stride = 1;           // every how-manieth particle is drawn
  bool FacesViewer = false; // there are no normals
  int HiddenSide = 0;       // 1: splats seen from outward are left out; -1: from inward; 0: none
  bool Colors = false;      // colours or lookup coordinates are accumulated
  bool Strongest = false;   // the strongest particle of every pixel is found
  int NumberOfClippingPlanes = 0;
  float ClippingPlanes[6][4] = {}; // shifted model coordinates
  std::vector<double> Key;         // whatever else the picture depends on
};

class vtkSurfaceSplatLayer
{
public:
  enum Side
  {
    Front,
    Back
  };

  /** Of the weights that a splat has, 1 in its middle, the smallest that makes a surface. */
  static constexpr double LeastWeight = 0.05;

  explicit vtkSurfaceSplatLayer(Side side);
  ~vtkSurfaceSplatLayer();

  /** Brings the textures up to date. False if the driver cannot draw into them. */
  bool Update(const vtkSurfaceSplatDrawing& drawing);

  /** Between these two, programs can read the textures. */
  void Activate();
  void Deactivate();
  /** Tells a program where the textures of this layer and of the front layer are; both active. */
  void SetSamplers(vtkShaderProgram* program, const vtkSurfaceSplatLayer& front) const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  vtkSurfaceSplatLayer(const vtkSurfaceSplatLayer&) = delete;
  void operator=(const vtkSurfaceSplatLayer&) = delete;

  /** A framebuffer object over some of the textures. */
  struct Framebuffer
  {
    unsigned int Handle = 0;
    int Colors = 0;
    bool Complete = false;
  };

  /** What differs between the passes. */
  struct Pass
  {
    std::string Fragment;     // source of the fragment stage
    double Push = 0.;         // by how many radii splats are moved away from the eye
    double Reach = 1.;        // how far they reach, in radii
    bool SkipsHidden = false; // splats whose middle is hidden are left out
  };

  bool PrepareTextures(const vtkSurfaceSplatDrawing& drawing);
  void PrepareFramebuffer(const vtkSurfaceSplatDrawing& drawing, Framebuffer& framebuffer,
    const std::vector<vtkTextureObject*>& colors, vtkTextureObject* depth);
  static void ClearColors(const Framebuffer& framebuffer);
  void StartWithDepth(const vtkSurfaceSplatDrawing& drawing, const Framebuffer& framebuffer);
  void AverageSeen();
  void FindVisible(const vtkSurfaceSplatDrawing& drawing);
  void CopyVisibleDepth(const vtkSurfaceSplatDrawing& drawing);
  void Accumulate(const vtkSurfaceSplatDrawing& drawing);
  void FindStrongest(const vtkSurfaceSplatDrawing& drawing);
  vtkShaderProgram* ReadyProgram(const vtkSurfaceSplatDrawing& drawing, const Pass& pass);
  void DrawSplats(const vtkSurfaceSplatDrawing& drawing);
  bool NeedsUpdate(const vtkSurfaceSplatDrawing& drawing);

  const Side WhichSide;
  vtkNew<vtkTextureObject> VisibleDepth;
  vtkNew<vtkTextureObject> Seen;
  vtkNew<vtkTextureObject> NormalWeight;
  vtkNew<vtkTextureObject> OffsetDepth;
  vtkNew<vtkTextureObject> ColorSum;
  vtkNew<vtkTextureObject> Number;
  vtkNew<vtkTextureObject>
    TestedDepth; // a copy that is tested against while the first is looked up
  Framebuffer Visibility, Accumulation, Strongest;
  vtkNew<vtkOpenGLVertexArrayObject> VertexArray;
  std::vector<double> Key; // what the textures were drawn from
};

#endif
