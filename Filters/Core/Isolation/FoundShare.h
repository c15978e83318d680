#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace hop
{

/// Told what share of some work is done, 0 to 1; from several threads. May be empty.
using ReportShare = std::function<void(double)>;

inline void report(const ReportShare& found, double share)
{
  if (found)
  {
    found(share);
  }
}

/// How much of an element's surface has its boxes: the pieces of a level that hold surface are taken for
/// equal parts of what the levels before have left.
class FoundShare
{
public:
  /// \param found outlives it
  explicit FoundShare(const ReportShare& found)
    : Found(found)
  {
  }

  void beginLevel(std::size_t pieces)
  {
    this->Before = this->now();
    this->Pieces = pieces;
    this->Finished = 0;
    this->Empty = 0;
  }

  /// A piece holds no surface, or all that is in it has its boxes. May be called from several threads.
  void closePiece(bool isEmpty)
  {
    ++(isEmpty ? this->Empty : this->Finished);
    report(this->Found, this->now());
  }

private:
  double now() const
  {
    const std::size_t holding = this->Pieces - this->Empty;
    return holding == 0 ? this->Before
                        : this->Before +
        (1.0 - this->Before) * static_cast<double>(this->Finished) / static_cast<double>(holding);
  }

  const ReportShare& Found;
  double Before = 0.0;
  std::size_t Pieces = 0;
  std::atomic<std::size_t> Finished{ 0 };
  std::atomic<std::size_t> Empty{ 0 };
};

} // namespace hop
