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

#include "vtkSurfaceSplatAccumulationPass.h"
#include "vtkSurfaceSplatPrimitives.h"
#include "vtkSurfaceSplatStrongestPass.h"
#include "vtkSurfaceSplatVisibilityPass.h"

#include <array>
#include <vector>

class vtkShaderProgram;
class vtkWindow;
struct vtkSurfaceSplatDrawing;

class vtkSurfaceSplatLayer
{
public:
  explicit vtkSurfaceSplatLayer(vtkSurfaceSplatSide side);

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

  vtkSurfaceSplatVisibilityPass Visibility;
  vtkSurfaceSplatAccumulationPass Accumulation;
  vtkSurfaceSplatStrongestPass Strongest;
  const std::array<vtkSurfaceSplatPass*, 3> Passes; // in this order
  vtkSurfaceSplatPrimitives Primitives;
  std::vector<double> Key; // what the textures were drawn from
};

#endif
