/**
 * @class vtkSurfaceSplatMapper
 * @brief draws oriented particles as disks
 *
 * Each point (each vertex cell, where there are any) is a disk in the plane orthogonal to its point
 * normal, of the radius in the point array `RadiusArrayName`, in world units. Disks that overlap
 * look like a surface. Lights, colour mapping (point, cell and field arrays, direct RGB(A)), opacity,
 * clipping planes, hardware selection and render passes work as for polygons, because the shading is
 * VTK's own; only the vertices come from here (glsl/vtkSurfaceSplatVS.glsl).
 *
 * What is missing is borne: without point normals the disks face the viewer, without radii all have
 * the radius `Radius`; both are said in one warning. A particle with a normal, radius or position
 * that is zero, negative or not finite (positions may of course be zero) is skipped.
 *
 * Both sides of a disk are visible; backface culling of the vtkProperty leaves the outward one, to
 * which the normal points.
 *
 * Cell arrays colour the particles of polydata with vertex cells only. Representation, edges, point
 * size and line width of the vtkProperty and textures have no effect.
 */

#ifndef vtkSurfaceSplatMapper_h
#define vtkSurfaceSplatMapper_h

#include "vtkHighOrderParticleRenderingModule.h" // for export macro
#include "vtkOpenGLPolyDataMapper.h"

#include <memory> // for std::unique_ptr

class VTKHIGHORDERPARTICLERENDERING_EXPORT vtkSurfaceSplatMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkSurfaceSplatMapper* New();
  vtkTypeMacro(vtkSurfaceSplatMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Name of the point array with the radius of each particle, in the units of the points; its first
   * component is taken. Default: "Radius".
   */
  vtkSetStringMacro(RadiusArrayName);
  vtkGetStringMacro(RadiusArrayName);
  ///@}

  ///@{
  /**
   * Factor on every radius, >= 0. Default: 1.
   */
  vtkSetClampMacro(RadiusScale, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(RadiusScale, double);
  ///@}

  ///@{
  /**
   * Radius of all particles where the radius array is missing, in the units of the points. 0, the
   * default, stands for one that covers the sides of the bounding box with that many disks.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Colour the disks by the side that is seen, instead of by scalars or the property's colour:
   * OutwardColor where the normal points to the viewer's side, else InwardColor. Default: off.
   */
  vtkSetMacro(ColorByNormalDirection, bool);
  vtkGetMacro(ColorByNormalDirection, bool);
  vtkBooleanMacro(ColorByNormalDirection, bool);
  ///@}

  ///@{
  /**
   * Colours of the two sides, RGB in [0, 1]. Default: blue (0.13, 0.35, 0.85) outward, red
   * (0.80, 0.15, 0.13) inward.
   */
  vtkSetVector3Macro(OutwardColor, double);
  vtkGetVector3Macro(OutwardColor, double);
  vtkSetVector3Macro(InwardColor, double);
  vtkGetVector3Macro(InwardColor, double);
  ///@}

  /**
   * Without effect: a disk has one colour, so there is nothing to interpolate, and the base class
   * would ask the shader for texture coordinates that disks do not have.
   */
  void SetInterpolateScalarsBeforeMapping(vtkTypeBool) override {}

  /**
   * Bounds of the disks that an input would be drawn as: of all its points, whether cells use them
   * or not, grown by the largest radius. Uninitialized bounds if there are no points.
   */
  void GetDiskBounds(vtkPolyData* input, double bounds[6]);

  void ReleaseGraphicsResources(vtkWindow* window) override;
  void ShallowCopy(vtkAbstractMapper* mapper) override;

protected:
  vtkSurfaceSplatMapper();
  ~vtkSurfaceSplatMapper() override;

  void ComputeBounds() override;

  void UpdateBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;

  using ShaderMap = std::map<vtkShader::Type, vtkShader*>;
  void GetShaderTemplate(ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderColor(ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderNormal(ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderClip(ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderPicking(ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor) override;
  void SetCameraShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor) override;

  // Disks have neither edges nor lines, whatever the property says.
  bool HaveWideLines(vtkRenderer*, vtkActor*) override { return false; }
  bool DrawingEdges(vtkRenderer*, vtkActor*) override { return false; }

  char* RadiusArrayName = nullptr;
  double RadiusScale = 1.0;
  double Radius = 0.0;
  bool ColorByNormalDirection = false;
  double OutwardColor[3] = { 0.13, 0.35, 0.85 };
  double InwardColor[3] = { 0.80, 0.15, 0.13 };

private:
  vtkSurfaceSplatMapper(const vtkSurfaceSplatMapper&) = delete;
  void operator=(const vtkSurfaceSplatMapper&) = delete;

  vtkDataArray* GetRadiusArray(vtkPolyData* input);
  double GetFallbackRadius(vtkPolyData* input);
  void WarnOfMissingArrays(vtkPolyData* input);
  void UploadParticles(vtkRenderer* renderer, vtkPolyData* input);
  void UploadColors(vtkRenderer* renderer, vtkPolyData* input);
  void SetShiftedClippingPlanes(vtkOpenGLHelper& cellBO, vtkActor* actor);

  struct Internals; // what lives on the GPU
  std::unique_ptr<Internals> Internal;
};

#endif
