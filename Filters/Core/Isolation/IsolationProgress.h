#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace hop
{

/// Receives the share of some work that is done, 0 to 1; called from several threads. May be empty.
using ReportProgress = std::function<void(double)>;

inline void report(const ReportProgress& progress, double share)
{
  if (progress)
  {
    progress(share);
  }
}

/// Progress of the isolation of one element. An element is split level by level, and the pieces of a level that hold
/// surface count as equal parts of the work that the levels before have left.
class IsolationProgress
{
public:
  /// \param progress outlives this object
  explicit IsolationProgress(const ReportProgress& progress)
    : Progress(progress)
  {
  }

  void beginLevel(std::size_t pieces)
  {
    this->Before = this->now();
    this->Pieces = pieces;
    this->Finished = 0;
    this->Empty = 0;
  }

  /// Tells that a piece of the level holds no surface, or that all of the surface in it has its boxes. May be called
  /// from several threads.
  void closePiece(bool isEmpty)
  {
    ++(isEmpty ? this->Empty : this->Finished);
    report(this->Progress, this->now());
  }

private:
  double now() const
  {
    const std::size_t holding = this->Pieces - this->Empty;
    return holding == 0 ? this->Before
                        : this->Before +
        (1.0 - this->Before) * static_cast<double>(this->Finished) / static_cast<double>(holding);
  }

  const ReportProgress& Progress;
  /// Share that was done when the level began.
  double Before = 0.0;
  /// Number of pieces of the level.
  std::size_t Pieces = 0;
  /// Closed pieces of the level, with and without surface.
  std::atomic<std::size_t> Finished{ 0 };
  std::atomic<std::size_t> Empty{ 0 };
};

} // namespace hop
