#pragma once

#include <array>
#include <atomic>
#include <cstddef>

namespace hop
{

/// Pieces of work that threads take. Each thread begins with the pieces of its own part, so that it is at the same
/// pieces when the same work comes again, and what they write stays in its cache.
class SharedPieces
{
public:
  /// Each has a counter. Threads beyond the eighth share parts: with more counters, a thread that has done its own part
  /// looks longer for pieces that are left.
  static constexpr int Parts = 8;

  /// Calls use(piece) for pieces in [0, count) that no thread has taken, as long as there are any and use() returns
  /// true.
  /// \param worker numbers threads from 0 on
  template <class Use>
  void take(int worker, std::ptrdiff_t count, const Use& use)
  {
    // Bits reversed: the first two threads begin half of all pieces apart, the first four a fourth.
    constexpr std::array<int, Parts> firstParts{ 0, 4, 2, 6, 1, 5, 3, 7 };
    for (int n = 0; n < Parts; ++n)
    {
      const int part = (firstParts[worker % Parts] + n) % Parts;
      const std::ptrdiff_t begin = part * count / Parts;
      const std::ptrdiff_t size = (part + 1) * count / Parts - begin;
      while (this->Taken[part] < size)
      {
        const std::ptrdiff_t piece = this->Taken[part]++;
        if (piece < size && !use(begin + piece))
        {
          return;
        }
      }
    }
  }

private:
  std::array<std::atomic<std::ptrdiff_t>, Parts> Taken{};
};

} // namespace hop
