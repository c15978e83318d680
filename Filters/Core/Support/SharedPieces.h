#pragma once

#include <array>
#include <atomic>
#include <cstddef>

namespace hop
{

/// Pieces of work that threads take, each first those of its own part (from the ninth on they share parts), so that
/// the same thread is at the same pieces when there is the same work again: what they write stays in its cache.
class SharedPieces
{
public:
  static constexpr int Parts = 8;

  /// Calls use(piece) for pieces in [0, count) that nobody has taken, as long as there are any and it returns true.
  /// \param worker numbers threads from 0 on
  template <class Use>
  void take(int worker, std::ptrdiff_t count, const Use& use)
  {
    // Half of all pieces are between those of the first two, a fourth between those of the first four.
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
