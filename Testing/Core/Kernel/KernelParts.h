#pragma once

namespace hop::testing
{

/// What kernels are made of, as functions of plain memory, so that tests can call what each instruction set was
/// compiled to. Arrays of lanes hold one number a lane. Like Kernels.h this includes nothing: an inline function that
/// was compiled with AVX-512 could be the copy that the linker keeps for all.
struct KernelParts
{
  /// Points in a vector of a batch.
  int lanes;

  /// The Bernstein basis of a line at t[lane], and its first two derivatives.
  /// \param result [order][i][lane]
  void (*lineBasis)(int degree, const double* t, double* result);
  /// The same along three coordinates of a single point, of degree `TensorDegree`.
  /// \param result [axis][order][i]
  void (*tensorBasis)(const double* u, double* result);
  static constexpr int TensorDegree = 4;

  /// The basis of a triangle at (u[0][lane], u[1][lane]), of a tetrahedron at (u[0][lane], u[1][lane], u[2][lane]).
  /// \param result [function][lane]
  void (*triangleBasis)(int degree, const double* u, double* result);
  void (*tetrahedronBasis)(int degree, const double* u, double* result);
  /// The control net of that order, 1 or 2, that is left of a simplex' coefficients (x, y, z, f).
  /// \param result of points in lanes: [point of the net][component][lane]; of a single point, its components in
  ///   lanes: [point of the net][component]
  struct Net
  {
    void (*points)(
      int degree, int order, const double* u, const double* coefficients, double* result);
    void (*single)(
      int degree, int order, const double* u, const double* coefficients, double* result);
  };
  Net triangleNet;
  Net tetrahedronNet;

  /// Of kernel::SweepLanes lanes each.
  void (*inverseSquareRoot)(const float* x, float* result);
  /// \param result [energy, first, second][lane]
  void (*pairEnergy)(const float* t, float* result);
  /// \param hessian [xx, xy, yy][lane] \param gradient [x, y][lane] \param result [x, y][lane]
  void (*newtonStep)(const float* hessian, const float* gradient, float floor, float* result);
};

KernelParts baselineParts();
KernelParts avx2Parts();
KernelParts avx512Parts();

} // namespace hop::testing
