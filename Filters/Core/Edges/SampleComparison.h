#pragma once

#include "Edges/FaceCrossings.h"
#include "Isolation/SurfaceProxy.h"

namespace hop
{

/// What the samples on the two sides of a joined face tell about the surface there; no evaluation is needed.
class SampleComparison
{
public:
  /// \param mesh, proxy outlive this
  SampleComparison(const ElementMesh& mesh, const SurfaceProxy& proxy)
    : Mesh(mesh)
    , Proxy(proxy)
  {
  }

  /// Whether the surface in an element next to that of a sample seems to be its smooth continuation.
  bool isSmoothTo(const SurfaceProxy::Sample& sample, int element) const;

  /// Whether the two sides seem to meet at a crossing of the sample's box.
  /// \param largestJump along the face, in units of the spacing
  bool meet(
    const FaceCrossing& crossing, const SurfaceProxy::Sample& sample, double largestJump) const;

private:
  const ElementMesh& Mesh;
  const SurfaceProxy& Proxy;
};

} // namespace hop
