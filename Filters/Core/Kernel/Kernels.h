#pragma once

#include <cstddef>

namespace hop::kernel
{

/// Highest degree that the kernels have room for.
constexpr int MaximumDegree = 30;

/// An element in Bernstein form as the kernels see it: plain memory. (The kernels are compiled once
/// an instruction set. An inline function of a shared header, compiled there with AVX-512, could be
/// the copy that the linker keeps for all; so they use none.)
struct Element
{
  int degrees[3];
  /// x, y, z, f of one coefficient after the other; times the weight where there are weights.
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

constexpr int MaximumLanes = 8;

struct DomainKernels
{
  BatchFunction gradients;
  BatchFunction hessians;
  PointFunction gradient;
  PointFunction hessian;
};

struct Kernels
{
  DomainKernels hexahedron;
  DomainKernels tetrahedron;
  DomainKernels wedge;
};

Kernels baselineKernels();
Kernels avx2Kernels();
Kernels avx512Kernels();

} // namespace hop::kernel
