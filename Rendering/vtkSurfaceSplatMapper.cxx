#include "vtkSurfaceSplatGL.h" // before everything that may include an OpenGL header

#include "vtkSurfaceSplatMapper.h"

#include "vtkHardwareSelector.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLActor.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkShaderProperty.h"
#include "vtkSurfaceSplatBuffers.h"
#include "vtkSurfaceSplatParticles.h"
#include "vtkSurfaceSplatVS.h"
#include "vtkTextureObject.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <string>

struct vtkSurfaceSplatMapper::Internals
{
  vtkSurfaceSplatBuffers Buffers;
  std::vector<vtkIdType> PointIds; // of the particles on the GPU, to colour them
  std::vector<vtkIdType> CellIds;

  // What the particles on the GPU were made from.
  vtkPolyData* Input = nullptr; // compared, never dereferenced
  vtkMTimeType InputTime = 0;
  std::string RadiusArrayName;
  double FallbackRadius = 0.;

  bool SaidNoNormals = false;
  bool SaidNoRadius = false;
};

vtkStandardNewMacro(vtkSurfaceSplatMapper);

//------------------------------------------------------------------------------
vtkSurfaceSplatMapper::vtkSurfaceSplatMapper()
  : Internal(new Internals)
{
  this->SetRadiusArrayName("Radius");
}

vtkSurfaceSplatMapper::~vtkSurfaceSplatMapper()
{
  // The base class would release its own resources only: its destructor no longer sees ours.
  this->ReleaseGraphicsResources(nullptr);
  this->SetRadiusArrayName(nullptr);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  // The base class makes the right context current and then calls this method again, so that the
  // buffers are released in the inner call; after that there is nothing left to release.
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internal->Buffers.ReleaseGraphicsResources(window);
  this->Internal->Input = nullptr;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* other = vtkSurfaceSplatMapper::SafeDownCast(mapper))
  {
    this->SetRadiusArrayName(other->GetRadiusArrayName());
    this->SetRadiusScale(other->GetRadiusScale());
    this->SetRadius(other->GetRadius());
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
  double size[3] = { 0., 0., 0. };
  for (int axis = 0; axis < 3; ++axis)
  {
    double range[2];
    input->GetPoints()->GetData()->GetFiniteRange(range, axis);
    size[axis] = std::max(range[1] - range[0], 0.);
  }
  const double area = 2. * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
  const double length = size[0] + size[1] + size[2];
  const double count = static_cast<double>(input->GetNumberOfPoints());
  if (area > 0.)
  {
    // Hexagons of spacing h have the area (sqrt(3)/2) h^2 and are covered from 0.577 h on; three
    // quarters leave some room for unevenness.
    return 0.75 * std::sqrt(2. * area / (std::sqrt(3.) * count));
  }
  return length > 0. ? length / count : 1.;
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
  const double margin = this->RadiusScale * std::max(range[1], 0.);
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
  if (this->GetNeedToRebuildBufferObjects(renderer, actor))
  {
    this->BuildBufferObjects(renderer, actor);
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::BuildBufferObjects(vtkRenderer* renderer, vtkActor*)
{
  vtkPolyData* input = this->CurrentInput;
  this->WarnOfMissingArrays(input);
  this->UploadParticles(renderer, input);
  this->UploadColors(renderer, input);

  // No index buffer is used, but the base class counts primitives by it, for selections.
  for (auto& primitive : this->Primitives)
  {
    primitive.IBO->IndexCount = 0;
  }
  this->Primitives[PrimitiveTris].IBO->IndexCount =
    3 * static_cast<size_t>(this->Internal->Buffers.GetNumberOfParticles());
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
  const std::string radiusName = this->RadiusArrayName ? this->RadiusArrayName : "";
  if (gpu.Input == input && gpu.InputTime == input->GetMTime() &&
    gpu.RadiusArrayName == radiusName && gpu.FallbackRadius == this->Radius)
  {
    return;
  }
  vtkSurfaceSplatParticles particles =
    vtkSurfaceSplatParticles::FromPolyData(input, this->GetRadiusArray(input),
      this->GetFallbackRadius(input), input->GetPointData()->GetNormals());
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
  gpu.Input = input;
  gpu.InputTime = input->GetMTime();
  gpu.RadiusArrayName = radiusName;
  gpu.FallbackRadius = this->Radius;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::UploadColors(vtkRenderer* renderer, vtkPolyData* input)
{
  // The base class's shader code for cell colours looks one RGBA up per primitive: just what a
  // particle is, whether its colour comes from a point or from a cell array.
  enum ColorSource
  {
    Points,
    Cells,
    Field
  }; // what MapScalars() returns
  int source = Points;
  vtkUnsignedCharArray* colors = this->MapScalars(input, 1.0, source);
  const std::vector<vtkIdType>& ids =
    source == Cells ? this->Internal->CellIds : this->Internal->PointIds;
  const vtkIdType count = this->Internal->Buffers.GetNumberOfParticles();
  this->HaveCellScalars = colors && colors->GetNumberOfComponents() == 4 &&
    colors->GetNumberOfTuples() > 0 && count > 0 && static_cast<vtkIdType>(ids.size()) >= count;
  if (!this->HaveCellScalars)
  {
    return;
  }

  const bool single = source == Field && this->FieldDataTupleId >= 0;
  const vtkIdType last = colors->GetNumberOfTuples() - 1;
  std::vector<unsigned char> rgba(4 * count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const vtkIdType id = single ? this->FieldDataTupleId : ids[i];
    colors->GetTypedTuple(std::min(id, last), &rgba[4 * i]);
  }
  if (!this->CellScalarTexture)
  {
    this->CellScalarTexture = vtkTextureObject::New();
    this->CellScalarBuffer = vtkOpenGLBufferObject::New();
    this->CellScalarBuffer->SetType(vtkOpenGLBufferObject::TextureBuffer);
  }
  this->CellScalarTexture->SetContext(
    vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()));
  this->CellScalarBuffer->Upload(rgba, vtkOpenGLBufferObject::TextureBuffer);
  this->CellScalarTexture->CreateTextureBuffer(
    static_cast<unsigned int>(count), 4, VTK_UNSIGNED_CHAR, this->CellScalarBuffer);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  vtkSurfaceSplatBuffers& buffers = this->Internal->Buffers;
  if (buffers.GetNumberOfParticles() == 0)
  {
    return;
  }
  this->DrawingVertices = false;
  this->DrawingSelection = false;
  if (this->PointPicking)
  {
    // For points the base class draws without depth, on top of the surface they belong to; disks
    // are that surface, and the nearest one must win.
    vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow())
      ->GetState()
      ->vtkglDepthMask(GL_TRUE);
  }
  vtkOpenGLHelper& disks = this->Primitives[PrimitiveTris];
  buffers.Activate();
  this->UpdateShaders(disks, renderer, actor);
  if (disks.Program)
  {
    // A program that was just built has a new vertex array, which UpdateShaders() may leave unbound.
    disks.VAO->Bind();
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * buffers.GetNumberOfParticles()));
  }
  buffers.Deactivate();
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::GetShaderTemplate(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::GetShaderTemplate(shaders, renderer, actor);
  if (!actor->GetShaderProperty()->HasVertexShaderCode())
  {
    shaders[vtkShader::Vertex]->SetSource(vtkSurfaceSplatVS);
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

void Replace(vtkShader* shader, const std::string& tag, const std::string& code)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, tag, code);
  shader->SetSource(source);
}
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReplaceShaderColor(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  if (this->ColorByNormalDirection)
  {
    vtkShader* fragment = shaders[vtkShader::Fragment];
    InsertBefore(fragment, "//VTK::Color::Dec",
      "flat in float splatSeenFromSide;\n"
      "uniform vec3 splatOutwardColor;\n"
      "uniform vec3 splatInwardColor;");
    // After the base class's code, which declares the two colours and the opacity.
    Replace(fragment, "//VTK::Color::Impl",
      "//VTK::Color::Impl\n"
      "  vec3 splatSide = splatSeenFromSide > 0.0 ? splatOutwardColor : splatInwardColor;\n"
      "  ambientColor = ambientIntensity * splatSide;\n"
      "  diffuseColor = diffuseIntensity * splatSide;\n");
  }
  this->Superclass::ReplaceShaderColor(shaders, renderer, actor);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReplaceShaderNormal(ShaderMap shaders, vtkRenderer*, vtkActor* actor)
{
  vtkShader* fragment = shaders[vtkShader::Fragment];
  Replace(fragment, "//VTK::Normal::Dec", "flat in vec3 splatNormalVC;\n");
  std::string code = "vec3 normalVCVSOutput = normalize(splatNormalVC);\n";
  vtkProperty* property = actor->GetProperty();
  if (property->GetInterpolation() == VTK_PBR && property->GetCoatStrength() > 0.)
  {
    code += "  vec3 coatNormalVCVSOutput = normalVCVSOutput;\n";
  }
  Replace(fragment, "//VTK::Normal::Impl", code);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReplaceShaderClip(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  vtkShader* fragment = shaders[vtkShader::Fragment];
  InsertBefore(fragment, "//VTK::Clip::Dec", "in vec2 splatDiskCoord;");
  InsertBefore(
    fragment, "//VTK::Clip::Impl", "if (dot(splatDiskCoord, splatDiskCoord) > 1.0) discard;");
  this->Superclass::ReplaceShaderClip(shaders, renderer, actor);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::ReplaceShaderPicking(
  ShaderMap shaders, vtkRenderer* renderer, vtkActor* actor)
{
  // Cell ids come right from the base class: a primitive is a particle, the particles go through
  // the vertex cells in order. For points it would take gl_VertexID, which is of the corners here.
  vtkShader* fragment = shaders[vtkShader::Fragment];
  const bool low = this->LastSelectionState == vtkHardwareSelector::POINT_ID_LOW24;
  const bool high = this->LastSelectionState == vtkHardwareSelector::POINT_ID_HIGH24;
  if (low || high)
  {
    Replace(fragment, "//VTK::Picking::Dec", "uniform samplerBuffer splatPointIds;\n");
    Replace(fragment, "//VTK::Picking::Impl",
      std::string("  vec4 splatId = texelFetchBuffer(splatPointIds, gl_PrimitiveID);\n") +
        (low ? "  gl_FragData[0] = vec4(splatId.rgb, 1.0);\n"
             : "  gl_FragData[0] = vec4(splatId.a, 0.0, 0.0, 1.0);\n"));
    Replace(shaders[vtkShader::Vertex], "//VTK::Picking::Dec", "");
    Replace(shaders[vtkShader::Vertex], "//VTK::Picking::Impl", "");
  }
  this->Superclass::ReplaceShaderPicking(shaders, renderer, actor);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, renderer, actor);

  vtkShaderProgram* program = cellBO.Program;
  this->Internal->Buffers.SetSamplers(program);
  program->SetUniformf("splatRadiusScale", static_cast<float>(this->RadiusScale));
  program->SetUniformi(
    "splatFacesViewer", this->CurrentInput->GetPointData()->GetNormals() ? 0 : 1);
  if (this->ColorByNormalDirection)
  {
    program->SetUniform3f("splatOutwardColor", this->OutwardColor);
    program->SetUniform3f("splatInwardColor", this->InwardColor);
  }
  this->SetShiftedClippingPlanes(cellBO, actor);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::SetShiftedClippingPlanes(vtkOpenGLHelper& cellBO, vtkActor* actor)
{
  vtkShaderProgram* program = cellBO.Program;
  const int count = std::min(this->GetNumberOfClippingPlanes(), 6); // the base class has said so
  if (count == 0 || !program->IsUniformUsed("clipPlanes"))
  {
    return;
  }
  const std::array<double, 3>& origin = this->Internal->Buffers.GetOrigin();
  float planes[6][4] = {};
  GetModelToWorld(actor, this->TempMatrix4);
  for (int i = 0; i < count; ++i)
  {
    double plane[4];
    this->GetClippingPlaneInDataCoords(this->TempMatrix4, i, plane);
    plane[3] += vtkMath::Dot(plane, origin.data());
    std::copy_n(plane, 4, planes[i]);
  }
  program->SetUniform4fv("clipPlanes", 6, planes);
}

namespace
{
// Where the eye is in the coordinates that the transposed matrix takes to view coordinates; with
// w = 0 the direction to it.
void FindEye(vtkMatrix4x4* toViewTransposed, bool parallel, float eye[4])
{
  vtkNew<vtkMatrix4x4> fromView;
  vtkMatrix4x4::Transpose(toViewTransposed, fromView);
  fromView->Invert();
  const double inView[4] = { 0., 0., parallel ? 1. : 0., parallel ? 0. : 1. };
  double found[4];
  fromView->MultiplyPoint(inView, found);
  const double scale = parallel ? 1. : 1. / found[3];
  for (int i = 0; i < 4; ++i)
  {
    eye[i] = static_cast<float>(scale * found[i]);
  }
}
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::SetCameraShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetCameraShaderParameters(cellBO, renderer, actor);

  // Again with the shift of the particles. VTK keeps these matrices transposed, so that products
  // read from left to right.
  auto* camera = static_cast<vtkOpenGLCamera*>(renderer->GetActiveCamera());
  vtkMatrix4x4 *wcvc, *vcdc, *wcdc, *mcwc;
  vtkMatrix3x3 *normalWCVC, *normalMCWC;
  camera->GetKeyMatrices(renderer, wcvc, normalWCVC, vcdc, wcdc);
  static_cast<vtkOpenGLActor*>(actor)->GetKeyMatrices(mcwc, normalMCWC);

  vtkNew<vtkMatrix4x4> shift;
  for (int axis = 0; axis < 3; ++axis)
  {
    shift->SetElement(3, axis, this->Internal->Buffers.GetOrigin()[axis]);
  }
  vtkNew<vtkMatrix4x4> toWorld;
  vtkNew<vtkMatrix4x4> toView;
  vtkMatrix4x4::Multiply4x4(shift, mcwc, toWorld);
  vtkMatrix4x4::Multiply4x4(toWorld, wcvc, toView);
  vtkMatrix4x4::Multiply4x4(toWorld, wcdc, this->TempMatrix4);

  vtkShaderProgram* program = cellBO.Program;
  program->SetUniformMatrix("MCDCMatrix", this->TempMatrix4);
  if (program->IsUniformUsed("MCVCMatrix"))
  {
    program->SetUniformMatrix("MCVCMatrix", toView);
  }
  float eye[4];
  FindEye(toView, camera->GetParallelProjection() != 0, eye);
  program->SetUniform4f("splatEyeMC", eye);
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RadiusArrayName: " << (this->RadiusArrayName ? this->RadiusArrayName : "(none)")
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
