#pragma once

#include <cstdint>

namespace hop
{

/// Counter-based random numbers: the n-th number of a stream depends on seed and n only, the same on every machine.
/// SplitMix64 of Steele, Lea and Flood (Fast Splittable Pseudorandom Number Generators, OOPSLA 2014), with its
/// constants.
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : State(seed)
  {
  }

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(this->next() >> 11) * 0x1.0p-53; }

private:
  std::uint64_t next()
  {
    std::uint64_t z = (this->State += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::uint64_t State;
};

} // namespace hop
