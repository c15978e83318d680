#pragma once

#include "Elements/Domain.h"

#include <vector>

namespace hop
{

/// Where the nodes of a Lagrange hexahedron stand along each axis.
enum class NodeSpacing
{
  /// Equispaced, as VTK defines its Lagrange cells.
  Uniform,
  /// At the Gauss-Lobatto-Legendre points, as spectral element codes write them.
  GaussLobattoLegendre
};

/// A conversion from nodal values to Bernstein coefficients: a square matrix, row by row.
struct ConversionMatrix
{
  std::vector<double> rounded;
  /// The same before it was rounded to doubles.
  std::vector<long double> extended;
};

/// How an element's nodal values determine its polynomials, whatever kind of cell it was: the linear
/// map from nodal values to Bernstein coefficients (Documentation/algorithm.md, section Elements). With
/// V_ij = B_j(node i) the coefficients of a Lagrange element are V^-1 times the values. The matrix of a line, triangle
/// or tetrahedron is built in extended precision, once for each degree; products are converted factor by factor.
class NodalBasis
{
public:
  /// Nodal values on the full lattice of the domain.
  /// \param order for each node, in the mesh's order, the lattice point at which it stands; every
  /// lattice point exactly once
  /// \param spacing counts for hexahedra only: nodes of the other domains are equispaced
  /// \throw std::invalid_argument if `order` is no permutation of the lattice, or a degree is below
  /// 1 or above maximumInputDegree(domain)
  static NodalBasis lagrange(Domain domain, const Degrees& degrees,
    const std::vector<LatticePoint>& order, NodeSpacing spacing = NodeSpacing::Uniform);

  /// Values that are Bernstein coefficients already, in the mesh's order (Bezier cells).
  /// \throw std::invalid_argument as lagrange
  static NodalBasis bezier(
    Domain domain, const Degrees& degrees, const std::vector<LatticePoint>& order);

  /// Any other polynomial shape functions that the domain's Bernstein basis of these degrees can
  /// represent: serendipity elements, pyramids.
  /// \param shapeAtLattice for each lattice point in storage order the values of all shape functions
  /// there: coefficientCount x nodes values, the node running fastest
  /// \throw std::invalid_argument if a degree or the number of values is wrong
  static NodalBasis sampled(
    Domain domain, const Degrees& degrees, const std::vector<double>& shapeAtLattice);

  Domain domain() const { return this->ItsDomain; }
  const Degrees& degrees() const { return this->ItsDegrees; }

  int nodeCount() const { return this->Nodes; }
  int coefficientCount() const { return this->Coefficients; }

  /// Bernstein coefficients of `components` fields at a time.
  /// \param nodal nodeCount x components values, node by node, in the mesh's order
  /// \param coefficients coefficientCount x components values, in the order of coefficientIndex
  void toBernstein(const double* nodal, int components, double* coefficients) const;

  /// Bound on max|coefficient| / max|nodal value|: the infinity norm of the conversion.
  double conversionNorm() const { return this->Norm; }

  /// Bound on the errors of the coefficients, before they are rounded to doubles, relative to the
  /// largest nodal value. Ill-conditioned conversions are done in extended precision.
  ///
  /// Measured on hexahedra with equispaced nodes, errors of the field relative to its largest value: for smooth fields
  /// 3e-15 at degree 6, 1e-13 at 12, 2e-11 at 15; for random nodal values 1e-13, 1e-10, 1e-7, because their
  /// coefficients are 1e14 times as large as the values at degree 15.
  double conversionError() const;

private:
  /// The conversion along one simplex of the domain: a size x size matrix for values that stand `stride` apart.
  struct Factor
  {
    const ConversionMatrix* matrix = nullptr;
    int size = 0;
    int stride = 0;
  };

  NodalBasis(Domain domain, const Degrees& degrees);
  void placeNodes(const std::vector<LatticePoint>& order);
  void addLatticeFactors(NodeSpacing spacing);
  int addFactor(const ConversionMatrix& matrix, int stride);
  bool isIllConditioned() const;
  template <class Number>
  void convert(const double* nodal, int components, double* coefficients) const;

  Domain ItsDomain;
  Degrees ItsDegrees;
  int Nodes = 0;
  int Coefficients = 0;
  /// Storage index of each node's lattice point; empty for sampled bases.
  std::vector<int> Place;
  /// Applied one after the other to the values in storage order; none for Bezier and sampled bases.
  std::vector<Factor> Factors;
  /// The conversion as one Coefficients x Nodes matrix, for sampled bases only.
  std::vector<double> Dense;
  double Norm = 1.0;
};

/// The matrix that takes values at the equispaced points of a line, triangle or tetrahedron (dimension 1, 2, 3) to
/// Bernstein coefficients of that degree. Computed at the first request and kept.
const ConversionMatrix& equispacedToBernstein(int dimension, int degree);

/// The same from values at the degree + 1 Gauss-Lobatto-Legendre points of a line.
const ConversionMatrix& gaussLobattoToBernstein(int degree);

/// The degree + 1 Gauss-Lobatto-Legendre points on [0, 1]: its ends and the extrema of the Legendre
/// polynomial of that degree.
std::vector<long double> gaussLobattoPoints(int degree);

} // namespace hop
