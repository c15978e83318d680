#include "Passes/SplatLayer.h"

#include "Drawing/SplatDrawing.h"
#include "Drawing/SplatView.h"
#include "Particles/SplatBuffers.h"
#include "Passes/PassState.h"
#include "Passes/PictureTiles.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <algorithm>

namespace hop
{
namespace
{
// Difference of depths, in diameters of the mean splat, from which on neighbouring pixels show different parts of the
// surface. Chosen by experiment: a smaller one takes slants for folds, a larger one misses folds that are near.
constexpr double FoldJump = 5.;
}

SplatLayer::SplatLayer(LayerSide side)
  : Visibility(side)
  , Accumulation(side, this->Visibility)
  , Strongest(side, this->Visibility)
  , Passes{ &this->Visibility, &this->Accumulation, &this->Strongest }
{
}

//------------------------------------------------------------------------------
bool SplatLayer::Update(const SplatDrawing& drawing)
{
  std::vector<double> key = drawing.GetWholeKey();
  if (key == this->Key)
  {
    return true;
  }
  this->Key.clear();
  // The passes clear, and draw in, all pixels that are looked at later.
  PassState state(drawing.Window->GetState(), PictureTiles::GetNeighborhood(*drawing.View));
  if (!std::all_of(this->Passes.begin(), this->Passes.end(),
        [&](SplatPass* pass) { return pass->Prepare(drawing); }))
  {
    return false;
  }
  for (SplatPass* pass : this->Passes)
  {
    pass->Draw(drawing, this->Primitives);
  }
  this->Key = std::move(key);
  return true;
}

//------------------------------------------------------------------------------
void SplatLayer::Activate()
{
  for (SplatPass* pass : this->Passes)
  {
    pass->Activate();
  }
}

void SplatLayer::Deactivate()
{
  for (SplatPass* pass : this->Passes)
  {
    pass->Deactivate();
  }
}

void SplatLayer::SetUniforms(
  vtkShaderProgram* program, const SplatLayer& front, const SplatDrawing& drawing) const
{
  for (const SplatPass* pass : this->Passes)
  {
    pass->SetSamplers(program);
  }
  for (const SplatPass* pass : front.Passes)
  {
    pass->SetSamplers(program, "splatFront");
  }
  const double diameter =
    2. * drawing.RadiusScale * drawing.Buffers->GetMeanRadius() * drawing.View->GetScale();
  // Half the least summed weight of a pixel with surface. Pixels without surface have none.
  program->SetUniformf("splatLeastWeight",
    static_cast<float>(0.5 * SplatPrimitives::GetLeastWeight(drawing.Sharpness)));
  program->SetUniformf("splatLayerDistance", static_cast<float>(diameter));
  program->SetUniformf("splatJump", static_cast<float>(FoldJump * diameter));
}

//------------------------------------------------------------------------------
void SplatLayer::ReleaseGraphicsResources(vtkWindow* window)
{
  for (SplatPass* pass : this->Passes)
  {
    pass->ReleaseGraphicsResources(window);
  }
  this->Primitives.ReleaseGraphicsResources();
  this->Key.clear();
}
}
