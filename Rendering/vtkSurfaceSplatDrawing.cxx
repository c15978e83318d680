#include "vtkSurfaceSplatDrawing.h"

#include "vtkActor.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkSurfaceSplatBuffers.h"
#include "vtkSurfaceSplatView.h"

namespace
{
// Up to this many pixels from middle to rim, splats are drawn as points. The depth of a point is that
// of its middle, which is no great error then.
constexpr double LargestPoint = 2.;

// What splatSheet is for all of them.
constexpr int AllSheets = -1;

bool IsDrawnTwice(vtkRenderer* renderer, vtkActor* actor)
{
  return actor->HasOpaqueGeometry() && actor->HasTranslucentPolygonalGeometry() &&
    !renderer->GetSelector(); // which has one pass for everything
}
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatDrawing::ChooseParticles(
  vtkRenderer* renderer, vtkActor* actor, bool hasTranslucentCells)
{
  using Hidden = vtkSurfaceSplatHiddenSide;
  vtkProperty* property = actor->GetProperty();
  vtkProperty* backface = actor->GetBackfaceProperty();
  const bool twice = (hasTranslucentCells || backface) && IsDrawnTwice(renderer, actor);
  const bool translucentPass = actor->IsRenderingTranslucentPolygonalGeometry() != 0;
  this->Kind = vtkSurfaceSplatKind::All;
  if (hasTranslucentCells && twice)
  {
    this->Kind = translucentPass ? vtkSurfaceSplatKind::Translucent : vtkSurfaceSplatKind::Opaque;
  }
  this->HiddenSide = Hidden::None;
  if (property->GetBackfaceCulling() || property->GetFrontfaceCulling())
  {
    this->HiddenSide = property->GetBackfaceCulling() ? Hidden::Inward : Hidden::Outward;
  }
  else if (backface && !hasTranslucentCells && twice)
  {
    const bool inwardIsDrawn = translucentPass == (backface->GetOpacity() < 1.);
    this->HiddenSide = inwardIsDrawn ? Hidden::Outward : Hidden::Inward;
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatDrawing::SetUniforms(vtkShaderProgram* program) const
{
  this->Buffers->SetSamplers(program);
  this->View->SetUniforms(program);
  program->SetUniformf("splatRadiusScale", static_cast<float>(this->RadiusScale));
  program->SetUniformf("splatHiddenSide", static_cast<float>(this->HiddenSide));
  program->SetUniformi("splatFacesViewer", this->FacesViewer ? 1 : 0);
  program->SetUniformi("splatStride", this->Stride);
  program->SetUniformi("splatKind", static_cast<int>(this->Kind));
  program->SetUniformi("splatSheet", this->Sheet.value_or(AllSheets));
}

std::array<vtkIdType, 2> vtkSurfaceSplatDrawing::GetDrawnRange() const
{
  const std::array<vtkIdType, 2> all{ 0, this->Buffers->GetNumberOfParticles() };
  const auto [first, end] = this->Sheet ? this->Buffers->GetSheetRange(*this->Sheet) : all;
  return { first / this->Stride, (end + this->Stride - 1) / this->Stride };
}

//------------------------------------------------------------------------------
std::vector<double> vtkSurfaceSplatDrawing::GetWholeKey() const
{
  std::vector<double> key = this->Key;
  this->View->AppendTo(key);
  for (double value :
    { this->RadiusScale, this->Sharpness, double(this->Stride), double(this->Kind),
      double(this->Sheet.value_or(AllSheets)), double(this->FacesViewer), double(this->HiddenSide),
      double(this->Colors), double(this->Strongest), double(this->NumberOfClippingPlanes) })
  {
    key.push_back(value);
  }
  for (int plane = 0; plane < this->NumberOfClippingPlanes; ++plane)
  {
    key.insert(key.end(), this->ClippingPlanes[plane], this->ClippingPlanes[plane] + 4);
  }
  return key;
}

bool vtkSurfaceSplatDrawing::DrawsPoints() const
{
  const double radius = this->RadiusScale * this->Buffers->GetLargestRadius();
  return this->View->GetLargestPixels(radius) <= LargestPoint;
}

bool vtkSurfaceSplatDrawing::TellsSheetsApart() const
{
  return !this->Sheet && this->Buffers->GetNumberOfSheets() > 1;
}

bool vtkSurfaceSplatDrawing::DrawsAll() const
{
  return this->Kind == vtkSurfaceSplatKind::All && !this->Sheet &&
    this->Buffers->GetNumberOfSheets() == 1 &&
    this->HiddenSide == vtkSurfaceSplatHiddenSide::None && this->NumberOfClippingPlanes == 0;
}

bool vtkSurfaceSplatDrawing::DrawsCurved() const
{
  return this->Buffers->GetHasShape() && !this->FacesViewer && !this->DrawsPoints();
}
