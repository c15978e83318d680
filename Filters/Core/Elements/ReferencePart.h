#pragma once

#include "Elements/Domain.h"

#include <vector>

namespace hop
{

/// A part of a reference domain that has the domain's own shape: v of the part is origin + axes v of the domain.
struct ReferencePart
{
  glm::dvec3 origin{ 0.0 };
  glm::dmat3 axes{ 1.0 };

  ReferencePoint inWhole(const ReferencePoint& v) const
  {
    return { this->origin + this->axes * v.xyz };
  }
};

/// The parts that `halvings` halvings of all edges give: eight times as many each. Edges are divided evenly and triangles
/// into similar ones, so that the parts of neighbouring elements meet face to face. None is turned inside out.
std::vector<ReferencePart> partsOf(Domain domain, int halvings);

} // namespace hop
