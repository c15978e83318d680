#pragma once

#include "Kernel/Kernels.h"
#include "Kernel/Simd.h"

#include <limits>

// Local to the file that includes it, see Simd.h.
namespace hop::kernel
{
namespace
{

/// A number of each of the particles that are moved together.
using Floats = Vector<float, SweepLanes>;
using Integers = Vector<std::int32_t, SweepLanes>;

inline Floats loadFloats(const float* from)
{
  return load<Floats>(from);
}

inline Floats all(float value)
{
  return value - Floats{};
}

/// 1/sqrt(x) for positive normal x, by Newton's method from a first guess. The processors' own estimates differ from
/// maker to maker, and so would the particles.
inline Floats inverseSquareRoot(Floats x)
{
  // The bits of a float, taken as an integer, are nearly linear in its logarithm; half of them subtracted from this
  // well-known integer give a float that is off by 3.5% at most. Steps reduce that to 2e-3, 5e-6 and 3e-11, which is
  // below the precision of a float; a fourth one would change nothing.
  constexpr std::int32_t firstGuess = 0x5f3759df;
  constexpr int steps = 3;
  Floats y = bitCast<Floats>(firstGuess - (bitCast<Integers>(x) >> 1));
  for (int step = 0; step < steps; ++step)
  {
    y = y * (1.5f - 0.5f * x * y * y);
  }
  return y;
}

/// A tangent vector, or the gradient of the energy.
struct Tangential
{
  Floats x{};
  Floats y{};
};

/// Second derivatives of the energy along the surface.
struct TangentialHessian
{
  Floats xx{};
  Floats xy{};
  Floats yy{};
};

/// The energy of Surface/Energy.h: with q = cot(pi r / 2), E = q + (pi/2)(r - 1), E' = -(pi/2) q^2 and
/// E'' = (pi^2/2) q (1 + q^2).
/// \param t r^2, in (0, 1]
/// \param energy receives E
/// \param first receives E'/r; exactly zero at t = 1
/// \param second receives (E'' - E'/r)/r^2; exactly zero at t = 1
inline void pairEnergy(Floats t, Floats& energy, Floats& first, Floats& second)
{
  constexpr float halfPi = 1.57079632679f;
  const Floats inverse = inverseSquareRoot(t);
  // r cot(pi r / 2) / (1 - r^2) is smooth in r^2: its Chebyshev interpolant of degree 5, off by 1.5e-7 at most. That
  // is a few roundings of a float; one degree less would show in the energy.
  const Floats smooth = 0.636619647f +
    t *
      (0.1130298f +
        t * (0.0267931238f + t * (0.00705648267f + t * (0.000941490328f + t * 0.000957475183f))));
  const Floats q = smooth * (1.0f - t) * inverse;
  energy = q + halfPi * (t * inverse - 1.0f);
  first = -halfPi * q * q * inverse;
  second = (2.0f * halfPi * halfPi * q * (1.0f + q * q) - first) * inverse * inverse;
}

/// H^-1 g for a symmetric H whose eigenvalues are raised to `floor` at least.
inline Tangential newtonStep(const TangentialHessian& h, const Tangential& g, float floor)
{
  // Keeps the root off zero where both eigenvalues are one: 1e-6 squared, beside eigenvalues of 14 in hexagonal
  // packing.
  constexpr float tiny = 1e-12f;
  const Floats mean = 0.5f * (h.xx + h.yy);
  const Floats difference = 0.5f * (h.xx - h.yy);
  const Floats square = difference * difference + h.xy * h.xy + tiny;
  const Floats inverseRadius = inverseSquareRoot(square);
  const Floats radius = square * inverseRadius;
  const Floats high = 1.0f / greatest(mean + radius, all(floor));
  const Floats low = 1.0f / greatest(mean - radius, all(floor));
  const Floats isotropic = 0.5f * (high + low);
  const Floats directed = 0.5f * (high - low) * inverseRadius;
  return { isotropic * g.x + directed * (difference * g.x + h.xy * g.y),
    isotropic * g.y + directed * (h.xy * g.x - difference * g.y) };
}

/// What is seen of eight neighbours, one a lane: eight rows of eight numbers, transposed.
struct SeenLanes
{
  Floats position[3];
  Floats inverseSpacing;
  Floats normal[3];

  SeenLanes(const Seen* seen, const std::int32_t* index)
  {
    static_assert(sizeof(Seen) == sizeof(Floats));
    const auto row = [&](int lane) { return loadFloats(seen[index[lane]].position); };
    const Floats r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
    const Floats r4 = row(4), r5 = row(5), r6 = row(6), r7 = row(7);
    // Pairs of columns of two rows, then of four, then of all.
    const Floats a0 = low(r0, r1), a1 = high(r0, r1), a2 = low(r2, r3), a3 = high(r2, r3);
    const Floats a4 = low(r4, r5), a5 = high(r4, r5), a6 = low(r6, r7), a7 = high(r6, r7);
    const Floats b0 = lowPairs(a0, a2), b1 = highPairs(a0, a2);
    const Floats b2 = lowPairs(a1, a3), b3 = highPairs(a1, a3);
    const Floats b4 = lowPairs(a4, a6), b5 = highPairs(a4, a6);
    const Floats b6 = lowPairs(a5, a7), b7 = highPairs(a5, a7);
    this->position[0] = lowHalves(b0, b4);
    this->position[1] = lowHalves(b1, b5);
    this->position[2] = lowHalves(b2, b6);
    this->inverseSpacing = lowHalves(b3, b7);
    this->normal[0] = highHalves(b0, b4);
    this->normal[1] = highHalves(b1, b5);
    this->normal[2] = highHalves(b2, b6);
  }

private:
  static Floats low(Floats a, Floats b) { return shuffle<0, 8, 1, 9, 4, 12, 5, 13>(a, b); }
  static Floats high(Floats a, Floats b) { return shuffle<2, 10, 3, 11, 6, 14, 7, 15>(a, b); }
  static Floats lowPairs(Floats a, Floats b) { return shuffle<0, 1, 8, 9, 4, 5, 12, 13>(a, b); }
  static Floats highPairs(Floats a, Floats b) { return shuffle<2, 3, 10, 11, 6, 7, 14, 15>(a, b); }
  static Floats lowHalves(Floats a, Floats b) { return shuffle<0, 1, 2, 3, 8, 9, 10, 11>(a, b); }
  static Floats highHalves(Floats a, Floats b) { return shuffle<4, 5, 6, 7, 12, 13, 14, 15>(a, b); }
};

/// Where the eight particles of a block are: on their patches, displaced by (x, y).
struct Displaced
{
  Floats position[3];
  /// Derivatives of the position by x and by y.
  Floats tangents[2][3];

  Displaced(const SweepBlock& block, const Tangential& moved)
  {
    const Floats bendX =
      loadFloats(block.shape[0]) * moved.x + loadFloats(block.shape[1]) * moved.y;
    const Floats bendY =
      loadFloats(block.shape[1]) * moved.x + loadFloats(block.shape[2]) * moved.y;
    const Floats sink = 0.5f * (bendX * moved.x + bendY * moved.y);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Floats normal = loadFloats(block.normal[axis]);
      const Floats e1 = loadFloats(block.tangents[0][axis]);
      const Floats e2 = loadFloats(block.tangents[1][axis]);
      this->position[axis] =
        loadFloats(block.base[axis]) + moved.x * e1 + moved.y * e2 - sink * normal;
      this->tangents[0][axis] = e1 - bendX * normal;
      this->tangents[1][axis] = e2 - bendY * normal;
    }
  }
};

inline Floats dot(const Floats (&a)[3], const Floats (&b)[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Adds the energies of all pairs, and their weighted gradients and Hessians along the surface, both divided by
/// (beta/h_i)^2. A pair has the weight w = (h_ij/h_i)^2 and alpha = beta/h_ij; then its gradient w alpha E' d/|d| and
/// its Hessian w alpha^2 (...) have the factor (beta/h_i)^2 in common, which cancels in Newton's step.
inline void sumPairs(const SweepBlock& block, const std::int32_t* neighbors, const Seen* seen,
  const Displaced& here, Floats& energy, Tangential& gradient, TangentialHessian& hessian)
{
  // Half of HexagonalDistance (Surface/Energy.h): h_ij is a harmonic mean, so that beta/h_ij = (beta/2)(1/h_i + 1/h_j).
  constexpr float halfBeta = 0.288675135f;
  // Least r^2: particles in one place repel each other as at r = 0.01. Smaller ones would have energies that make all
  // others vanish in single precision.
  constexpr float closest = 1e-4f;
  const Floats inverseSpacing = loadFloats(block.inverseSpacing);
  const Floats normal[3] = { loadFloats(block.normal[0]), loadFloats(block.normal[1]),
    loadFloats(block.normal[2]) };
  for (int n = 0; n < block.neighborCount; ++n)
  {
    const SeenLanes other(seen, neighbors + n * SweepLanes);
    const Floats d[3] = { here.position[0] - other.position[0],
      here.position[1] - other.position[1], here.position[2] - other.position[2] };
    const Floats alpha = halfBeta * (inverseSpacing + other.inverseSpacing);
    const Floats alpha2 = alpha * alpha;
    const Floats t = least(greatest(alpha2 * dot(d, d), all(closest)), all(1.0f));
    Floats value;
    Floats first;
    Floats second;
    pairEnergy(t, value, first, second);
    // Neighbours on a sheet whose normal is turned away fade out (smoothstep) from 60 degrees, where twice the cosine
    // is one, to 90 degrees. Angles chosen by experiment: with larger ones, the two sides of a thin part push each
    // other; with smaller ones, particles of a sharp bend do not see each other.
    const Floats facing = least(greatest(2.0f * dot(normal, other.normal), all(0.0f)), all(1.0f));
    const Floats fade = facing * facing * (3.0f - 2.0f * facing);
    energy += fade * value;
    first *= fade;
    second *= fade * alpha2;
    const Floats dx = dot(d, here.tangents[0]);
    const Floats dy = dot(d, here.tangents[1]);
    gradient.x += first * dx;
    gradient.y += first * dy;
    hessian.xx += second * dx * dx + first;
    hessian.xy += second * dx * dy;
    hessian.yy += second * dy * dy + first;
  }
}

/// Lets others see where the particles are now.
inline void publish(const SweepBlock& block, const Displaced& there, Seen* seen)
{
  float rows[3][SweepLanes];
  for (int axis = 0; axis < 3; ++axis)
  {
    store(there.position[axis], rows[axis]);
  }
  for (int lane = 0; lane < block.count; ++lane)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      seen[block.particle[lane]].position[axis] = rows[axis][lane];
    }
  }
}

/// See SweepFunction.
inline void sweepBlocks(
  SweepBlock* blocks, std::ptrdiff_t count, const std::int32_t* neighbors, Seen* seen)
{
  // Least eigenvalue, as a share of those of hexagonal packing: both are 3 (E''(beta) + E'(beta)/beta) = 13.7 there.
  // The share was chosen by experiment. With a smaller one, particles leap where energies hardly bend; with a larger
  // one, they creep.
  constexpr float softest = 0.35f * 13.7f;
  for (SweepBlock* block = blocks; block != blocks + count; ++block)
  {
    Tangential moved{ loadFloats(block->moved[0]), loadFloats(block->moved[1]) };
    const Displaced here(*block, moved);
    Floats energy{};
    Tangential gradient;
    TangentialHessian hessian;
    sumPairs(*block, neighbors + block->firstNeighbor, seen, here, energy, gradient, hessian);
    store(energy, block->energy);
    const Tangential step = newtonStep(hessian, gradient, softest);
    const Floats relaxation = loadFloats(block->relaxation);
    moved.x -= relaxation * step.x;
    moved.y -= relaxation * step.y;
    const Floats farthest = loadFloats(block->farthest);
    // The smallest normal number, so that the root is defined for a particle that has not moved.
    const Floats length2 =
      moved.x * moved.x + moved.y * moved.y + std::numeric_limits<float>::min();
    const Floats shrink = least(farthest * inverseSquareRoot(length2), all(1.0f));
    moved.x *= shrink;
    moved.y *= shrink;
    store(moved.x, block->moved[0]);
    store(moved.y, block->moved[1]);
    publish(*block, Displaced(*block, moved), seen);
  }
}

} // namespace
} // namespace hop::kernel
