#pragma once

#include "Kernel/Kernels.h"
#include "Kernel/Simd.h"

// Local to the file that includes it, see Simd.h.
namespace hop::kernel
{
namespace
{

/// The middle root b of 4 b^3 - 3 b = r, for r in [-1, 1]: the cosine of a third of an angle. For r >= 0 let
/// s = sqrt((1 - r) / 2) = sin(3 v); then b = -cos(pi/3 + 2 v), and x = sin v is the root of 4 x^3 - 3 x + s = 0 in
/// [0, sin(pi/12)], where its slope is between -3 and -2.2, also where b is a double root.
template <class Doubles>
inline Doubles middleRoot(Doubles r)
{
  constexpr double rootOf3 = 1.7320508075688772;
  constexpr int steps = 3; // of Newton's method: errors of 2e-3, 5e-6, 3e-11 and none
  const Doubles one = 1.0 - Doubles{};
  const Doubles s = squareRoot(0.5 * (1.0 - least(greatest(r, 0.0 - r), one)));
  Doubles x = s * (1.0 / 3.0 + s * s * (4.0 / 81.0 + s * s * (16.0 / 729.0)));
  for (int step = 0; step < steps; ++step)
  {
    x -= ((4.0 * x * x - 3.0) * x + s) / (12.0 * x * x - 3.0);
  }
  const Doubles root = x * x + rootOf3 * x * squareRoot(1.0 - x * x) - 0.5;
  return select(r <= Doubles{}, 0.0 - root, root);
}

/// The middle eigenvalue of a symmetric matrix, by the angle of its characteristic cubic (Smith 1961, Eigenvalues of a
/// symmetric 3 x 3 matrix).
template <class Doubles>
inline Doubles middleEigenvalue(
  Doubles xx, Doubles yy, Doubles zz, Doubles xy, Doubles xz, Doubles yz)
{
  const Doubles mean = (xx + yy + zz) * (1.0 / 3.0);
  xx -= mean;
  yy -= mean;
  zz -= mean;
  const Doubles size =
    squareRoot((xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + xz * xz + yz * yz)) * (1.0 / 6.0));
  // Divided first, and not by its third power, which may be zero.
  const Doubles inverse = select(size <= Doubles{}, Doubles{}, 1.0 / size);
  xx *= inverse;
  yy *= inverse;
  zz *= inverse;
  xy *= inverse;
  xz *= inverse;
  yz *= inverse;
  const Doubles determinant =
    xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  return mean + 2.0 * size * middleRoot(0.5 * determinant);
}

/// G = U X^-1.
template <class Doubles>
inline void worldGradient(const Doubles (&x)[9], const Doubles (&u)[9], Doubles (&g)[9])
{
  Doubles cofactor[9];
  for (int i = 0; i < 3; ++i)
  {
    const int j = 3 * ((i + 1) % 3);
    const int k = 3 * ((i + 2) % 3);
    cofactor[3 * i] = x[j + 1] * x[k + 2] - x[j + 2] * x[k + 1];
    cofactor[3 * i + 1] = x[j + 2] * x[k] - x[j] * x[k + 2];
    cofactor[3 * i + 2] = x[j] * x[k + 1] - x[j + 1] * x[k];
  }
  const Doubles inverse = 1.0 / (x[0] * cofactor[0] + x[1] * cofactor[1] + x[2] * cofactor[2]);
  for (int i = 0; i < 9; i += 3)
  {
    for (int j = 0; j < 3; ++j)
    {
      const Doubles* of = cofactor + 3 * j;
      g[i + j] = (u[i] * of[0] + u[i + 1] * of[1] + u[i + 2] * of[2]) * inverse;
    }
  }
}

template <class Doubles>
inline Doubles lambdaTwo(const Doubles (&x)[9], const Doubles (&u)[9])
{
  Doubles g[9];
  worldGradient(x, u, g);
  // Of G G, made symmetric.
  const auto entry = [&](int i, int j)
  { return g[3 * i] * g[j] + g[3 * i + 1] * g[j + 3] + g[3 * i + 2] * g[j + 6]; };
  return middleEigenvalue<Doubles>(entry(0, 0), entry(1, 1), entry(2, 2),
    0.5 * (entry(0, 1) + entry(1, 0)), 0.5 * (entry(0, 2) + entry(2, 0)),
    0.5 * (entry(1, 2) + entry(2, 1)));
}

/// Numbers of some neighbouring points; past the end those of the last one again, so that the tail of a row is computed
/// like the rest of it.
template <int Lanes>
inline void loadNumbers(const double* const (&rows)[9], std::ptrdiff_t first, std::ptrdiff_t count,
  Vector<double, Lanes> (&numbers)[9])
{
  for (int row = 0; row < 9; ++row)
  {
    if (first + Lanes <= count)
    {
      numbers[row] = load<Vector<double, Lanes>>(rows[row] + first);
      continue;
    }
    double lanes[Lanes];
    for (int lane = 0; lane < Lanes; ++lane)
    {
      lanes[lane] = rows[row][first + lane < count ? first + lane : count - 1];
    }
    numbers[row] = load<Vector<double, Lanes>>(lanes);
  }
}

/// See LambdaTwoFunction.
template <int Lanes>
void lambdaTwoOf(const GradientRows& rows, std::ptrdiff_t count, double* result)
{
  for (std::ptrdiff_t first = 0; first < count; first += Lanes)
  {
    Vector<double, Lanes> x[9];
    Vector<double, Lanes> u[9];
    loadNumbers<Lanes>(rows.x, first, count, x);
    loadNumbers<Lanes>(rows.u, first, count, u);
    const Vector<double, Lanes> lambda = lambdaTwo(x, u);
    const std::ptrdiff_t left = count - first < Lanes ? count - first : Lanes;
    std::memcpy(result + first, &lambda, left * sizeof(double));
  }
}

} // namespace
} // namespace hop::kernel
