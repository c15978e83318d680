/**
 * @class vtkSurfaceSplatMapper
 * @brief draws oriented particles as one closed, shaded surface
 *
 * Each point (each vertex cell, where there are any) is a particle: a disk in the plane orthogonal to
 * its point normal, of the radius in the point array `RadiusArrayName`, in world units. There are
 * three modes:
 * - Splats: Gaussian surface splatting after M. Zwicker et al., *Surface Splatting*, 2001, and M.
 *   Botsch et al., *High-Quality Surface Splatting on Today's GPUs*, 2005. At each pixel depth, normal and
 *   scalar of the nearest surface's disks are averaged with Gaussian weights, and shaded then. The depth
 *   is corrected for the curvature between the disks.
 * - Disks: each disk for itself, in one pass.
 * - Points: each particle as a point of the vtkProperty's PointSize.
 *
 * Lights, materials, colour mapping (point, cell and field arrays, direct RGB(A)), opacity, clipping
 * planes, hardware selection and render passes work as for polygons, because the shading is VTK's
 * own. With InterpolateScalarsBeforeMapping (default: on) splats average scalars and look the colour
 * up per pixel, as long as the lookup table is not categorical; with a categorical one a pixel has
 * the colour of the particle that counts most there. Translucent splats have two layers, the nearest
 * and the farthest surface. Where a point array `Isovalue` has up to eight values, the particles of each
 * isovalue have two layers of their own. Opaque splats of different isovalues (up to 128) are not averaged,
 * however near their surfaces are: the nearest one is seen.
 *
 * Particles beside a boundary curve or a crease of the surface may carry up to three planes that cut
 * their disks off, so that the surface ends in a line and creases stay sharp:
 * - `Clip_Normal`: 3 components a plane, unit vector to the side that is cut off; zero: no plane.
 * - `Clip_Distance`: 1 component a plane, distance of the plane from the particle along the vector, >= 0,
 *   world units.
 * - `Clip_Angle`: 1 component a plane, dihedral angle of the surface there in degrees, between the normals of
 *   both sides: 0 where it is smooth, 180 at a boundary curve. It lets splats fill gaps that others leave beyond
 *   planes: by up to a third of a radius below 10 degrees, where the surface is almost smooth, by up to a seventh
 *   at creases, and not at all from 90 degrees on. Without this array splats end at all planes.
 * - `Clip_Curvature`: 1 component a plane, 1 / world units. It bends the line in which a plane cuts its disk to a
 *   parabola, towards the plane's vector where it is positive.
 *
 * Where the surface bends much over one splat, particles that carry its shape operator are drawn as
 * pieces of paraboloids instead of disks: point array `Shape_Operator` (6 components, the symmetric
 * derivative of the unit normal along the surface: xx, yy, zz, xy, yz, xz; 1 / world units). The paraboloids are
 * fitted to the particles around, as the surface may bend differently there.
 *
 * Instead of these arrays there may be one that holds them side by side, see Common/SplatColumns.h. An array under its
 * own name counts where there are both.
 *
 * Points of meshes on creases have one normal, a mean; another array of that kind, of CreaseColumns there, has the normals
 * and planes of two sides, and a splat is drawn of each.
 *
 * Particles that were moved after they had been computed take radii, shape operators and planes along, if one affine
 * map (or one for each run of points) has moved them and a point array `Original_Placement` says where they were: 6
 * components, position and unit normal as computed. A warning says that they were moved in another way.
 *
 * Points that a point array `vtkGhostType` calls duplicate are ghosts: copies of particles that other ranks have. Splats
 * are averaged with them as with others, but a pixel to which a ghost contributes most is left to its rank, so that
 * ranks with the ghosts that their particles touch draw a picture together as one rank would. Ghosts are never
 * selected, and not drawn in the other modes and with a Stride. Hidden points are not drawn.
 *
 * Without point normals the disks face the viewer; without radii all particles have the radius `Radius`. One
 * warning says both. A particle with a normal, radius or position
 * that is zero, negative or not finite (positions may of course be zero) is skipped. Where the
 * graphics driver cannot draw into floating-point textures, splats are drawn as disks, with a
 * warning.
 *
 * Both sides of the surface are visible; backface culling of the vtkProperty leaves the outward one,
 * to which the normals point. A backface property of the vtkActor is the property of the inward side, as it is of
 * the back faces of polygons: where scalars or ColorByNormalDirection give the colours, both sides have these
 * colours, and only the opacity of the backface property counts (for polygons not even the opacity). Colours of
 * single particles (CellColorArrayName) are then seen from outward only. With a vtkSurfaceSplatActor one side may be
 * opaque and the other translucent.
 *
 * Particles may know where their cells end on the surface: point array `Cell_Borders`, 4 components for each of up to
 * four borders, which are the vector from the particle to the nearest place of the border along the tangent plane
 * (zero: no border) and the border's curvature, 1 / world units, positive where it bends along the vector. Colours that
 * jump from cell to cell then end at the borders of splats, while depth and normal go on smoothly; and where the
 * vtkProperty shows edges, splats are drawn with lines of its EdgeColor and LineWidth (pixels) at the borders.
 *
 * Cell arrays colour the particles of polydata with vertex cells only. Representation of the vtkProperty and textures
 * have no effect. At most 6 clipping planes.
 */

#ifndef vtkSurfaceSplatMapper_h
#define vtkSurfaceSplatMapper_h

#include "vtkHighOrderParticleRenderingModule.h" // for export macro
#include "vtkOpenGLPolyDataMapper.h"

#include "vtkSmartPointer.h" // for vtkSmartPointer

#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

class vtkDoubleArray;

namespace hop
{
class SplatLayer;
struct ParticleInput;
struct SplatDrawing;
struct ShaderText;
}

class VTKHIGHORDERPARTICLERENDERING_EXPORT vtkSurfaceSplatMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkSurfaceSplatMapper* New();
  vtkTypeMacro(vtkSurfaceSplatMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** How particles are drawn, see above. */
  enum DrawingMode
  {
    Splats,
    Disks,
    Points
  };

  ///@{
  /**
   * How particles are drawn. Default: Splats.
   */
  vtkSetClampMacro(Mode, int, Splats, Points);
  vtkGetMacro(Mode, int);
  void SetModeToSplats() { this->SetMode(Splats); }
  void SetModeToDisks() { this->SetMode(Disks); }
  void SetModeToPoints() { this->SetMode(Points); }
  ///@}

  ///@{
  /**
   * How steeply the weight of a splat falls from its middle to its rim: exp(-Sharpness (d / radius)^2)
   * at the distance d, lowered to be 0 at the rim. Small values smooth, large ones show the particles'
   * own normals. The surface ends at the same place with all sharpnesses, see SplatProfile. In [0.1, 20];
   * default: 2.
   */
  vtkSetClampMacro(Sharpness, double, 0.1, 20.0);
  vtkGetMacro(Sharpness, double);
  ///@}

  ///@{
  /**
   * Level of detail: only every Stride-th particle is drawn, with a radius larger by the square root.
   * As it may change with every picture, it does not count as a modification. Default: 1, all.
   */
  void SetStride(int stride) { this->Stride = stride > 1 ? stride : 1; }
  vtkGetMacro(Stride, int);
  ///@}

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
   * default, stands for the radius with which as many disks cover the sides of the bounding box.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Colour by the side that is seen, instead of by scalars or the property's colour:
   * OutwardColor where the normal points to the viewer's side, InwardColor elsewhere. Default: off.
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

  ///@{
  /**
   * Name of a cell array with colours of single particles, which come before scalars and property: red,
   * green, blue and opacity in [0, 1]. A red above 1 keeps the colour that the particle has anyway, an
   * opacity above 1 the opacity. Translucent particles are then a surface of their own, behind which
   * the others are seen. Only for polydata with vertex cells. Default: none.
   */
  vtkSetStringMacro(CellColorArrayName);
  vtkGetStringMacro(CellColorArrayName);
  ///@}

  ///@{
  /**
   * Whether splats are averaged with ghosts; without it ghosts are left out. To be switched off where the particles
   * that ghosts are copies of are in the same input. Default: on.
   */
  vtkSetMacro(BlendGhosts, bool);
  vtkGetMacro(BlendGhosts, bool);
  vtkBooleanMacro(BlendGhosts, bool);
  ///@}

  ///@{
  /**
   * Largest radius of particles that other processes draw, without RadiusScale. Bounds have room for it, so that those
   * of all processes together are those of one that draws all particles. Default: 0.
   */
  vtkSetMacro(LargestRadiusElsewhere, double);
  vtkGetMacro(LargestRadiusElsewhere, double);
  ///@}

  ///@{
  /** Whether some particles are opaque, or some translucent; both may be. */
  bool HasOpaqueGeometry() override;
  bool HasTranslucentPolygonalGeometry() override;
  ///@}

  /**
   * Bounds of the disks that an input would be drawn as: the bounds of all its points, whether cells use
   * them or not, grown by the largest radius. Uninitialized bounds if there are no points.
   */
  void GetDiskBounds(vtkPolyData* input, double bounds[6]);

  /** Largest radius that particles of an input have, without RadiusScale; 0 if there are none. */
  double GetLargestRadius(vtkPolyData* input);

  /**
   * The disks that an input would be drawn as, without levels of detail: for each point centre and radius, which is 0
   * where nothing is drawn, and without a radius array where Radius is 0.
   */
  vtkSmartPointer<vtkDoubleArray> GetDisks(vtkPolyData* input);

  /** Particles that are no vertex cells stand for a cell at their point, or for none. */
  void ProcessSelectorPixelBuffers(
    vtkHardwareSelector* selector, std::vector<unsigned int>& pixels, vtkProp* prop) override;

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
  void ReplaceShaderPositionVC(ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderPicking(ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderValues(ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetPropertyShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor) override;
  void SetCameraShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor) override;

  // The base class knows edges and lines of polygons only.
  bool HaveWideLines(vtkRenderer*, vtkActor*) override { return false; }
  bool DrawingEdges(vtkRenderer*, vtkActor*) override { return false; }

  int Mode = Splats;
  double Sharpness = 2.0;
  int Stride = 1;
  char* RadiusArrayName = nullptr;
  char* CellColorArrayName = nullptr;
  double RadiusScale = 1.0;
  double Radius = 0.0;
  bool BlendGhosts = true;
  double LargestRadiusElsewhere = 0.;
  bool ColorByNormalDirection = false;
  double OutwardColor[3] = { 0.13, 0.35, 0.85 };
  double InwardColor[3] = { 0.80, 0.15, 0.13 };

private:
  vtkSurfaceSplatMapper(const vtkSurfaceSplatMapper&) = delete;
  void operator=(const vtkSurfaceSplatMapper&) = delete;

  hop::ParticleInput Describe(vtkPolyData* input) const;
  double GetDrawnRadiusScale() const;
  void WarnOfMissingArrays(vtkPolyData* input);
  void UploadParticles(vtkRenderer* renderer, vtkPolyData* input);
  void UploadColors(vtkRenderer* renderer, vtkActor* actor);
  bool HasScalars(vtkPolyData* input);
  void UploadLookupCoordinates(vtkRenderer* renderer);

  bool DrawsSplats() const;
  bool DrawSplats(vtkRenderer* renderer, vtkActor* actor);
  void DrawLayer(
    hop::SplatLayer& layer, hop::SplatLayer& frontLayer, vtkRenderer* renderer, vtkActor* actor);
  void DrawFolds(vtkRenderer* renderer, vtkActor* actor);
  void DrawResolved(int primitive, int tiles, vtkRenderer* renderer, vtkActor* actor);
  void ForgetShaders();
  void DrawPrimitives(vtkRenderer* renderer, vtkActor* actor);
  hop::SplatDrawing DescribeDrawing(vtkRenderer* renderer, vtkActor* actor);
  hop::ShaderText DescribeShaders(vtkActor* actor) const;
  int GetShiftedClippingPlanes(vtkActor* actor, float planes[6][4]);

  struct Internals; // what lives on the GPU
  std::unique_ptr<Internals> Internal;
};

#endif
