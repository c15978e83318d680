#pragma once

#include "Kernel/Kernels.h"

#include <cstring>
#include <limits>

// Local to the file that includes it, like Lanes.h.
namespace hop::kernel
{
namespace
{

#if defined(__GNUC__)
typedef float Floats __attribute__((vector_size(SweepLanes * sizeof(float))));
typedef std::int32_t Integers __attribute__((vector_size(SweepLanes * sizeof(std::int32_t))));
#else
#error "this compiler has no vector types known here"
#endif

inline Floats load(const float* from)
{
  Floats result;
  std::memcpy(&result, from, sizeof(result));
  return result;
}

inline void store(Floats value, float* to)
{
  std::memcpy(to, &value, sizeof(value));
}

inline Floats least(Floats a, Floats b)
{
  return a < b ? a : b;
}

inline Floats greatest(Floats a, Floats b)
{
  return a > b ? a : b;
}

inline Floats all(float value)
{
  return value - Floats{};
}

/// 1/sqrt(x) to single precision for positive normal x: a first guess from the exponent, three steps
/// of Newton's method. The processors' own estimates differ from maker to maker.
inline Floats inverseSquareRoot(Floats x)
{
  Integers bits;
  std::memcpy(&bits, &x, sizeof(bits));
  bits = 0x5f3759df - (bits >> 1);
  Floats y;
  std::memcpy(&y, &bits, sizeof(y));
  for (int step = 0; step < 3; ++step)
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

/// With q = cot(pi r / 2): E = q + (pi/2)(r - 1), E' = -(pi/2) q^2 and E'' = (pi^2/2) q (1 + q^2).
/// Returns E, E'/r and (E'' - E'/r)/r^2 for t = r^2 in (0, 1]; the latter two are exactly zero at
/// t = 1.
inline void pairEnergy(Floats t, Floats& energy, Floats& first, Floats& second)
{
  constexpr float halfPi = 1.57079632679f;
  const Floats inverse = inverseSquareRoot(t);
  // r cot(pi r / 2) / (1 - r^2) is smooth in r^2: its Chebyshev interpolant of degree 5, error 2e-7.
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
  const Floats mean = 0.5f * (h.xx + h.yy);
  const Floats difference = 0.5f * (h.xx - h.yy);
  const Floats square = difference * difference + h.xy * h.xy + 1e-12f;
  const Floats inverseRadius = inverseSquareRoot(square);
  const Floats radius = square * inverseRadius;
  const Floats high = 1.0f / greatest(mean + radius, all(floor));
  const Floats low = 1.0f / greatest(mean - radius, all(floor));
  const Floats isotropic = 0.5f * (high + low);
  const Floats directed = 0.5f * (high - low) * inverseRadius;
  return { isotropic * g.x + directed * (difference * g.x + h.xy * g.y),
    isotropic * g.y + directed * (h.xy * g.x - difference * g.y) };
}

/// What eight neighbours, one a lane, let be seen of them: eight rows of eight numbers, transposed.
struct SeenLanes
{
  Floats position[3];
  Floats inverseSpacing;
  Floats normal[3];

  SeenLanes(const Seen* seen, const std::int32_t* index)
  {
    static_assert(sizeof(Seen) == sizeof(Floats));
    const auto row = [&](int lane) { return load(seen[index[lane]].position); };
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
  static Floats low(Floats a, Floats b)
  {
    return __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  }
  static Floats high(Floats a, Floats b)
  {
    return __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  }
  static Floats lowPairs(Floats a, Floats b)
  {
    return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
  }
  static Floats highPairs(Floats a, Floats b)
  {
    return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
  }
  static Floats lowHalves(Floats a, Floats b)
  {
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
  }
  static Floats highHalves(Floats a, Floats b)
  {
    return __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
  }
};

/// The eight particles of a block where they are now: on their patches, displaced by (x, y).
struct Displaced
{
  Floats position[3];
  /// Directions in which x and y take them from there.
  Floats tangents[2][3];

  Displaced(const SweepBlock& block, const Tangential& moved)
  {
    const Floats bendX = load(block.shape[0]) * moved.x + load(block.shape[1]) * moved.y;
    const Floats bendY = load(block.shape[1]) * moved.x + load(block.shape[2]) * moved.y;
    const Floats sink = 0.5f * (bendX * moved.x + bendY * moved.y);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Floats normal = load(block.normal[axis]);
      const Floats e1 = load(block.tangents[0][axis]);
      const Floats e2 = load(block.tangents[1][axis]);
      this->position[axis] = load(block.base[axis]) + moved.x * e1 + moved.y * e2 - sink * normal;
      this->tangents[0][axis] = e1 - bendX * normal;
      this->tangents[1][axis] = e2 - bendY * normal;
    }
  }
};

inline Floats dot(const Floats (&a)[3], const Floats (&b)[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The energy of a particle, and its weighted gradient and Hessian, both over (beta/h_i)^2: with the
/// weight (h_ij/h_i)^2 of a pair and alpha = beta/h_ij, its gradient w alpha E' d/|d| and its Hessian
/// w alpha^2 (...) have that factor in common, and it cancels in Newton's step.
inline void sumPairs(const SweepBlock& block, const std::int32_t* neighbors, const Seen* seen,
  const Displaced& here, Floats& energy, Tangential& gradient, TangentialHessian& hessian)
{
  constexpr float halfBeta = 0.288675135f;
  constexpr float closest = 1e-4f;
  const Floats inverseSpacing = load(block.inverseSpacing);
  const Floats normal[3] = { load(block.normal[0]), load(block.normal[1]), load(block.normal[2]) };
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
    // Neighbours on a sheet that is turned away fade out, from 60 to 90 degrees.
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

void sweepBlocks(
  SweepBlock* blocks, std::ptrdiff_t count, const std::int32_t* neighbors, Seen* seen)
{
  // In hexagonal packing both eigenvalues are 3 (E''(beta) + E'(beta)/beta) = 13.7.
  constexpr float softest = 0.35f * 13.7f;
  for (SweepBlock* block = blocks; block != blocks + count; ++block)
  {
    Tangential moved{ load(block->moved[0]), load(block->moved[1]) };
    const Displaced here(*block, moved);
    Floats energy{};
    Tangential gradient;
    TangentialHessian hessian;
    sumPairs(*block, neighbors + block->firstNeighbor, seen, here, energy, gradient, hessian);
    store(energy, block->energy);
    const Tangential step = newtonStep(hessian, gradient, softest);
    const Floats relaxation = load(block->relaxation);
    moved.x -= relaxation * step.x;
    moved.y -= relaxation * step.y;
    const Floats farthest = load(block->farthest);
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
