#pragma once

#include "Elements/Bernstein.h"
#include "Elements/LobattoLattice.h"
#include "Elements/NodalBasis.h"

#include <array>
#include <optional>
#include <vector>

namespace hop
{

/// Where a field is sampled for a polynomial, and how that follows.
struct SamplingLattice
{
  SamplingLattice(Domain domain, int degree);

  /// Gauss-Lobatto-Legendre points in cubes, else equispaced ones.
  std::vector<ReferencePoint> nodes;
  Degrees degrees;
  /// Of each direction of the domain's edges the pairs of nodes beside each other, by their places in storage order.
  std::vector<std::vector<std::array<int, 2>>> edges;
  /// In cubes.
  std::optional<LobattoLattice> ofCube;
  /// Else.
  std::optional<NodalBasis> basis;
};

/// Made at the first request and kept.
const SamplingLattice& samplingLattice(Domain domain, int degree);

/// Points spread evenly over a domain, some of them on its faces, at which polynomials are compared with fields.
const std::vector<ReferencePoint>& checkPoints(Domain domain);

/// Of the polynomial that has given values at the lattice's nodes.
std::vector<Coefficient> coefficientsFrom(
  const SamplingLattice& lattice, const std::vector<Coefficient>& nodal);

/// Values of an element's field at the lattice's nodes.
std::vector<double> fieldAtNodes(const SamplingLattice& lattice, const BernsteinForm& form);

/// Whether among the sets of nodes that hang together along the lattice's edges and are of one side there is one without a
/// mark.
/// \param side, mark of each node, in storage order
bool hasSetWithoutMark(
  const SamplingLattice& lattice, const std::vector<char>& side, const std::vector<char>& mark);

} // namespace hop
