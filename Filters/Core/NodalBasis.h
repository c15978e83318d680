#pragma once

#include "Domain.h"

#include <vector>

namespace hop
{

/// How an element's nodes carry its polynomials: nodes at the equispaced points of the lattice (as
/// VTK's linear and Lagrange cells have them), in the order in which the mesh lists them.
///
/// Its one task is to rewrite nodal values as Bernstein coefficients. With V_ij = B_j(node i) the
/// coefficients are V^-1 times the values. V^-1 is built in extended precision and once a degree,
/// for a line, a triangle or a tetrahedron; tensor products are converted factor by factor.
class NodalBasis
{
public:
  /// \param order for each node, in the mesh's order, the lattice point at which it stands; every
  /// lattice point exactly once
  /// \throw std::invalid_argument if `order` is no permutation of the lattice, or a degree is below
  /// 1 or above MaximumDegree
  NodalBasis(Domain domain, const Degrees& degrees, const std::vector<LatticePoint>& order);

  Domain domain() const { return this->ItsDomain; }
  const Degrees& degrees() const { return this->ItsDegrees; }
  int nodeCount() const { return static_cast<int>(this->Place.size()); }

  /// The node that stands at a corner of the domain.
  int cornerNode(int corner) const { return this->CornerNodes[corner]; }

  /// Bernstein coefficients of `components` fields at a time.
  /// \param nodal nodeCount x components values, node by node, in the mesh's order
  /// \param coefficients nodeCount x components values, in the order of coefficientIndex
  void toBernstein(const double* nodal, int components, double* coefficients) const;

  /// Bound on max|coefficient| / max|nodal value|: the infinity norm of the conversion. Rounding
  /// errors of the coefficients are bounded by a few eps times this times the largest value.
  double conversionNorm() const { return this->Norm; }

private:
  /// A line, triangle or tetrahedron with its matrix; acts on `size` values that stand `stride`
  /// apart, for every other index.
  struct Factor
  {
    const std::vector<double>* matrix = nullptr;
    int size = 0;
    int stride = 0;
  };

  Domain ItsDomain;
  Degrees ItsDegrees;
  std::vector<int> Place; // storage index of each node
  std::vector<int> CornerNodes;
  std::vector<Factor> Factors;
  double Norm = 1.0;
};

/// Square matrix, row by row, that takes values at the equispaced points of a line, triangle or
/// tetrahedron (dimension 1, 2, 3) to Bernstein coefficients of that degree. Computed once, kept.
const std::vector<double>& equispacedToBernstein(int dimension, int degree);

} // namespace hop
