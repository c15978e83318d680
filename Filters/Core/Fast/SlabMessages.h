#pragma once

#include "Elements/GatheredMesh.h"
#include "Fast/SlabDistribution.h"
#include "Support/Exchange.h"

#include <utility>
#include <vector>

namespace hop
{

/// Finds elements by where they came from, which workers agree on: each numbers the elements of its mesh itself.
class ElementsByHome
{
public:
  explicit ElementsByHome(const std::vector<ElementHome>& homes);

  /// \throw std::runtime_error if there is no such element
  int elementOf(const ElementHome& home) const;

private:
  /// Rank and index there, then the element; sorted.
  std::vector<std::pair<std::pair<int, int>, int>> Elements;
};

/// Particles as bytes, with the homes of their elements.
Bytes written(const SlabParticles& particles, const std::vector<ElementHome>& homes);

/// \param elements of the reader's mesh
SlabParticles readParticles(const Bytes& bytes, const ElementsByHome& elements);

} // namespace hop
