#pragma once

#include "Support/Exchange.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>

class vtkBoundingBox;

namespace hop
{

/// The MPI ranks of VTK's global controller, or the only rank where there is none.
std::unique_ptr<Exchange> makeExchange();

// What MPI ranks agree on. Every rank has to call these functions equally often and in the same order, also a rank
// without data, with an error, or one that is to stop.

/// The box around the boxes of all ranks.
vtkBoundingBox overAllRanks(const vtkBoundingBox& local);

/// The largest of the ranks' numbers.
std::size_t largestOfRanks(std::size_t local);

/// The sum of the ranks' numbers, the same to the last bit on all ranks.
double sumOfRanks(double local);

/// The sums of the ranks' counts.
std::map<int, std::int64_t> sumOfRanks(
  Exchange& exchange, const std::map<int, std::int64_t>& counts);

/// Whether this rank is the one that says what all ranks know.
bool isFirstOfRanks();

} // namespace hop
