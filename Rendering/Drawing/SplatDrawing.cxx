#include "Drawing/SplatDrawing.h"

#include "Drawing/SplatView.h"
#include "Particles/SplatBuffers.h"
#include "vtkActor.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

namespace hop
{
namespace
{
// Radius in pixels up to which splats are drawn as points. A point has the depth of its middle everywhere, which is no
// great error for so small a splat. Chosen by experiment: larger points hide others wrongly, smaller ones make three
// times as many vertices of more pictures.
constexpr double LargestPoint = 2.;

// The value of splatIsovalue where all isovalues are drawn.
constexpr int AllIsovalues = -1;

bool IsDrawnTwice(vtkRenderer* renderer, vtkActor* actor)
{
  return actor->HasOpaqueGeometry() && actor->HasTranslucentPolygonalGeometry() &&
    !renderer->GetSelector(); // a selection has one pass for everything
}
}

//------------------------------------------------------------------------------
void SplatDrawing::ChooseParticles(vtkRenderer* renderer, vtkActor* actor, bool hasTranslucentCells)
{
  using Hidden = CulledSide;
  vtkProperty* property = actor->GetProperty();
  vtkProperty* backface = actor->GetBackfaceProperty();
  const bool twice = (hasTranslucentCells || backface) && IsDrawnTwice(renderer, actor);
  const bool translucentPass = actor->IsRenderingTranslucentPolygonalGeometry() != 0;
  this->Kind = DrawnKind::All;
  if (hasTranslucentCells && twice)
  {
    this->Kind = translucentPass ? DrawnKind::Translucent : DrawnKind::Opaque;
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
void SplatDrawing::SetUniforms(vtkShaderProgram* program) const
{
  this->Buffers->SetSamplers(program);
  this->View->SetUniforms(program);
  program->SetUniformf("splatRadiusScale", static_cast<float>(this->RadiusScale));
  program->SetUniformf("splatHiddenSide", static_cast<float>(this->HiddenSide));
  program->SetUniformi("splatFacesViewer", this->FacesViewer ? 1 : 0);
  program->SetUniformi("splatStride", this->Stride);
  program->SetUniformi("splatGhosts", this->Ghosts ? 1 : 0);
  program->SetUniformi("splatKind", static_cast<int>(this->Kind));
  program->SetUniformi("splatIsovalue", this->Isovalue.value_or(AllIsovalues));
}

std::array<vtkIdType, 2> SplatDrawing::GetDrawnRange() const
{
  const std::array<vtkIdType, 2> all{ 0, this->Buffers->GetNumberOfParticles() };
  const auto [first, end] = this->Isovalue ? this->Buffers->GetIsovalueRange(*this->Isovalue) : all;
  return { first / this->Stride, (end + this->Stride - 1) / this->Stride };
}

//------------------------------------------------------------------------------
std::vector<double> SplatDrawing::GetWholeKey() const
{
  std::vector<double> key = this->Key;
  this->View->AppendTo(key);
  for (double value :
    { this->RadiusScale, this->Sharpness, double(this->Stride), double(this->Kind),
      double(this->Isovalue.value_or(AllIsovalues)), double(this->FacesViewer),
      double(this->HiddenSide), double(this->Colors), double(this->Strongest), double(this->Ghosts),
      double(this->ClipsColors), this->EdgeWidth, double(this->NumberOfClippingPlanes) })
  {
    key.push_back(value);
  }
  for (int plane = 0; plane < this->NumberOfClippingPlanes; ++plane)
  {
    key.insert(key.end(), this->ClippingPlanes[plane], this->ClippingPlanes[plane] + 4);
  }
  return key;
}

bool SplatDrawing::DrawsPoints() const
{
  const double radius = this->RadiusScale * this->Buffers->GetLargestRadius();
  return this->View->GetLargestPixels(radius) <= LargestPoint;
}

bool SplatDrawing::TellsIsovaluesApart() const
{
  return !this->Isovalue && this->Buffers->GetNumberOfIsovalues() > 1;
}

bool SplatDrawing::TellsLayersApart() const
{
  return this->Buffers->GetHasLayers() && !this->FacesViewer && this->Stride == 1;
}

bool SplatDrawing::TellsDepthsApart() const
{
  return this->TellsIsovaluesApart() || this->TellsLayersApart();
}

bool SplatDrawing::DrawsAll() const
{
  return this->Kind == DrawnKind::All && !this->Isovalue &&
    this->Buffers->GetNumberOfIsovalues() == 1 && this->HiddenSide == CulledSide::None &&
    this->NumberOfClippingPlanes == 0 && (this->Ghosts || !this->Buffers->GetHasGhosts());
}

bool SplatDrawing::UsesBorders() const
{
  return this->Buffers->GetHasBorders() && (this->ClipsColors || this->EdgeWidth > 0.);
}

bool SplatDrawing::DrawsCurved() const
{
  return this->Buffers->GetHasShape() && !this->FacesViewer && !this->DrawsPoints();
}
}
