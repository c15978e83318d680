#pragma once

#include <cstddef>
#include <cstdint>

namespace hop::kernel
{

/// Highest degree that the kernels have room for. Arrays on the stack are as large as this asks: 350 kB for a
/// tetrahedron in vectors of eight doubles.
constexpr int MaximumDegree = 30;

/// An element in Bernstein form as the kernels see it: plain memory. (The kernels are compiled once an instruction set,
/// and use no inline functions of other headers: one that was compiled with AVX-512 could be the copy that the linker
/// keeps for all.)
struct Element
{
  int degrees[3];
  /// x, y, z, f of one coefficient after the other; multiplied by the weight where there are weights.
  const double* coefficients;
  /// nullptr: polynomial.
  const double* weights;
};

/// Jets of `count` points (u, v, w one after the other). Quantity q (value, u, v, w, then for
/// Hessians uu, uv, uw, vv, vw, ww), component c (x, y, z, f) of point n goes to
/// jets[(4 q + c) stride + n]. Whole vectors are written: jets needs count rounded up to
/// MaximumLanes doubles in each row.
using BatchFunction = void (*)(
  const Element&, const double* points, int count, double* jets, std::ptrdiff_t stride);

/// The jet of one point: jet[4 q + c].
using PointFunction = void (*)(const Element&, const double* point, double* jet);

/// Most points in a vector: eight doubles are the 512 bits of the widest registers.
constexpr int MaximumLanes = 8;

/// Of elements of one domain.
struct DomainKernels
{
  BatchFunction gradients;
  BatchFunction hessians;
  PointFunction gradient;
  PointFunction hessian;
};

/// Particles that are moved together: eight floats are a register of AVX2, and the work is the same in every
/// instruction set, so that the particles of a block do not depend on it.
constexpr int SweepLanes = 8;

/// What particles see of one another. As large as a vector of floats: blocks of eight are transposed.
struct Seen
{
  float position[3];
  /// 1/h.
  float inverseSpacing;
  /// Unit length.
  float normal[3];
  /// Fills up the vector.
  float unused;
};

/// Eight particles, none of which sees another, on quadratic patches of the surface: a particle
/// displaced by (x, y) is at base + x tangents[0] + y tangents[1] - (shape(x, y)/2) normal. Rows hold
/// one number a particle.
struct SweepBlock
{
  float base[3][SweepLanes];
  float tangents[2][3][SweepLanes];
  float normal[3][SweepLanes];
  /// xx, xy, yy of the second fundamental form.
  float shape[3][SweepLanes];
  float inverseSpacing[SweepLanes];
  /// Factor of Newton's steps.
  float relaxation[SweepLanes];
  /// Largest displacement from the base.
  float farthest[SweepLanes];
  /// (x, y): where the particles are.
  float moved[2][SweepLanes];
  /// Their energies before the last step.
  float energy[SweepLanes];
  std::int32_t particle[SweepLanes];
  /// Lanes in use; the others hold copies.
  std::int32_t count;
  /// Neighbours of each particle, from neighbors[firstNeighbor] on: the first of every lane, then the
  /// second of every lane, ...
  std::int32_t neighborCount;
  std::ptrdiff_t firstNeighbor;
};

/// Moves the particles of `count` blocks once, one block after the other: by Newton's step on their energies, in their
/// tangent planes. Reads what the particles see of their neighbours, and writes where they can be seen afterwards.
using SweepFunction = void (*)(
  SweepBlock* blocks, std::ptrdiff_t count, const std::int32_t* neighbors, Seen* seen);

/// Points among which the neighbours of a point are looked for. `count` is a multiple of MaximumLanes: points out of
/// reach fill the arrays up.
struct Candidates
{
  const double* x;
  const double* y;
  const double* z;
  /// 1/h.
  const double* inverseSpacing;
  const std::int32_t* index;
  std::ptrdiff_t count;
};

/// Writes the indices of the candidates for which d^2 (1/h + 1/h')^2 is within the limit, in their order.
/// Two points find each other, or neither finds the other.
/// \param near room for all candidates
/// \return the end of what was found
using NearFunction = std::int32_t* (*)(const Candidates&, const double (&position)[3],
  double inverseSpacing, double limit, std::int32_t* near);

/// Points of a plane, around the origin. `count` is a multiple of MaximumLanes; behind the `used` points stand points
/// far away.
struct FlatPoints
{
  const double* x;
  const double* y;
  std::ptrdiff_t used;
  std::ptrdiff_t count;
};

/// How areas around the origin differ from their picture in the plane: a piece at t counts (1 + form(t)^2/|t|^2 - gauss
/// |t|^2) times, where form is the quadratic form of xx, xy, yy.
struct CellBend
{
  double xx, xy, yy;
  double gauss;
};

struct PlaneCell
{
  double area = 0.0;
  /// Square of the largest distance of a corner.
  double reachSquared = 0.0;
};

/// The cell of the origin in the Voronoi diagram of the origin and the points: what is nearer to it than to them.
/// \return an area that means nothing, and a huge reach, where they do not surround the origin
using PlaneCellFunction = PlaneCell (*)(const FlatPoints&, const CellBend&);

/// Lines of an element's lattice along one direction: where each begins in `index`, then where the last ends.
struct Lines
{
  const std::int32_t* begin;
  /// Of coefficients, line after line; no line is longer than MaximumDegree + 1.
  const std::int32_t* index;
  std::ptrdiff_t count;
};

/// Bisects a polynomial at the middle of each line, by de Casteljau's algorithm.
/// \param coefficients x, y, z, f of one after the other; replaced by those of the half at the start of the lines
/// \param second receives the coefficients of the other half
using BisectionFunction = void (*)(const Lines&, double* coefficients, double* second);

/// The same of polynomials with one number a coefficient, along lines of 2 MaximumDegree + 1 at most.
using NumberBisectionFunction = void (*)(const Lines&, double* numbers, double* second);

/// Smallest and largest x, y, z, f.
struct ComponentBounds
{
  double lower[4];
  double upper[4];
};

/// \param coefficients x, y, z, f of one after the other
/// \param count > 0
using BoundsFunction = ComponentBounds (*)(const double* coefficients, std::ptrdiff_t count);

/// From a to b, counterclockwise around the origin.
struct FlatSegment
{
  double ax, ay;
  double bx, by;
};

/// Writes for each point a number that is positive if the line from the origin to the point crosses one of the segments
/// between its ends, else zero.
/// \param hidden room for points.count numbers
using HiddenFunction = void (*)(const FlatPoints& points, const FlatSegment* segments,
  std::ptrdiff_t segmentCount, double* hidden);

/// Two rows of numbers, whose product, as of polynomials, has the entry left_0 right_n + left_1 right_(n-1) + ... in
/// column n.
struct RowPair
{
  const double* left;
  int leftCount;
  /// Zeros stand before and behind the row, wherever the sum over all left_i asks for them, up to whole vectors.
  const double* right;
};

/// Adds products of rows to one row.
/// \param sum `length` numbers, with room up to the next multiple of MaximumLanes
using RowProductsFunction = void (*)(
  const RowPair* pairs, std::ptrdiff_t count, int length, double* sum);

/// The product of a rows x columns matrix with `columns` rows of `width` values: `rows` rows as long.
using MatrixFunction = void (*)(const double* matrix, int rows, int columns, const double* values,
  std::ptrdiff_t width, double* result);

/// Derivatives of the map and of a vector within an element, of component i along axis a in row 3 i + a: a number a point.
struct GradientRows
{
  const double* x[9];
  const double* u[9];
};

/// Lambda 2 of the vector at each point: the middle eigenvalue of the symmetric part of G G, G its gradient in world
/// space. Where two eigenvalues are equal its error is 1e-8 of the largest one, else a few roundings. Not finite where
/// the map is singular.
using LambdaTwoFunction = void (*)(const GradientRows& rows, std::ptrdiff_t count, double* result);

struct Kernels
{
  DomainKernels hexahedron;
  DomainKernels tetrahedron;
  DomainKernels wedge;
  SweepFunction sweep;
  NearFunction near;
  PlaneCellFunction planeCell;
  BisectionFunction bisection;
  NumberBisectionFunction numberBisection;
  BoundsFunction bounds;
  HiddenFunction hidden;
  RowProductsFunction rowProducts;
  MatrixFunction matrix;
  LambdaTwoFunction lambdaTwo;
};

Kernels baselineKernels();
Kernels avx2Kernels();
Kernels avx512Kernels();

} // namespace hop::kernel
