#pragma once

#include "Edges/FaceCrossings.h"
#include "Isolation/SurfaceProxy.h"

namespace hop
{

/// What the proxy's samples on the two sides of a joined face tell about the surface there. Costs no evaluation.
class SampleComparison
{
public:
  /// \param mesh, proxy outlive this
  SampleComparison(const ElementMesh& mesh, const SurfaceProxy& proxy)
    : Mesh(mesh)
    , Proxy(proxy)
  {
  }

  /// Whether the surface in another element seems to continue a sample's smoothly: by the sample there that is nearest.
  bool isSmoothTo(const SurfaceProxy::Sample& sample, int element) const;

  /// Whether the two sides of a face seem to meet at a crossing of the sample's box.
  /// \param largestJump along the face, in units of the spacing
  /// \return false also where the samples are too far off to tell
  bool meet(
    const FaceCrossing& crossing, const SurfaceProxy::Sample& sample, double largestJump) const;

private:
  const ElementMesh& Mesh;
  const SurfaceProxy& Proxy;
};

} // namespace hop
