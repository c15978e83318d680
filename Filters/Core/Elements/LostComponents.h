#pragma once

#include "Elements/SamplingLattice.h"

#include <functional>
#include <vector>

namespace hop
{

/// A field and the polynomial that is to stand in for it.
struct ComparedField
{
  Domain domain = Domain::Hexahedron;
  const SamplingLattice& lattice;
  /// The field at the lattice's nodes, and the polynomial.
  const std::vector<double>& atNodes;
  const BernsteinForm& polynomial;
  /// The field at points.
  std::function<std::vector<double>(const std::vector<ReferencePoint>&)> at;
};

/// Whether the field is on one side of an isovalue in a place where the polynomial is not, and which hangs together with no
/// place where it is: at nodes of the lattice that hang together along its edges, or around a peak between nodes. Peaks are
/// searched from nodes at which the field is higher, or lower, than at those beside them, if it changes by so much there
/// that it may pass the isovalue. Derivation: Documentation/algorithm.md, section Derived fields.
bool losesComponents(const ComparedField& field, const std::vector<double>& isovalues);

} // namespace hop
