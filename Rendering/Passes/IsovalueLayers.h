/**
 * @class IsovalueLayers
 * @brief the layers of a picture: two of all isovalues together, or, of translucent surfaces, two of each
 */

#pragma once

#include "Passes/SplatLayer.h"

#include <memory>
#include <vector>

class vtkWindow;

namespace hop
{
class SplatView;

class IsovalueLayers
{
public:
  /** What is seen of one isovalue, or of all together. */
  struct Pair
  {
    SplatLayer Front{ LayerSide::Front };
    SplatLayer Back{ LayerSide::Back }; ///< of translucent surfaces

    void ReleaseGraphicsResources(vtkWindow* window);
  };

  /**
   * The layers of an isovalue. As far as memory goes each isovalue has its own, so that each pass of depth peeling
   * finds them drawn.
   */
  Pair& Of(int isovalue, const SplatView& view);

  /** Releases all layers but the first pairs. */
  void Release(std::size_t left, vtkWindow* window);

private:
  std::vector<std::unique_ptr<Pair>> Pairs;
};
}
