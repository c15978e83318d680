#pragma once

#include "SurfaceProxy.h"

#include <vector>

namespace hop
{

/// For each of the first `count` patches, whether it keeps that distance, in units of its spacing, from
/// all others that are not turned away.
std::vector<char> keepDistance(const std::vector<Patch>& patches, std::size_t count,
  const std::vector<Patch>& others, double distance, const ParallelFor& parallelFor);

/// For each of the first `count` patches, whether to keep it if no two are to end too near each other,
/// which for few of them relaxation does not see to: the first of two stays, and those from `count` on do.
std::vector<char> standApart(
  const std::vector<Patch>& patches, std::size_t count, const ParallelFor& parallelFor);

/// For each sample, whether no patch stands on the piece of surface around it.
std::vector<char> findLonely(const std::vector<SurfaceProxy::Sample>& samples,
  const std::vector<Patch>& patches, const ParallelFor& parallelFor);

} // namespace hop
