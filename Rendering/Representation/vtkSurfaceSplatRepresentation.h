/**
 * @class vtkSurfaceSplatRepresentation
 * @brief ParaView's representation 'Surface Splats': oriented particles drawn as a surface by
 * vtkSurfaceSplatMapper
 *
 * Takes polydata and other point sets, or composites of them, whose blocks are drawn as one surface.
 * While the camera moves, if the view asks for a level of detail, some of the particles stand for all.
 * Particles carry point normals and, in a point array, radii; vtkSurfaceSplatMapper says what happens without them.
 */

#ifndef vtkSurfaceSplatRepresentation_h
#define vtkSurfaceSplatRepresentation_h

#include "SplatInput.h"                               // for hop::SplatInput::Blocks
#include "vtkHighOrderParticleRepresentationModule.h" // for export macro
#include "vtkNew.h"                                   // for vtkNew
#include "vtkPVDataRepresentation.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

class vtkActor;
class vtkPolyData;
class vtkProperty;
class vtkScalarsToColors;
class vtkSurfaceSplatActor;
class vtkSurfaceSplatMapper;

class VTKHIGHORDERPARTICLEREPRESENTATION_EXPORT vtkSurfaceSplatRepresentation
  : public vtkPVDataRepresentation
{
public:
  static vtkSurfaceSplatRepresentation* New();
  vtkTypeMacro(vtkSurfaceSplatRepresentation, vtkPVDataRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;
  void SetVisibility(bool visible) override;
  vtkDataObject* GetRenderedDataObject(int port) override;

  /** The prop in the view. ParaView's export for VTK.js asks for it in Python. */
  vtkActor* GetActor();

  ///@{
  /** Forwarded to vtkSurfaceSplatMapper, which documents them. */
  void SetMode(int mode);
  void SetSharpness(double sharpness);
  void SetInterpolateScalarsBeforeMapping(int interpolate);
  void SetRadiusArrayName(const char* name);
  void SetRadiusScale(double scale);
  void SetRadius(double radius);
  void SetColorByNormalDirection(bool on);
  void SetOutwardColor(double r, double g, double b);
  void SetInwardColor(double r, double g, double b);
  void SetLookupTable(vtkScalarsToColors* table);
  ///@}

  /** ParaView's names. "Surface With Edges": lines are drawn where cells end; all others: they are not. */
  void SetRepresentation(const char* name);

  ///@{
  /** Colour and width (pixels) of the lines where cells end. Default: dark blue, (0, 0, 0.5), and 1. */
  void SetEdgeColor(double r, double g, double b);
  void SetLineWidth(double value);
  ///@}

  /** 1: colours through the lookup table; 0: arrays of 2 to 4 components are colours. */
  void SetMapScalars(int map);

  ///@{
  /**
   * Which blocks of a composite are drawn, in the language of vtkDataAssembly for its hierarchy.
   * Default: "/", all of them.
   */
  void AddBlockSelector(const char* selector);
  void RemoveAllBlockSelectors();
  ///@}

  ///@{
  /**
   * Colour (RGB in [0, 1]) and opacity of the blocks of a composite that the selector names. They come before colours
   * by an array and before the representation's own. Default: none.
   */
  void SetBlockColor(const char* selector, double r, double g, double b);
  void RemoveAllBlockColors();
  void SetBlockOpacity(const char* selector, double opacity);
  void RemoveAllBlockOpacities();
  ///@}

  /**
   * How many different numbers the blocks of a composite have in the field array vtkBlockColors, by which they may be
   * coloured. Further blocks begin again with 0. Default: 7.
   */
  void SetBlockColorsDistinctValues(int count);

  /**
   * ParaView's numbers. 400: both sides are drawn alike; 401: only the outward side is drawn; 402: only the inward
   * side; a smaller number: the inward side has the colours and the opacity below. Default: 400.
   */
  void SetBackfaceRepresentation(int sides);

  ///@{
  /**
   * Colours and opacity of the inward side, as in vtkProperty. Where an array gives the colours, both sides have its
   * colours. By default white and opaque.
   */
  void SetBackfaceAmbientColor(double r, double g, double b);
  void SetBackfaceDiffuseColor(double r, double g, double b);
  void SetBackfaceOpacity(double value);
  ///@}

  ///@{
  /** Forwarded to vtkProperty. PointSize: 2 by default. */
  void SetAmbient(double value);
  void SetAmbientColor(double r, double g, double b);
  void SetDiffuse(double value);
  void SetDiffuseColor(double r, double g, double b);
  void SetSpecular(double value);
  void SetSpecularColor(double r, double g, double b);
  void SetSpecularPower(double value);
  void SetPointSize(double value);
  void SetOpacity(double value);
  void SetInterpolation(int value);
  void SetRoughness(double value);
  void SetMetallic(double value);
  ///@}

  ///@{
  /** Forwarded to vtkActor. */
  void SetPosition(double x, double y, double z);
  void SetScale(double x, double y, double z);
  void SetOrientation(double x, double y, double z);
  void SetOrigin(double x, double y, double z);
  void SetUserTransform(const double matrix[16]);
  void SetPickable(int pickable);
  ///@}

protected:
  vtkSurfaceSplatRepresentation();
  ~vtkSurfaceSplatRepresentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkSurfaceSplatRepresentation(const vtkSurfaceSplatRepresentation&) = delete;
  void operator=(const vtkSurfaceSplatRepresentation&) = delete;

  void PrepareMapper(vtkInformation* inInfo);
  void ProvideParticles(vtkInformation* inInfo, vtkInformation* outInfo);
  void UpdateColoring();
  void UpdateBackface();
  bool IsTranslucent();
  vtkPolyData* GetParticlesToDraw();

  vtkNew<vtkSurfaceSplatMapper> Mapper;
  vtkNew<vtkSurfaceSplatActor> Actor;
  vtkNew<vtkProperty> Backface;
  hop::SplatInput::Blocks Blocks;
  // Of this process, empty where it has no data.
  vtkSmartPointer<vtkPolyData> OwnParticles;
  // The same with the ghosts that other ranks have for it.
  vtkSmartPointer<vtkPolyData> Particles;
  // Those of all ranks, on the first of them; nothing as long as nobody needs them.
  vtkSmartPointer<vtkPolyData> AllParticles;
  vtkSmartPointer<vtkPolyData>
    ArraysToColorBy;           // without ghosts, and without arrays that are not for users
  double DiskBounds[6];        // without ghosts
  bool WasTranslucent = false; // at the last update
};

#endif
