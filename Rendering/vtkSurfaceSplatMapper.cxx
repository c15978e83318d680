#include "vtkSurfaceSplatGL.h" // before everything that may include an OpenGL header

#include "vtkSurfaceSplatMapper.h"

#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLTexture.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkShaderProgram.h"
#include "vtkShaderProperty.h"
#include "vtkStaticCellLinksTemplate.h"
#include "vtkSurfaceSplatBuffers.h"
#include "vtkSurfaceSplatColors.h"
#include "vtkSurfaceSplatDisk.h"
#include "vtkSurfaceSplatDrawing.h"
#include "vtkSurfaceSplatEdge.h"
#include "vtkSurfaceSplatLayer.h"
#include "vtkSurfaceSplatOutline.h"
#include "vtkSurfaceSplatParticles.h"
#include "vtkSurfaceSplatPrimitives.h"
#include "vtkSurfaceSplatRay.h"
#include "vtkSurfaceSplatResolve.h"
#include "vtkSurfaceSplatResolveVS.h"
#include "vtkSurfaceSplatTiles.h"
#include "vtkSurfaceSplatVS.h"
#include "vtkSurfaceSplatView.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace
{
// Where the colour of a pixel comes from.
enum class ColorSource
{
  Property, // of the actor
  Colors,   // one a particle, averaged
  Lookup,   // averaged lookup coordinates
  Strongest // one a particle, not to be mixed
};

// The base class keeps a program for every kind of primitive. Those of triangles and of strips are lit
// alike; the second one draws outlines if the surface is opaque, else the back layer.
constexpr int Surface = vtkOpenGLPolyDataMapper::PrimitiveTris;
constexpr int Extra = vtkOpenGLPolyDataMapper::PrimitiveTriStrips;
// Outlines in front of the surface itself. Lines are lit where there are normals.
constexpr int Folds = vtkOpenGLPolyDataMapper::PrimitiveLines;

constexpr const char* ClipNormalName = "Clip_Normal";
constexpr const char* ShapeOperatorName = "Shape_Operator";
constexpr const char* ClipDistanceName = "Clip_Distance";
constexpr const char* ClipAngleName = "Clip_Angle";
constexpr const char* ClipCurvatureName = "Clip_Curvature";
constexpr const char* SheetName = "Isovalue";

// More are too slow to be drawn one after the other.
constexpr int MaximumNumberOfLayeredSheets = 8;
}

struct vtkSurfaceSplatMapper::Internals
{
  vtkSurfaceSplatBuffers Buffers;
  vtkSurfaceSplatView View;
  vtkSurfaceSplatLayer FrontLayer{ vtkSurfaceSplatSide::Front };
  vtkSurfaceSplatLayer BackLayer{ vtkSurfaceSplatSide::Back };
  vtkSurfaceSplatLayer* DrawnLayer = nullptr;
  int DrawnTiles = 0;
  int DrawnKind = 2;
  int HiddenSide = 0;
  bool Translucent = false;
  ColorSource Source = ColorSource::Property;
  bool OpacityIsInColors = false; // the property's has no part in it then
  bool ScalarColors = false;      // for both sides
  bool HasBackface = false;       // the shaders know of a backface property
  bool CannotSplat = false;       // the driver has no floating-point targets

  std::vector<vtkIdType> PointIds; // of the particles on the GPU, to colour them
  std::vector<vtkIdType> CellIds;

  // What the particles on the GPU were made from: the input (compared, never dereferenced) and its time, the
  // radius without an array, the names of the arrays of radii and of cells' colours.
  std::tuple<vtkPolyData*, vtkMTimeType, double, std::string, std::string> Uploaded;

  bool SaidNoNormals = false;
  bool SaidNoRadius = false;
};

vtkStandardNewMacro(vtkSurfaceSplatMapper);

//------------------------------------------------------------------------------
vtkSurfaceSplatMapper::vtkSurfaceSplatMapper()
  : Internal(new Internals)
{
  this->SetRadiusArrayName("Radius");
  this->InterpolateScalarsBeforeMapping = 1;
}

vtkSurfaceSplatMapper::~vtkSurfaceSplatMapper()
{
  // The base class would release its own resources only: its destructor no longer sees ours.
  this->ReleaseGraphicsResources(nullptr);
  this->SetRadiusArrayName(nullptr);
  this->SetCellColorArrayName(nullptr);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  // The base class makes the right context current and then calls this method again, so that the
  // buffers are released in the inner call; after that there is nothing left to release.
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internal->Buffers.ReleaseGraphicsResources(window);
  this->Internal->FrontLayer.ReleaseGraphicsResources(window);
  this->Internal->BackLayer.ReleaseGraphicsResources(window);
  this->Internal->Uploaded = {};
  this->Internal->CannotSplat = false; // another window may have another driver
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* other = vtkSurfaceSplatMapper::SafeDownCast(mapper))
  {
    this->SetMode(other->GetMode());
    this->SetSharpness(other->GetSharpness());
    this->SetStride(other->GetStride());
    this->SetRadiusArrayName(other->GetRadiusArrayName());
    this->SetRadiusScale(other->GetRadiusScale());
    this->SetRadius(other->GetRadius());
    this->SetCellColorArrayName(other->GetCellColorArrayName());
    this->SetColorByNormalDirection(other->GetColorByNormalDirection());
    this->SetOutwardColor(other->GetOutwardColor());
    this->SetInwardColor(other->GetInwardColor());
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------
vtkDataArray* vtkSurfaceSplatMapper::GetRadiusArray(vtkPolyData* input)
{
  return this->RadiusArrayName ? input->GetPointData()->GetArray(this->RadiusArrayName) : nullptr;
}

//------------------------------------------------------------------------------
double vtkSurfaceSplatMapper::GetFallbackRadius(vtkPolyData* input)
{
  if (this->Radius > 0.)
  {
    return this->Radius;
  }
  double bounds[6];
  for (int axis = 0; axis < 3; ++axis)
  {
    input->GetPoints()->GetData()->GetFiniteRange(bounds + 2 * axis, axis);
  }
  const double distance =
    vtkSurfaceSplatParticles::EstimateDistance(bounds, input->GetNumberOfPoints());
  // Hexagons are covered from 0.577 of their distance on; three quarters leave some room for unevenness.
  return distance > 0. ? 0.75 * distance : 1.;
}

//------------------------------------------------------------------------------
double vtkSurfaceSplatMapper::GetDrawnRadiusScale() const
{
  // A share of 1 / Stride of the particles covers the surface when each covers Stride times as much.
  return this->RadiusScale * std::sqrt(static_cast<double>(this->Stride));
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ComputeBounds()
{
  this->GetDiskBounds(this->GetInput(), this->Bounds);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::GetDiskBounds(vtkPolyData* input, double bounds[6])
{
  vtkMath::UninitializeBounds(bounds);
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return;
  }
  double range[2] = { 0., this->GetFallbackRadius(input) };
  if (vtkDataArray* radii = this->GetRadiusArray(input))
  {
    radii->GetFiniteRange(range, 0);
  }
  const double margin = this->GetDrawnRadiusScale() * std::max(range[1], 0.);
  for (int axis = 0; axis < 3; ++axis)
  {
    double extent[2];
    input->GetPoints()->GetData()->GetFiniteRange(extent, axis);
    bounds[2 * axis] = extent[0] - margin;
    bounds[2 * axis + 1] = extent[1] + margin;
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::UpdateBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  // The base class would go on to index buffers of the selected cells, which disks do not use.
  const bool colorsAreOld = this->GetCellColors(this->CurrentInput) &&
    this->VBOBuildTime.GetMTime() < actor->GetProperty()->GetMTime();
  if (colorsAreOld || this->GetNeedToRebuildBufferObjects(renderer, actor))
  {
    this->BuildBufferObjects(renderer, actor);
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  vtkPolyData* input = this->CurrentInput;
  this->WarnOfMissingArrays(input);
  this->UploadParticles(renderer, input);
  this->UploadColors(renderer, actor);

  // No index buffer is used, but the base class counts cells by it, for selections.
  for (auto& primitive : this->Primitives)
  {
    primitive.IBO->IndexCount = 0;
  }
  this->Primitives[PrimitiveTris].IBO->IndexCount = 3 *
    static_cast<size_t>(
      std::max(this->Internal->Buffers.GetNumberOfParticles(), input->GetNumberOfCells()));
  this->VBOBuildTime.Modified();
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::WarnOfMissingArrays(vtkPolyData* input)
{
  const bool empty = input->GetNumberOfPoints() == 0;
  const bool noNormals = !empty && !input->GetPointData()->GetNormals();
  const bool noRadius = !empty && !this->GetRadiusArray(input);
  if (noNormals && !this->Internal->SaidNoNormals)
  {
    vtkWarningMacro("The particles have no point normals: their disks face the viewer and show no "
                    "surface. Point normals are those set as the active normals of the point data, "
                    "in files and filters mostly the array 'Normals'.");
  }
  if (noRadius && !this->Internal->SaidNoRadius)
  {
    vtkWarningMacro("The particles have no point array '"
      << (this->RadiusArrayName ? this->RadiusArrayName : "")
      << "' with their radii: all have the radius " << this->GetFallbackRadius(input) << ".");
  }
  this->Internal->SaidNoNormals = noNormals;
  this->Internal->SaidNoRadius = noRadius;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::UploadParticles(vtkRenderer* renderer, vtkPolyData* input)
{
  Internals& gpu = *this->Internal;
  const auto key = std::make_tuple(input, input->GetMTime(), this->Radius,
    std::string(this->RadiusArrayName ? this->RadiusArrayName : ""),
    std::string(this->CellColorArrayName ? this->CellColorArrayName : ""));
  if (gpu.Uploaded == key)
  {
    return;
  }
  vtkPointData* data = input->GetPointData();
  vtkSurfaceSplatArrays arrays;
  arrays.Radii = this->GetRadiusArray(input);
  arrays.FallbackRadius = this->GetFallbackRadius(input);
  arrays.Normals = data->GetNormals();
  arrays.ClipNormals = data->GetArray(ClipNormalName);
  arrays.ClipDistances = data->GetArray(ClipDistanceName);
  arrays.ClipAngles = data->GetArray(ClipAngleName);
  arrays.ClipCurvatures = data->GetArray(ClipCurvatureName);
  arrays.ShapeOperators = data->GetArray(ShapeOperatorName);
  arrays.Sheets = data->GetArray(SheetName);
  arrays.CellColors = this->GetCellColors(input);
  vtkSurfaceSplatParticles particles = vtkSurfaceSplatParticles::FromPolyData(input, arrays);
  gpu.Buffers.Upload(vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()), particles);
  if (gpu.Buffers.GetNumberOfParticles() < particles.GetNumberOfParticles())
  {
    vtkWarningMacro("This graphics driver addresses only the first "
      << gpu.Buffers.GetNumberOfParticles() << " of " << particles.GetNumberOfParticles()
      << " particles; the others are not drawn.");
  }
  vtkDebugMacro(<< particles.Skipped << " particles cannot be drawn");
  gpu.PointIds = std::move(particles.PointIds);
  gpu.CellIds = std::move(particles.CellIds);
  gpu.Uploaded = key;
}

//------------------------------------------------------------------------------
vtkDataArray* vtkSurfaceSplatMapper::GetCellColors(vtkPolyData* input)
{
  vtkDataArray* colors = input && this->CellColorArrayName
    ? input->GetCellData()->GetArray(this->CellColorArrayName)
    : nullptr;
  return colors && colors->GetNumberOfComponents() == 4 && colors->GetNumberOfTuples() > 0
    ? colors
    : nullptr;
}

bool vtkSurfaceSplatMapper::HasOpaqueGeometry()
{
  vtkDataArray* cellColors = this->GetCellColors(this->GetInput());
  return !this->Superclass::HasTranslucentPolygonalGeometry() &&
    (!cellColors || cellColors->GetRange(3)[1] >= 1.);
}

bool vtkSurfaceSplatMapper::HasTranslucentPolygonalGeometry()
{
  return this->Superclass::HasTranslucentPolygonalGeometry() ||
    this->HasTranslucentCells(this->GetInput());
}

bool vtkSurfaceSplatMapper::HasTranslucentCells(vtkPolyData* input)
{
  vtkDataArray* cellColors = this->GetCellColors(input);
  return cellColors && cellColors->GetRange(3)[0] < 1.;
}

bool vtkSurfaceSplatMapper::IsDrawnTwice(vtkRenderer* renderer, vtkActor* actor)
{
  return actor->HasOpaqueGeometry() && actor->HasTranslucentPolygonalGeometry() &&
    !renderer->GetSelector(); // which has one pass for everything
}

int vtkSurfaceSplatMapper::GetDrawnKind(vtkRenderer* renderer, vtkActor* actor)
{
  constexpr int all = 2;
  return this->HasTranslucentCells(this->CurrentInput) && this->IsDrawnTwice(renderer, actor)
    ? actor->IsRenderingTranslucentPolygonalGeometry()
    : all;
}

// 1: what is seen from outward is not drawn in this pass; -1: from inward; 0: both are.
int vtkSurfaceSplatMapper::GetHiddenSide(vtkRenderer* renderer, vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  if (property->GetBackfaceCulling() || property->GetFrontfaceCulling())
  {
    return property->GetBackfaceCulling() ? -1 : 1;
  }
  vtkProperty* backface = actor->GetBackfaceProperty();
  if (!backface || this->HasTranslucentCells(this->CurrentInput) ||
    !this->IsDrawnTwice(renderer, actor))
  {
    return 0;
  }
  const bool translucentPass = actor->IsRenderingTranslucentPolygonalGeometry() != 0;
  return translucentPass == (backface->GetOpacity() < 1.) ? 1 : -1;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::UploadColors(vtkRenderer* renderer, vtkActor* actor)
{
  // Only splats have something between the particles to look colours up for, and cells' own colours
  // are not to be looked up.
  vtkDataArray* cellColors =
    this->Internal->CellIds.empty() ? nullptr : this->GetCellColors(this->CurrentInput);
  const vtkTypeBool interpolate = this->InterpolateScalarsBeforeMapping;
  this->InterpolateScalarsBeforeMapping = interpolate && this->DrawsSplats() && !cellColors;
  int source = 0;
  vtkUnsignedCharArray* colors = this->MapScalars(this->CurrentInput, 1.0, source);
  this->InterpolateScalarsBeforeMapping = interpolate;

  Internals& internal = *this->Internal;
  const ColorSource sourceBefore = internal.Source;
  const bool opacityBefore = internal.OpacityIsInColors;
  const bool scalarsBefore = internal.ScalarColors;
  internal.Source = ColorSource::Property;
  internal.OpacityIsInColors = cellColors != nullptr;
  internal.ScalarColors = colors || this->ColorCoordinates;
  if (this->ColorCoordinates)
  {
    this->UploadLookupCoordinates(renderer);
  }
  else
  {
    std::vector<unsigned char> rgba = this->MappedColors(colors, source);
    if (cellColors)
    {
      vtkSurfaceSplatReplaceColors(rgba, cellColors, internal.CellIds,
        internal.Buffers.GetNumberOfParticles(), actor->GetProperty());
    }
    if (!rgba.empty())
    {
      const bool categorical = colors && this->LookupTable &&
        this->LookupTable->GetIndexedLookup() && this->ColorMode != VTK_COLOR_MODE_DIRECT_SCALARS;
      internal.Source = categorical ? ColorSource::Strongest : ColorSource::Colors;
      internal.Buffers.UploadColors(
        vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()), rgba);
    }
  }
  if (internal.Source != sourceBefore || internal.OpacityIsInColors != opacityBefore ||
    internal.ScalarColors != scalarsBefore)
  {
    this->ForgetShaders();
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ForgetShaders()
{
  for (int primitive : { Surface, Extra, Folds })
  {
    this->Primitives[primitive].ShaderSourceTime = vtkTimeStamp(); // to be built again
  }
}

//------------------------------------------------------------------------------
// The colour of every particle that scalars give; empty if they give none.
std::vector<unsigned char> vtkSurfaceSplatMapper::MappedColors(
  vtkUnsignedCharArray* colors, int source)
{
  constexpr int Cells = 1; // what MapScalars() says of the source
  constexpr int Field = 2;
  const std::vector<vtkIdType>& ids =
    source == Cells ? this->Internal->CellIds : this->Internal->PointIds;
  const vtkIdType count = this->Internal->Buffers.GetNumberOfParticles();
  const bool single = source == Field && this->FieldDataTupleId >= 0;
  return vtkSurfaceSplatGatherColors(
    colors, single ? std::vector<vtkIdType>(count, this->FieldDataTupleId) : ids, count);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::UploadLookupCoordinates(vtkRenderer* renderer)
{
  const vtkIdType count = this->Internal->Buffers.GetNumberOfParticles();
  auto* coordinates = vtkFloatArray::SafeDownCast(this->ColorCoordinates);
  if (!coordinates || coordinates->GetNumberOfComponents() != 2 || count == 0)
  {
    return;
  }
  this->Internal->Buffers.UploadColors(
    vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()),
    vtkSurfaceSplatLookupTexels(coordinates, this->Internal->PointIds, count));
  this->Internal->Source = ColorSource::Lookup;

  // The base class binds this texture, of one colour a column, whenever there is a ColorTextureMap.
  if (!this->InternalColorTexture)
  {
    this->InternalColorTexture = vtkOpenGLTexture::New();
    this->InternalColorTexture->RepeatOff();
  }
  this->InternalColorTexture->SetInputData(this->ColorTextureMap);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  Internals& internal = *this->Internal;
  if (internal.Buffers.GetNumberOfParticles() == 0)
  {
    return;
  }
  this->DrawingVertices = false;
  this->DrawingSelection = false;
  if (this->PointPicking)
  {
    // For points the base class draws without depth, on top of the surface they belong to; splats
    // are that surface, and the nearest one must win.
    vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow())
      ->GetState()
      ->vtkglDepthMask(GL_TRUE);
  }
  double bounds[6];
  this->GetDiskBounds(this->CurrentInput, bounds);
  internal.View.Update(renderer, actor, internal.Buffers.GetOrigin(), bounds);
  if (internal.View.GetWidth() == 0 || internal.View.GetHeight() == 0)
  {
    return; // there are no framebuffers without pixels
  }
  internal.DrawnKind = this->GetDrawnKind(renderer, actor);
  internal.HiddenSide = this->GetHiddenSide(renderer, actor);
  const bool hasBackface = actor->GetBackfaceProperty() != nullptr;
  if (hasBackface != internal.HasBackface)
  {
    internal.HasBackface = hasBackface;
    this->ForgetShaders();
  }
  internal.Buffers.Activate();
  if (!this->DrawsSplats() || !this->DrawSplats(renderer, actor))
  {
    this->DrawPrimitives(renderer, actor);
  }
  internal.Buffers.Deactivate();
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatMapper::DrawsSplats() const
{
  return this->Mode == Splats && !this->Internal->CannotSplat;
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatMapper::DrawSplats(vtkRenderer* renderer, vtkActor* actor)
{
  // Far to near, for blending without depth peeling.
  std::vector<vtkSurfaceSplatLayer*> layers = { &this->Internal->FrontLayer };
  const bool translucent = actor->IsRenderingTranslucentPolygonalGeometry() != 0;
  if (translucent)
  {
    layers.insert(layers.begin(), &this->Internal->BackLayer);
  }
  if (translucent != this->Internal->Translucent)
  {
    this->Internal->Translucent = translucent;
    this->ForgetShaders();
  }
  vtkSurfaceSplatDrawing drawing;
  this->DescribeDrawing(renderer, actor, drawing);
  // Nested sheets shine through each other: each has layers of its own, one after the other in the same
  // textures.
  const int allSheets = this->Internal->Buffers.GetNumberOfSheets();
  const int sheets = translucent && allSheets <= MaximumNumberOfLayeredSheets ? allSheets : 1;
  for (int sheet = 0; sheet < sheets; ++sheet)
  {
    drawing.Sheet = sheets > 1 ? sheet : -1;
    if (!std::all_of(layers.begin(), layers.end(),
          [&](vtkSurfaceSplatLayer* layer) { return layer->Update(drawing); }))
    {
      vtkWarningMacro("This graphics driver cannot draw into floating-point textures: the "
                      "particles are drawn as disks.");
      this->Internal->CannotSplat = true;
      this->UploadColors(renderer, actor);
      this->ForgetShaders();
      return false;
    }
    for (vtkSurfaceSplatLayer* layer : layers)
    {
      this->DrawLayer(*layer, renderer, actor);
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::DescribeDrawing(
  vtkRenderer* renderer, vtkActor* actor, vtkSurfaceSplatDrawing& drawing)
{
  const ColorSource source = this->Internal->Source;
  drawing.Window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  drawing.Buffers = &this->Internal->Buffers;
  drawing.View = &this->Internal->View;
  drawing.RadiusScale = this->GetDrawnRadiusScale();
  drawing.Sharpness = this->Sharpness;
  drawing.Stride = this->Stride;
  drawing.Kind = this->Internal->DrawnKind;
  drawing.FacesViewer = !this->CurrentInput->GetPointData()->GetNormals();
  drawing.HiddenSide = this->Internal->HiddenSide;
  drawing.Colors = source == ColorSource::Colors || source == ColorSource::Lookup;
  drawing.Strongest = source == ColorSource::Strongest || renderer->GetSelector() != nullptr;
  drawing.NumberOfClippingPlanes = this->GetShiftedClippingPlanes(actor, drawing.ClippingPlanes);
  drawing.Key.push_back(static_cast<double>(this->VBOBuildTime.GetMTime()));
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::DrawLayer(
  vtkSurfaceSplatLayer& layer, vtkRenderer* renderer, vtkActor* actor)
{
  Internals& internal = *this->Internal;
  const bool front = &layer == &internal.FrontLayer;
  internal.FrontLayer.Activate();
  if (!front)
  {
    layer.Activate();
  }
  internal.DrawnLayer = &layer;
  // Outlines are mixed with what was drawn before, which makes sense for pictures of opaque things.
  if (renderer->GetSelector() || internal.Translucent)
  {
    this->DrawResolved(front ? Surface : Extra,
      vtkSurfaceSplatTiles::Inside | vtkSurfaceSplatTiles::Edges, renderer, actor);
  }
  else
  {
    this->DrawResolved(Surface, vtkSurfaceSplatTiles::Inside, renderer, actor);
    this->DrawResolved(Extra, vtkSurfaceSplatTiles::Edges, renderer, actor);
    this->DrawFolds(renderer, actor);
  }
  internal.DrawnLayer = nullptr;
  layer.Deactivate();
  internal.FrontLayer.Deactivate();
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::DrawFolds(vtkRenderer* renderer, vtkActor* actor)
{
  if (!this->CurrentInput->GetPointData()->GetNormals() ||
    actor->GetProperty()->GetInterpolation() == VTK_FLAT)
  {
    return; // VTK would not light them
  }
  vtkOpenGLState* state =
    vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow())->GetState();
  vtkOpenGLState::ScopedglDepthMask depthMask(state);
  state->vtkglDepthMask(GL_FALSE);
  this->DrawResolved(Folds, vtkSurfaceSplatTiles::Folds, renderer, actor);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::DrawResolved(
  int primitive, int tiles, vtkRenderer* renderer, vtkActor* actor)
{
  this->Internal->DrawnTiles = tiles;
  vtkOpenGLHelper& helper = this->Primitives[primitive];
  this->UpdateShaders(helper, renderer, actor);
  if (helper.Program)
  {
    // A program that was just built has a new vertex array, which UpdateShaders() may leave unbound.
    helper.VAO->Bind();
    vtkSurfaceSplatTiles(this->Internal->View).Draw();
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::DrawPrimitives(vtkRenderer* renderer, vtkActor* actor)
{
  vtkOpenGLHelper& primitives = this->Primitives[PrimitiveTris];
  this->UpdateShaders(primitives, renderer, actor);
  if (primitives.Program)
  {
    primitives.VAO->Bind(); // see DrawResolved()
    // Sides are those of normals, which the vertex stage knows; mirrored triangles turn theirs.
    vtkOpenGLState* state =
      vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow())->GetState();
    vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
    state->vtkglDisable(GL_CULL_FACE);
    const vtkIdType count =
      (this->Internal->Buffers.GetNumberOfParticles() + this->Stride - 1) / this->Stride;
    const bool points = this->Mode == Points;
    glDrawArrays(
      points ? GL_POINTS : GL_TRIANGLES, 0, static_cast<GLsizei>(points ? count : 3 * count));
  }
}

namespace
{
// Puts code in front of a tag and keeps the tag for the base class's own code.
void InsertBefore(vtkShader* shader, const std::string& tag, const std::string& code)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, tag, code + "\n" + tag, false);
  shader->SetSource(source);
}

// Puts code behind what the base class will put at a tag.
void InsertAfter(vtkShader* shader, const std::string& tag, const std::string& code)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, tag, tag + "\n" + code, false);
  shader->SetSource(source);
}

void Replace(vtkShader* shader, const std::string& what, const std::string& code)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, what, code);
  shader->SetSource(source);
}
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::GetShaderTemplate(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::GetShaderTemplate(shaders, renderer, actor);
  if (actor->GetShaderProperty()->HasVertexShaderCode())
  {
    return;
  }
  vtkShader* vertex = shaders[vtkShader::Vertex];
  vertex->SetSource(this->DrawsSplats() ? vtkSurfaceSplatResolveVS : vtkSurfaceSplatVS);
  Replace(vertex, "SPLAT_TILE_SIZE", std::to_string(vtkSurfaceSplatTiles::Size));
  Replace(vertex, "SPLAT_FOLDS", std::to_string(this->LastBoundBO == &this->Primitives[Folds]));
  Replace(vertex, "//Splat::Disk::Dec",
    std::string(vtkSurfaceSplatDisk) +
      "const int splatVerticesAParticle = " + (this->Mode == Points ? "1" : "3") + ";\n");
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReplaceShaderColor(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  vtkShader* fragment = shaders[vtkShader::Fragment];
  const ColorSource source = this->Internal->Source;
  const bool hasBackface = this->Internal->HasBackface;
  const bool sidesDiffer =
    hasBackface && !this->Internal->ScalarColors && !this->ColorByNormalDirection;
  const std::string mixColors =
    std::string(sidesDiffer ? "  if (splatSeenFromSide > 0.0) {\n" : "  {\n") +
    "  ambientColor = ambientIntensity * splatRgba.rgb;\n"
    "  diffuseColor = diffuseIntensity * splatRgba.rgb;\n" +
    (this->Internal->OpacityIsInColors ? "  opacity = splatRgba.a; }\n"
                                       : "  opacity = opacityUniform * splatRgba.a; }\n");
  if (this->DrawsSplats())
  {
    InsertAfter(fragment, "//VTK::Color::Impl", "  opacity *= splat.coverage;\n");
  }
  if (hasBackface)
  {
    InsertBefore(fragment, "//VTK::Color::Dec", "uniform vec2 splatOpacities; // outward, inward");
    InsertAfter(fragment, "//VTK::Color::Impl",
      "  opacity *= splatSeenFromSide > 0.0 ? splatOpacities.x : splatOpacities.y;\n");
  }
  if (this->ColorByNormalDirection)
  {
    InsertBefore(fragment, "//VTK::Color::Dec",
      "uniform vec3 splatOutwardColor;\n"
      "uniform vec3 splatInwardColor;");
    InsertAfter(fragment, "//VTK::Color::Impl",
      "  vec3 splatSide = splatSeenFromSide > 0.0 ? splatOutwardColor : splatInwardColor;\n"
      "  ambientColor = ambientIntensity * splatSide;\n"
      "  diffuseColor = diffuseIntensity * splatSide;\n");
  }
  else if (source == ColorSource::Colors && this->DrawsSplats())
  {
    InsertAfter(fragment, "//VTK::Color::Impl",
      "  vec4 splatRgba = texelFetch(splatColorSum, splat.texel, 0) / splat.weight;\n" + mixColors);
  }
  else if (source == ColorSource::Colors || source == ColorSource::Strongest)
  {
    InsertBefore(fragment, "//VTK::Color::Dec", "uniform samplerBuffer splatColor;");
    InsertAfter(fragment, "//VTK::Color::Impl",
      "  vec4 splatRgba = texelFetch(splatColor, splatParticle);\n" + mixColors);
  }
  this->Superclass::ReplaceShaderColor(shaders, renderer, actor);
  // By this the base class chooses between the two properties. Triangles and points that splats are drawn by
  // have sides of their own.
  Replace(fragment, "gl_FrontFacing", sidesDiffer ? "(splatSeenFromSide > 0.0)" : "true");
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReplaceShaderNormal(ShaderMap shaders, vtkRenderer*, vtkActor* actor)
{
  vtkShader* fragment = shaders[vtkShader::Fragment];
  const bool splats = this->DrawsSplats();
  Replace(fragment, "//VTK::Normal::Dec", splats ? "" : "flat in vec3 splatNormalVC;\n");
  std::string code = splats ? "vec3 normalVCVSOutput = splat.normalVC;\n"
                            : "vec3 normalVCVSOutput = normalize(splatNormalVC);\n";
  vtkProperty* property = actor->GetProperty();
  if (property->GetInterpolation() == VTK_PBR && property->GetCoatStrength() > 0.)
  {
    code += "  vec3 coatNormalVCVSOutput = normalVCVSOutput;\n";
  }
  Replace(fragment, "//VTK::Normal::Impl", code);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReplaceShaderPositionVC(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  vtkShader* fragment = shaders[vtkShader::Fragment];
  if (this->DrawsSplats())
  {
    const bool extra = this->LastBoundBO == &this->Primitives[Extra];
    const bool folds = this->LastBoundBO == &this->Primitives[Folds];
    Replace(fragment, "//VTK::PositionVC::Dec",
      "#define SPLAT_OUTLINE " + std::to_string(folds || (extra && !this->Internal->Translucent)) +
        "\n#define SPLAT_FOLDS " + std::to_string(folds) + "\n#define SPLAT_BACK_LAYER " +
        std::to_string(extra && this->Internal->Translucent) + "\n" + vtkSurfaceSplatResolve);
    Replace(fragment, "//Splat::Ray::Dec", vtkSurfaceSplatRay);
    Replace(fragment, "//Splat::Outline::Dec", vtkSurfaceSplatOutline);
    std::string code = "SplatSurface splat = splatResolve();\n"
                       "  vec4 vertexVC = vec4(splat.positionVC, 1.0);\n"
                       "  float splatSeenFromSide = splat.seenFrom;\n"
                       "  gl_FragDepth = splat.depth;\n";
    if (this->Internal->Source == ColorSource::Strongest ||
      this->LastSelectionState >= vtkHardwareSelector::MIN_KNOWN_PASS)
    {
      code += "  int splatParticle = splatStrongestAt(splat.texel);\n";
    }
    if (this->Internal->Source == ColorSource::Lookup)
    {
      // Under the names that VTK 9.2 and later versions read.
      code += "  vec2 tcoordVCVSOutput = splatLookupCoordinates(splat);\n"
              "  vec2 colorTCoordVCVSOutput = tcoordVCVSOutput;\n";
    }
    Replace(fragment, "//VTK::PositionVC::Impl", code);
  }
  this->Superclass::ReplaceShaderPositionVC(shaders, renderer, actor);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReplaceShaderClip(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  vtkShader* fragment = shaders[vtkShader::Fragment];
  if (this->DrawsSplats())
  {
    Replace(fragment, "//VTK::Clip::Dec", ""); // the splat passes have clipped
    Replace(fragment, "//VTK::Clip::Impl", "if (!splat.covered) discard;");
  }
  else
  {
    InsertBefore(fragment, "//VTK::Clip::Dec",
      "in vec2 splatDiskCoord;\n"
      "flat in vec4 splatClipLines[2];\n"
      "flat in int splatParticle;\n"
      "flat in float splatSeenFromSide;\n" +
        std::string(vtkSurfaceSplatEdge));
    InsertBefore(fragment, "//VTK::Clip::Impl",
      "if (dot(splatDiskCoord, splatDiskCoord) > 1.0 ||\n"
      "    splatBehindLine(splatClipLines[0], splatDiskCoord) > 0.0 ||\n"
      "    splatBehindLine(splatClipLines[1], splatDiskCoord) > 0.0) discard;");
  }
  this->Superclass::ReplaceShaderClip(shaders, renderer, actor);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReplaceShaderPicking(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  // The base class would take gl_VertexID and gl_PrimitiveID, which are not those of particles here.
  // Its cell ids count through the vertex cells in order, as particles do; where there are none, see
  // ProcessSelectorPixelBuffers().
  const char* code = nullptr;
  switch (this->LastSelectionState)
  {
    case vtkHardwareSelector::POINT_ID_LOW24:
      code = "  gl_FragData[0] = vec4(texelFetch(splatPointIds, splatParticle).rgb, 1.0);\n";
      break;
    case vtkHardwareSelector::POINT_ID_HIGH24:
      code =
        "  gl_FragData[0] = vec4(texelFetch(splatPointIds, splatParticle).a, 0.0, 0.0, 1.0);\n";
      break;
    case vtkHardwareSelector::CELL_ID_LOW24:
      code =
        "  gl_FragData[0] = vec4(vec3((ivec3(splatParticle) >> ivec3(0, 8, 16)) & 255) / 255.0, "
        "1.0);\n";
      break;
    case vtkHardwareSelector::CELL_ID_HIGH24:
      code = "  gl_FragData[0] = vec4(float(splatParticle >> 24) / 255.0, 0.0, 0.0, 1.0);\n";
      break;
    default:
      break;
  }
  if (code)
  {
    Replace(shaders[vtkShader::Fragment], "//VTK::Picking::Dec",
      "uniform samplerBuffer splatPointIds;\n");
    Replace(shaders[vtkShader::Fragment], "//VTK::Picking::Impl", code);
    Replace(shaders[vtkShader::Vertex], "//VTK::Picking::Dec", "");
    Replace(shaders[vtkShader::Vertex], "//VTK::Picking::Impl", "");
  }
  this->Superclass::ReplaceShaderPicking(shaders, renderer, actor);
}

namespace
{
// Takes the points' numbers out of the pixels of a selection by cells and puts those of cells in.
void SelectCellsAtPoints(
  vtkPolyData* input, vtkHardwareSelector* selector, const std::vector<unsigned int>& pixels)
{
  const unsigned char* low = selector->GetRawPixelBuffer(vtkHardwareSelector::CELL_ID_LOW24);
  const unsigned char* high = selector->GetRawPixelBuffer(vtkHardwareSelector::CELL_ID_HIGH24);
  const int pass = selector->GetCurrentPass();
  const int shift = pass == vtkHardwareSelector::CELL_ID_LOW24 ? 0 : 24;
  const bool byCells = selector->GetFieldAssociation() == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  vtkStaticCellLinksTemplate<vtkIdType> links;
  links.BuildLinks(input);
  for (unsigned int pixel : pixels)
  {
    const vtkIdType point = low[pixel] | low[pixel + 1] << 8 | low[pixel + 2] << 16 |
      static_cast<vtkIdType>(high ? high[pixel] : 0) << 24;
    const bool used = point < input->GetNumberOfPoints() && links.GetNcells(point) > 0;
    const vtkIdType cell = used ? links.GetCells(point)[0] : 0;
    for (int byte = 0; byte < 3; ++byte)
    {
      selector->GetPixelBuffer(pass)[pixel + byte] =
        static_cast<unsigned char>((cell >> (shift + 8 * byte)) & 0xff);
    }
    if (!used && byCells)
    {
      std::fill_n(selector->GetPixelBuffer(vtkHardwareSelector::ACTOR_PASS) + pixel, 3, 0);
    }
  }
}
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ProcessSelectorPixelBuffers(
  vtkHardwareSelector* selector, std::vector<unsigned int>& pixels, vtkProp* prop)
{
  const int pass = selector->GetCurrentPass();
  const bool cells =
    pass == vtkHardwareSelector::CELL_ID_LOW24 || pass == vtkHardwareSelector::CELL_ID_HIGH24;
  if (cells && this->Internal->CellIds.empty())
  {
    SelectCellsAtPoints(this->CurrentInput, selector, pixels);
  }
  else
  {
    this->Superclass::ProcessSelectorPixelBuffers(selector, pixels, prop);
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReplaceShaderValues(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
  if (this->DrawsSplats())
  {
    // Offsets and render passes that ask for the depth of the fragment mean that of the surface.
    Replace(shaders[vtkShader::Fragment], "gl_FragCoord.z", "gl_FragDepth");
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, renderer, actor);

  vtkShaderProgram* program = cellBO.Program;
  this->Internal->Buffers.SetSamplers(program);
  this->Internal->View.SetUniforms(program);
  if (const vtkSurfaceSplatLayer* layer = this->Internal->DrawnLayer)
  {
    const double diameter = 2. * this->GetDrawnRadiusScale() *
      this->Internal->Buffers.GetMeanRadius() * this->Internal->View.GetScale();
    layer->SetSamplers(program, this->Internal->FrontLayer);
    // Pixels with surface have at least twice this summed weight, others none (see the visibility pass).
    program->SetUniformf("splatLeastWeight",
      static_cast<float>(0.5 * vtkSurfaceSplatPrimitives::GetLeastWeight(this->Sharpness)));
    program->SetUniformf("splatLayerDistance", static_cast<float>(diameter));
    program->SetUniformf("splatJump", static_cast<float>(5. * diameter));
    vtkSurfaceSplatTiles(this->Internal->View).SetUniforms(program, this->Internal->DrawnTiles);
  }
  program->SetUniformf("splatRadiusScale", static_cast<float>(this->GetDrawnRadiusScale()));
  program->SetUniformi("splatStride", this->Stride);
  program->SetUniformi("splatKind", this->Internal->DrawnKind);
  program->SetUniformi("splatSheet", -1);
  program->SetUniformf("splatHiddenSide", static_cast<float>(this->Internal->HiddenSide));
  program->SetUniformi(
    "splatFacesViewer", this->CurrentInput->GetPointData()->GetNormals() ? 0 : 1);
  if (this->ColorByNormalDirection)
  {
    program->SetUniform3f("splatOutwardColor", this->OutwardColor);
    program->SetUniform3f("splatInwardColor", this->InwardColor);
  }
  if (program->IsUniformUsed("clipPlanes"))
  {
    float planes[6][4] = {};
    this->GetShiftedClippingPlanes(actor, planes);
    program->SetUniform4fv("clipPlanes", 6, planes);
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::SetPropertyShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetPropertyShaderParameters(cellBO, renderer, actor);
  vtkProperty* backface = actor->GetBackfaceProperty();
  if (!backface)
  {
    return;
  }
  // The base class would leave out the backface property's opacity where there are scalars.
  const Internals& internal = *this->Internal;
  const bool counted = internal.OpacityIsInColors && !this->ColorByNormalDirection;
  const double outward = counted ? 1. : actor->GetProperty()->GetOpacity();
  const float opacities[2] = { static_cast<float>(outward),
    static_cast<float>(backface->GetOpacity()) };
  vtkShaderProgram* program = cellBO.Program;
  program->SetUniform2f("splatOpacities", opacities);
  program->SetUniformf("opacityUniform", 1.f);
  if (program->IsUniformUsed("opacityUniformBF"))
  {
    program->SetUniformf("opacityUniformBF", 1.f);
  }
}

//------------------------------------------------------------------------------
int vtkSurfaceSplatMapper::GetShiftedClippingPlanes(vtkActor* actor, float planes[6][4])
{
  const int count = std::min(this->GetNumberOfClippingPlanes(), 6); // the base class says so
  const std::array<double, 3>& origin = this->Internal->Buffers.GetOrigin();
  GetModelToWorld(actor, this->TempMatrix4);
  for (int i = 0; i < count; ++i)
  {
    double plane[4];
    this->GetClippingPlaneInDataCoords(this->TempMatrix4, i, plane);
    plane[3] += vtkMath::Dot(plane, origin.data());
    std::copy_n(plane, 4, planes[i]);
  }
  return count;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::SetCameraShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetCameraShaderParameters(cellBO, renderer, actor);

  // Again with the shift of the particles.
  vtkShaderProgram* program = cellBO.Program;
  program->SetUniformMatrix("MCDCMatrix", this->Internal->View.MCDC);
  if (program->IsUniformUsed("MCVCMatrix"))
  {
    program->SetUniformMatrix("MCVCMatrix", this->Internal->View.MCVC);
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* modes[] = { "Splats", "Disks", "Points" };
  os << indent << "Mode: " << modes[this->Mode] << "\n";
  os << indent << "Sharpness: " << this->Sharpness << "\n";
  os << indent << "Stride: " << this->Stride << "\n";
  os << indent << "RadiusArrayName: " << (this->RadiusArrayName ? this->RadiusArrayName : "(none)")
     << "\n";
  os << indent
     << "CellColorArrayName: " << (this->CellColorArrayName ? this->CellColorArrayName : "(none)")
     << "\n";
  os << indent << "RadiusScale: " << this->RadiusScale << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "ColorByNormalDirection: " << (this->ColorByNormalDirection ? "On" : "Off")
     << "\n";
  os << indent << "OutwardColor: " << this->OutwardColor[0] << " " << this->OutwardColor[1] << " "
     << this->OutwardColor[2] << "\n";
  os << indent << "InwardColor: " << this->InwardColor[0] << " " << this->InwardColor[1] << " "
     << this->InwardColor[2] << "\n";
}
