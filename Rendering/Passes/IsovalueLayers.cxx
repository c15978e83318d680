#include "Passes/IsovalueLayers.h"

#include "Drawing/SplatView.h"

#include <algorithm>

namespace hop
{
namespace
{
/** Memory for the textures of the layers on the GPU. */
struct LayerMemory
{
  /**
   * Bytes of all layers at most: one GiB, a choice that no measurement made. With less memory isovalues share layers,
   * and their splats are summed up anew in each pass of depth peeling; with more the driver may run out of memory.
   */
  static constexpr double MostBytes = 1024. * 1024. * 1024.;
  /**
   * Bytes of a front and a back layer per pixel, about. Either has three sums of 16 bytes, three depths and a number of
   * 4 bytes each, and marks of 2 bytes.
   */
  static constexpr double BytesPerPixel = 128.;
};
}

//------------------------------------------------------------------------------
void IsovalueLayers::Pair::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Front.ReleaseGraphicsResources(window);
  this->Back.ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
IsovalueLayers::Pair& IsovalueLayers::Of(int isovalue, const SplatView& view)
{
  const double bytes = LayerMemory::BytesPerPixel * view.GetWidth() * view.GetHeight();
  const auto index = static_cast<std::size_t>(
    std::min<double>(isovalue, std::max(1., LayerMemory::MostBytes / bytes) - 1.));
  while (this->Pairs.size() <= index)
  {
    this->Pairs.push_back(std::make_unique<Pair>());
  }
  return *this->Pairs[index];
}

//------------------------------------------------------------------------------
void IsovalueLayers::Release(std::size_t left, vtkWindow* window)
{
  for (; this->Pairs.size() > left; this->Pairs.pop_back())
  {
    this->Pairs.back()->ReleaseGraphicsResources(window);
  }
}
}
