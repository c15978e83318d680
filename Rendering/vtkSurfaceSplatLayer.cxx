#include "vtkSurfaceSplatLayer.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkSurfaceSplatDrawing.h"
#include "vtkSurfaceSplatPassState.h"
#include "vtkSurfaceSplatTiles.h"
#include "vtkSurfaceSplatView.h"

#include <algorithm>

vtkSurfaceSplatLayer::vtkSurfaceSplatLayer(vtkSurfaceSplatSide side)
  : Visibility(side)
  , Accumulation(side, this->Visibility)
  , Strongest(side, this->Visibility)
  , Passes{ &this->Visibility, &this->Accumulation, &this->Strongest }
{
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatLayer::Update(const vtkSurfaceSplatDrawing& drawing)
{
  std::vector<double> key = drawing.GetWholeKey();
  if (key == this->Key)
  {
    return true;
  }
  this->Key.clear();
  // Whatever is looked at later is cleared.
  vtkSurfaceSplatPassState state(
    drawing.Window->GetState(), vtkSurfaceSplatTiles::GetNeighborhood(*drawing.View));
  if (!std::all_of(this->Passes.begin(), this->Passes.end(),
        [&](vtkSurfaceSplatPass* pass) { return pass->Prepare(drawing); }))
  {
    return false;
  }
  for (vtkSurfaceSplatPass* pass : this->Passes)
  {
    pass->Draw(drawing, this->Primitives);
  }
  this->Key = std::move(key);
  return true;
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::Activate()
{
  for (vtkSurfaceSplatPass* pass : this->Passes)
  {
    pass->Activate();
  }
}

void vtkSurfaceSplatLayer::Deactivate()
{
  for (vtkSurfaceSplatPass* pass : this->Passes)
  {
    pass->Deactivate();
  }
}

void vtkSurfaceSplatLayer::SetSamplers(
  vtkShaderProgram* program, const vtkSurfaceSplatLayer& front) const
{
  for (const vtkSurfaceSplatPass* pass : this->Passes)
  {
    pass->SetSamplers(program);
  }
  for (const vtkSurfaceSplatPass* pass : front.Passes)
  {
    pass->SetSamplers(program, "splatFront");
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceSplatLayer::ReleaseGraphicsResources(vtkWindow* window)
{
  for (vtkSurfaceSplatPass* pass : this->Passes)
  {
    pass->ReleaseGraphicsResources(window);
  }
  this->Primitives.ReleaseGraphicsResources();
  this->Key.clear();
}
