#pragma once

#include "Mesh/TriangleFans.h"

#include <vector>

namespace hop::testing
{

/// A mesh of given triangles.
inline TriangleFans fansOf(std::size_t vertexCount, const std::vector<Triangle>& triangles)
{
  TriangleFans fans(
    vertexCount, {}, []() { return 0; }, [](int, TriangleFans::Fan&, int&) {});
  for (const Triangle& triangle : triangles)
  {
    fans.add(triangle);
  }
  return fans;
}

} // namespace hop::testing
