#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

class vtkBoundingBox;

namespace hop
{

// What MPI ranks agree on. Every rank has to call these functions equally often and in the same order, also a rank
// without data, with an error, or one that is to stop.

/// The box around the boxes of all ranks.
vtkBoundingBox overAllRanks(const vtkBoundingBox& local);

/// The largest of the ranks' numbers.
std::size_t largestOfRanks(std::size_t local);

/// The sum of the ranks' numbers, the same to the last bit on all ranks.
double sumOfRanks(double local);

/// How many particles a rank's part of an isosurface wants.
struct SurfaceCount
{
  double owned = 0.0;
  /// Particles in ghost cells, which belong to another rank.
  double ghosts = 0.0;
};

/// What this rank's part of a surface wants at a spacing; does not throw.
using CountAt = std::function<SurfaceCount(std::size_t surface, double spacing)>;

/// What a rank is to give of an isosurface.
struct RankShare
{
  /// With those in ghost cells.
  std::int64_t count = 0;
  /// The same on all ranks: at this spacing they want as many together as are asked for; 0 if it is not known.
  double spacing = 0.0;
};

/// Whether there are other ranks.
bool isOneOfRanks();

/// Whether this rank is the one that says what all ranks know.
bool isFirstOfRanks();

/// Shares out a number of particles of each of some isosurfaces so that they stand as dense on all ranks:
/// to each rank the part that it wants of what all want at the same spacing, rounded by largest remainders, so
/// that the sum of those not in ghost cells is the number.
/// \param number > 0
/// \param firstSpacing to try, the same on all ranks
/// \return one share a surface
std::vector<RankShare> shareOutToRanks(
  std::int64_t number, std::size_t surfaces, double firstSpacing, const CountAt& wanted);

} // namespace hop
