#include "vtkSurfaceSplatDrawing.h"

#include "vtkSurfaceSplatBuffers.h"
#include "vtkSurfaceSplatView.h"

namespace
{
// Up to this many pixels from middle to rim, splats are drawn as points. The depth of a point is that
// of its middle, which is no great error then.
constexpr double LargestPoint = 2.;
}

//------------------------------------------------------------------------------
std::vector<double> vtkSurfaceSplatDrawing::GetWholeKey() const
{
  std::vector<double> key = this->Key;
  this->View->AppendTo(key);
  for (double value :
    { this->RadiusScale, this->Sharpness, double(this->Stride), double(this->Kind),
      double(this->Sheet), double(this->FacesViewer), double(this->HiddenSide),
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
  return this->Sheet < 0 && this->Buffers->GetNumberOfSheets() > 1;
}

bool vtkSurfaceSplatDrawing::DrawsCurved() const
{
  return this->Buffers->GetHasShape() && !this->FacesViewer && !this->DrawsPoints();
}
