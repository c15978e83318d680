#pragma once

#include "Output/PointArrays.h"
#include "Support/Exchange.h"

#include <vector>

namespace hop
{

/// Rows of one block's output that are corners in elements of other ranks. They have the values of their stand-ins,
/// until their own ranks have been asked.
struct ForeignCorners
{
  struct Corner
  {
    std::ptrdiff_t row = 0;
    ElementHome home;
    ReferencePoint u;
  };
  std::vector<Corner> corners;
  /// The block's arrays, whose targets receive the values. They live as long as the output.
  std::vector<EvaluatedArray> arrays;
};

/// Asks the ranks of all corners for the values of point arrays there, exact as in their own rows. Every rank calls it,
/// also one without corners. Where another rank's block lacks an array, values of stand-ins stay.
/// \param mine of this rank's blocks
/// \param isDone whether this rank's output is there; ranks without it neither ask nor answer
/// \param parallelFor where it ends a loop early, other ranks get no answer: none of the values is to be used then
void askForForeignCorners(Exchange& exchange, const InputBlocks& blocks,
  const GridElements& elements, const std::vector<ForeignCorners>& mine, bool isDone,
  const ParallelFor& parallelFor);

} // namespace hop
