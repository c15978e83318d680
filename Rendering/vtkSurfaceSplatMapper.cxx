#include "OpenGL/Functions.h" // before everything that may include an OpenGL header

#include "vtkSurfaceSplatMapper.h"

#include "Drawing/SplatDrawing.h"
#include "Drawing/SplatView.h"
#include "Particles/ParticleInput.h"
#include "Particles/Selection.h"
#include "Particles/UploadedParticles.h"
#include "Passes/IsovalueLayers.h"
#include "Passes/PictureTiles.h"
#include "Shading/ShaderText.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
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
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace
{
using Source = hop::SplatColoring::Source;

// The base class keeps a program for every kind of primitive. The programs of triangles and of strips are lit alike;
// the one of strips draws outlines if the surface is opaque, otherwise the back layer.
constexpr int Surface = vtkOpenGLPolyDataMapper::PrimitiveTris;
constexpr int Extra = vtkOpenGLPolyDataMapper::PrimitiveTriStrips;
// The program of lines draws outlines where the surface lies in front of itself. Lines are lit where there are normals.
constexpr int Folds = vtkOpenGLPolyDataMapper::PrimitiveLines;

// What MapScalars() says where the scalars are from.
constexpr int Cells = 1;
constexpr int Field = 2;

// Number of isovalues up to which each has translucent layers of its own. The time of a picture grows with the number;
// with a smaller one inner surfaces are missing more often. Chosen by experiment.
constexpr int MaximumNumberOfLayeredIsovalues = 8;

vtkOpenGLRenderWindow* WindowOf(vtkRenderer* renderer)
{
  return vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
}

}

struct vtkSurfaceSplatMapper::Internals
{
  hop::UploadedParticles Particles;
  hop::SplatView View;
  hop::IsovalueLayers Layers;
  const hop::SplatDrawing* Drawing = nullptr; // set while it goes on, as are the next two members
  hop::SplatLayer* DrawnLayer = nullptr;
  const hop::SplatLayer* FrontLayer = nullptr; // of the same isovalue
  int DrawnTiles = 0;
  bool Translucent = false;
  hop::SplatColoring Coloring;
  bool DrawsEdges = false;  // lines are drawn where cells end
  bool HasGhosts = false;   // ghosts are blended
  bool HasBackface = false; // the shaders know of a backface property
  bool CannotSplat = false; // the driver has no floating-point targets

  bool SaidNoNormals = false;
  bool SaidNoRadius = false;
  bool SaidWarped = false;
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
  this->Internal->Particles.ReleaseGraphicsResources(window);
  this->Internal->Layers.Release(0, window);
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
    this->SetBlendGhosts(other->GetBlendGhosts());
    this->SetLargestRadiusElsewhere(other->GetLargestRadiusElsewhere());
    this->SetColorByNormalDirection(other->GetColorByNormalDirection());
    this->SetOutwardColor(other->GetOutwardColor());
    this->SetInwardColor(other->GetInwardColor());
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------
hop::ParticleInput vtkSurfaceSplatMapper::Describe(vtkPolyData* input) const
{
  return { input, this->RadiusArrayName, this->CellColorArrayName, this->Radius };
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
  if (input)
  {
    this->Describe(input).GetDiskBounds(
      this->GetDrawnRadiusScale(), this->LargestRadiusElsewhere, bounds);
  }
}

//------------------------------------------------------------------------------
double vtkSurfaceSplatMapper::GetLargestRadius(vtkPolyData* input)
{
  return this->Describe(input).GetLargestRadius();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDoubleArray> vtkSurfaceSplatMapper::GetDisks(vtkPolyData* input)
{
  return this->Describe(input).GetDisks(this->RadiusScale);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::UpdateBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  // The base class would go on to index buffers of the selected cells, which disks do not use.
  const bool colorsAreOld = this->Describe(this->CurrentInput).GetCellColors() &&
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
    static_cast<size_t>(std::max(
      this->Internal->Particles.Buffers.GetNumberOfParticles(), input->GetNumberOfCells()));
  this->VBOBuildTime.Modified();
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::WarnOfMissingArrays(vtkPolyData* input)
{
  const hop::ParticleInput particles = this->Describe(input);
  const bool empty = input->GetNumberOfPoints() == 0;
  const bool noNormals = !empty && !particles.HasNormals();
  const bool noRadius = !empty && !particles.GetRadii();
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
      << "' with their radii: all have the radius " << particles.GetFallbackRadius() << ".");
  }
  this->Internal->SaidNoNormals = noNormals;
  this->Internal->SaidNoRadius = noRadius;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::UploadParticles(vtkRenderer* renderer, vtkPolyData* input)
{
  Internals& gpu = *this->Internal;
  const auto report = gpu.Particles.Upload(WindowOf(renderer), this->Describe(input));
  if (!report)
  {
    return;
  }
  const vtkIdType drawn = gpu.Particles.Buffers.GetNumberOfParticles();
  if (drawn < report->Particles)
  {
    vtkWarningMacro("This graphics driver addresses only the first "
      << drawn << " of " << report->Particles << " particles; the others are not drawn.");
  }
  if (report->Warped && !gpu.SaidWarped)
  {
    vtkWarningMacro("The particles have been moved, and not all of them by one affine map such as "
                    "a rotation: their "
                    "splats are drawn flat and reach over edges, as curvatures and edges are those "
                    "of the surface "
                    "before. Move the grid instead, and compute the particles on it.");
  }
  gpu.SaidWarped = report->Warped;
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatMapper::HasOpaqueGeometry()
{
  vtkPolyData* input = this->GetInput();
  return !this->Superclass::HasTranslucentPolygonalGeometry() &&
    !(input && this->Describe(input).HasOnlyTranslucentCells());
}

bool vtkSurfaceSplatMapper::HasTranslucentPolygonalGeometry()
{
  vtkPolyData* input = this->GetInput();
  return this->Superclass::HasTranslucentPolygonalGeometry() ||
    (input && this->Describe(input).HasTranslucentCells());
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::UploadColors(vtkRenderer* renderer, vtkActor* actor)
{
  // Colours are looked up between particles only, so that disks and points need none of it. Cells' own colours are
  // no numbers to be looked up; and the shaders of the base class want coordinates wherever it has a texture for them.
  hop::UploadedParticles& particles = this->Internal->Particles;
  vtkDataArray* cellColors =
    particles.AreCells() ? this->Describe(this->CurrentInput).GetCellColors() : nullptr;
  const vtkTypeBool interpolate = this->InterpolateScalarsBeforeMapping;
  this->InterpolateScalarsBeforeMapping =
    interpolate && this->DrawsSplats() && !cellColors && this->HasScalars(this->CurrentInput);
  int source = 0;
  vtkUnsignedCharArray* colors = this->MapScalars(this->CurrentInput, 1.0, source);
  this->InterpolateScalarsBeforeMapping = interpolate;

  const bool clippedBefore = particles.GetClipsColors();
  particles.ForgetColors();
  hop::SplatColoring coloring;
  coloring.OpacityIsInColors = cellColors != nullptr;
  coloring.OfScalars = colors || this->ColorCoordinates;
  const hop::UploadedParticles::ScalarColors scalars{ colors, source == Cells,
    source == Field ? this->FieldDataTupleId : -1 };
  if (this->ColorCoordinates)
  {
    this->UploadLookupCoordinates(renderer);
    coloring.From = Source::Lookup;
  }
  else if (particles.UploadColors(WindowOf(renderer), scalars, cellColors, actor->GetProperty()))
  {
    const bool categorical = colors && this->LookupTable && this->LookupTable->GetIndexedLookup() &&
      this->ColorMode != VTK_COLOR_MODE_DIRECT_SCALARS;
    coloring.From = categorical ? Source::Strongest : Source::Colors;
  }
  if (coloring != this->Internal->Coloring || clippedBefore != particles.GetClipsColors())
  {
    this->Internal->Coloring = coloring;
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
bool vtkSurfaceSplatMapper::HasScalars(vtkPolyData* input)
{
  int cells = 0;
  vtkAbstractArray* scalars = vtkAbstractMapper::GetAbstractScalars(
    input, this->ScalarMode, this->ArrayAccessMode, this->ArrayId, this->ArrayName, cells);
  return scalars && scalars->GetNumberOfTuples() > 0 &&
    this->Internal->Particles.Buffers.GetNumberOfParticles() > 0;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::UploadLookupCoordinates(vtkRenderer* renderer)
{
  // The base class binds this texture, of one colour a column, whenever there is a ColorTextureMap.
  if (!this->InternalColorTexture)
  {
    this->InternalColorTexture = vtkOpenGLTexture::New();
    this->InternalColorTexture->RepeatOff();
  }
  this->InternalColorTexture->SetInputData(this->ColorTextureMap);
  this->Internal->Particles.UploadLookup(
    WindowOf(renderer), vtkFloatArray::SafeDownCast(this->ColorCoordinates));
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  Internals& internal = *this->Internal;
  if (internal.Particles.Buffers.GetNumberOfParticles() == 0)
  {
    return;
  }
  this->DrawingVertices = false;
  this->DrawingSelection = false;
  if (this->PointPicking)
  {
    // The base class draws points without depth, on top of the surface that they belong to. Splats are the surface
    // itself, and the nearest one must be seen.
    WindowOf(renderer)->GetState()->vtkglDepthMask(GL_TRUE);
  }
  double bounds[6];
  this->GetDiskBounds(this->CurrentInput, bounds);
  internal.View.Update(renderer, actor, internal.Particles.Buffers.GetOrigin(), bounds);
  if (internal.View.GetWidth() == 0 || internal.View.GetHeight() == 0)
  {
    return; // there are no framebuffers without pixels
  }
  const bool hasBackface = actor->GetBackfaceProperty() != nullptr;
  const bool drawsEdges =
    actor->GetProperty()->GetEdgeVisibility() && internal.Particles.Buffers.GetHasBorders();
  // Of ghosts, every rank would leave out others where particles are thinned out.
  const bool hasGhosts = internal.Particles.Buffers.GetHasGhosts() && this->BlendGhosts &&
    this->DrawsSplats() && this->Stride == 1;
  if (hasBackface != internal.HasBackface || drawsEdges != internal.DrawsEdges ||
    hasGhosts != internal.HasGhosts)
  {
    internal.HasGhosts = hasGhosts;
    internal.HasBackface = hasBackface;
    internal.DrawsEdges = drawsEdges;
    this->ForgetShaders();
  }
  const hop::SplatDrawing drawing = this->DescribeDrawing(renderer, actor);
  internal.Drawing = &drawing;
  internal.Particles.Buffers.Activate();
  if (!this->DrawsSplats() || !this->DrawSplats(renderer, actor))
  {
    this->DrawPrimitives(renderer, actor);
  }
  internal.Particles.Buffers.Deactivate();
  internal.Drawing = nullptr;
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatMapper::DrawsSplats() const
{
  return this->Mode == Splats && !this->Internal->CannotSplat;
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatMapper::DrawSplats(vtkRenderer* renderer, vtkActor* actor)
{
  const bool translucent = actor->IsRenderingTranslucentPolygonalGeometry() != 0;
  if (translucent != this->Internal->Translucent)
  {
    this->Internal->Translucent = translucent;
    this->ForgetShaders();
  }
  if (!actor->HasTranslucentPolygonalGeometry())
  {
    this->Internal->Layers.Release(1, renderer->GetRenderWindow());
  }
  // Translucent surfaces of different isovalues shine through each other: each has layers of its own.
  const int allIsovalues = this->Internal->Particles.Buffers.GetNumberOfIsovalues();
  const int isovalues =
    translucent && allIsovalues <= MaximumNumberOfLayeredIsovalues ? allIsovalues : 1;
  for (int isovalue = 0; isovalue < isovalues; ++isovalue)
  {
    hop::SplatDrawing drawing = *this->Internal->Drawing;
    if (isovalues > 1)
    {
      drawing.Isovalue = isovalue;
    }
    hop::IsovalueLayers::Pair& layers = this->Internal->Layers.Of(isovalue, this->Internal->View);
    if ((translucent && !layers.Back.Update(drawing)) || !layers.Front.Update(drawing))
    {
      vtkWarningMacro("This graphics driver cannot draw into floating-point textures: the "
                      "particles are drawn as disks.");
      this->Internal->CannotSplat = true;
      this->UploadColors(renderer, actor);
      this->ForgetShaders();
      return false;
    }
    // The far layer is drawn first, for blending without depth peeling.
    if (translucent)
    {
      this->DrawLayer(layers.Back, layers.Front, renderer, actor);
    }
    this->DrawLayer(layers.Front, layers.Front, renderer, actor);
  }
  return true;
}

//------------------------------------------------------------------------------
hop::SplatDrawing vtkSurfaceSplatMapper::DescribeDrawing(vtkRenderer* renderer, vtkActor* actor)
{
  hop::SplatDrawing drawing;
  const Source source = this->Internal->Coloring.From;
  const hop::ParticleInput input = this->Describe(this->CurrentInput);
  drawing.ChooseParticles(renderer, actor, input.HasTranslucentCells());
  drawing.Window = WindowOf(renderer);
  drawing.Buffers = &this->Internal->Particles.Buffers;
  drawing.View = &this->Internal->View;
  drawing.RadiusScale = this->GetDrawnRadiusScale();
  drawing.Sharpness = this->Sharpness;
  drawing.Stride = this->Stride;
  drawing.FacesViewer = !input.HasNormals();
  drawing.Colors = source == Source::Colors || source == Source::Lookup;
  drawing.Ghosts = this->Internal->HasGhosts;
  drawing.Strongest =
    drawing.Ghosts || source == Source::Strongest || renderer->GetSelector() != nullptr;
  drawing.ClipsColors = this->Internal->Particles.GetClipsColors();
  drawing.ColorGradients = drawing.ClipsColors && source == Source::Lookup;
  drawing.EdgeWidth = this->Internal->DrawsEdges ? actor->GetProperty()->GetLineWidth() : 0.;
  drawing.NumberOfClippingPlanes = this->GetShiftedClippingPlanes(actor, drawing.ClippingPlanes);
  drawing.Key.push_back(static_cast<double>(this->VBOBuildTime.GetMTime()));
  return drawing;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::DrawLayer(
  hop::SplatLayer& layer, hop::SplatLayer& frontLayer, vtkRenderer* renderer, vtkActor* actor)
{
  Internals& internal = *this->Internal;
  const bool front = &layer == &frontLayer;
  frontLayer.Activate();
  if (!front)
  {
    layer.Activate();
  }
  internal.DrawnLayer = &layer;
  internal.FrontLayer = &frontLayer;
  // Outlines are mixed with what was drawn before, which makes sense for opaque surfaces in pictures only.
  if (renderer->GetSelector() || internal.Translucent)
  {
    this->DrawResolved(front ? Surface : Extra,
      hop::PictureTiles::Inside | hop::PictureTiles::Edges, renderer, actor);
  }
  else
  {
    this->DrawResolved(Surface, hop::PictureTiles::Inside, renderer, actor);
    this->DrawResolved(Extra, hop::PictureTiles::Edges, renderer, actor);
    this->DrawFolds(renderer, actor);
  }
  internal.DrawnLayer = nullptr;
  internal.FrontLayer = nullptr;
  layer.Deactivate();
  frontLayer.Deactivate();
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::DrawFolds(vtkRenderer* renderer, vtkActor* actor)
{
  if (this->Internal->Drawing->FacesViewer || actor->GetProperty()->GetInterpolation() == VTK_FLAT)
  {
    return; // VTK would not light lines
  }
  vtkOpenGLState* state = WindowOf(renderer)->GetState();
  vtkOpenGLState::ScopedglDepthMask depthMask(state);
  state->vtkglDepthMask(GL_FALSE);
  this->DrawResolved(Folds, hop::PictureTiles::Folds, renderer, actor);
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
    hop::PictureTiles(this->Internal->View).Draw();
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
    // The vertex stage culls by the sides of normals. The sides of triangles are swapped where an actor mirrors them.
    vtkOpenGLState* state = WindowOf(renderer)->GetState();
    vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
    state->vtkglDisable(GL_CULL_FACE);
    const auto [first, end] = this->Internal->Drawing->GetDrawnRange();
    const vtkIdType count = end - first;
    const bool points = this->Mode == Points;
    glDrawArrays(
      points ? GL_POINTS : GL_TRIANGLES, 0, static_cast<GLsizei>(points ? count : 3 * count));
  }
}

//------------------------------------------------------------------------------
hop::ShaderText vtkSurfaceSplatMapper::DescribeShaders(vtkActor* actor) const
{
  using Part = hop::ShaderText::Part;
  const bool translucent = this->Internal->Translucent;
  const bool extra = this->LastBoundBO == &this->Primitives[Extra];
  const bool folds = this->LastBoundBO == &this->Primitives[Folds];
  vtkProperty* property = actor->GetProperty();
  hop::ShaderText shaders;
  shaders.DrawsSplats = this->DrawsSplats();
  shaders.DrawsPoints = this->Mode == Points;
  shaders.Drawn = folds ? Part::Folds
    : !extra            ? Part::Surface
    : translucent       ? Part::BackLayer
                        : Part::Outline;
  shaders.Coloring = this->Internal->Coloring;
  shaders.ClipsColors = this->Internal->Particles.GetClipsColors();
  shaders.DrawsEdges = this->Internal->DrawsEdges && this->DrawsSplats();
  shaders.ColorsBySide = this->ColorByNormalDirection;
  shaders.HasBackface = this->Internal->HasBackface;
  shaders.HasGhosts = this->Internal->HasGhosts;
  shaders.HasCoat = property->GetInterpolation() == VTK_PBR && property->GetCoatStrength() > 0.;
  shaders.SelectionPass = this->LastSelectionState;
  return shaders;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::GetShaderTemplate(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::GetShaderTemplate(shaders, renderer, actor);
  if (!actor->GetShaderProperty()->HasVertexShaderCode())
  {
    this->DescribeShaders(actor).SetVertexStage(shaders[vtkShader::Vertex]);
  }
}

void vtkSurfaceSplatMapper::ReplaceShaderColor(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  const hop::ShaderText ours = this->DescribeShaders(actor);
  ours.InsertColor(shaders[vtkShader::Fragment]);
  this->Superclass::ReplaceShaderColor(shaders, renderer, actor);
  ours.ReplaceSide(shaders[vtkShader::Fragment]);
}

void vtkSurfaceSplatMapper::ReplaceShaderNormal(ShaderMap shaders, vtkRenderer*, vtkActor* actor)
{
  this->DescribeShaders(actor).ReplaceNormal(shaders[vtkShader::Fragment]);
}

void vtkSurfaceSplatMapper::ReplaceShaderPositionVC(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->DescribeShaders(actor).ReplacePosition(shaders[vtkShader::Fragment]);
  this->Superclass::ReplaceShaderPositionVC(shaders, renderer, actor);
}

void vtkSurfaceSplatMapper::ReplaceShaderClip(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->DescribeShaders(actor).InsertClip(shaders[vtkShader::Fragment]);
  this->Superclass::ReplaceShaderClip(shaders, renderer, actor);
}

void vtkSurfaceSplatMapper::ReplaceShaderPicking(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->DescribeShaders(actor).ReplacePicking(shaders);
  this->Superclass::ReplaceShaderPicking(shaders, renderer, actor);
}

void vtkSurfaceSplatMapper::ReplaceShaderValues(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
  this->DescribeShaders(actor).ReplaceDepth(shaders[vtkShader::Fragment]);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ProcessSelectorPixelBuffers(
  vtkHardwareSelector* selector, std::vector<unsigned int>& pixels, vtkProp* prop)
{
  const int pass = selector->GetCurrentPass();
  const bool cells =
    pass == vtkHardwareSelector::CELL_ID_LOW24 || pass == vtkHardwareSelector::CELL_ID_HIGH24;
  vtkPolyData* input = this->CurrentInput;
  auto* ranks = vtkUnsignedIntArray::SafeDownCast(input && this->ProcessIdArrayName
      ? input->GetPointData()->GetArray(this->ProcessIdArrayName)
      : nullptr);
  if (pass == vtkHardwareSelector::PROCESS_PASS && ranks && selector->GetUseProcessIdFromData())
  {
    // The base class leaves the rank that draws (VTK 9.2).
    hop::SelectRanks(ranks, selector, pixels);
  }
  else if (cells && input && !this->Internal->Particles.AreCells())
  {
    vtkDataArray* ids =
      this->CellIdArrayName ? input->GetCellData()->GetArray(this->CellIdArrayName) : nullptr;
    hop::SelectCells(input, vtkIdTypeArray::SafeDownCast(ids), selector, pixels);
  }
  else
  {
    this->Superclass::ProcessSelectorPixelBuffers(selector, pixels, prop);
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, renderer, actor);

  const hop::SplatDrawing& drawing = *this->Internal->Drawing;
  vtkShaderProgram* program = cellBO.Program;
  drawing.SetUniforms(program);
  if (const hop::SplatLayer* layer = this->Internal->DrawnLayer)
  {
    layer->SetUniforms(program, *this->Internal->FrontLayer, drawing);
    hop::PictureTiles(this->Internal->View).SetUniforms(program, this->Internal->DrawnTiles);
  }
  if (drawing.EdgeWidth > 0. && program->IsUniformUsed("splatEdgeColor"))
  {
    program->SetUniform3f("splatEdgeColor", actor->GetProperty()->GetEdgeColor());
  }
  if (this->ColorByNormalDirection)
  {
    program->SetUniform3f("splatOutwardColor", this->OutwardColor);
    program->SetUniform3f("splatInwardColor", this->InwardColor);
  }
  if (program->IsUniformUsed("clipPlanes"))
  {
    program->SetUniform4fv("clipPlanes", 6, drawing.ClippingPlanes);
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
  const bool counted = internal.Coloring.OpacityIsInColors && !this->ColorByNormalDirection;
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
  const int count = std::min(this->GetNumberOfClippingPlanes(), 6); // the limit of the base class
  const std::array<double, 3>& origin = this->Internal->Particles.Buffers.GetOrigin();
  hop::GetModelToWorld(actor, this->TempMatrix4);
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

  // The base class's matrices know nothing of the particles' shift.
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
  os << indent << "BlendGhosts: " << (this->BlendGhosts ? "On" : "Off") << "\n";
  os << indent << "LargestRadiusElsewhere: " << this->LargestRadiusElsewhere << "\n";
  os << indent << "ColorByNormalDirection: " << (this->ColorByNormalDirection ? "On" : "Off")
     << "\n";
  os << indent << "OutwardColor: " << this->OutwardColor[0] << " " << this->OutwardColor[1] << " "
     << this->OutwardColor[2] << "\n";
  os << indent << "InwardColor: " << this->InwardColor[0] << " " << this->InwardColor[1] << " "
     << this->InwardColor[2] << "\n";
}
