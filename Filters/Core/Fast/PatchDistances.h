#pragma once

#include "Isolation/SurfaceProxy.h"

#include <vector>

namespace hop
{

/// Least distance between particles, in units of their spacing. Between rounds a particle nearer than this to one on a
/// boundary curve is dropped; in the end one of two that are nearer to each other is, as where a strip between boundary
/// curves has no room for both. Chosen by experiment. Larger: holes where particles were dropped; smaller: pairs that
/// crowd.
inline constexpr double MinimumSeparation = 0.65;

/// For each of the first `count` patches, whether it keeps a distance, in units of its spacing, from all others that
/// are not turned away.
std::vector<char> areFarFrom(const Buffer<Patch>& patches, std::size_t count,
  const Buffer<Patch>& others, double distance, const ParallelFor& parallelFor);

/// For each of the first `count` patches, whether it keeps a distance, in units of the smaller of two spacings, from
/// every other patch that is not turned away.
std::vector<char> areSeparated(
  const Buffer<Patch>& patches, std::size_t count, double distance, const ParallelFor& parallelFor);

/// Marks which of the first candidates.size() patches to keep so that any two are a distance apart, in units of the
/// smaller of their spacings. Of two candidates that are nearer the first is kept. The patches behind them are no
/// candidates: they all stay.
/// \param candidates marks the patches that may be kept
std::vector<char> thinOut(const Buffer<Patch>& patches, const std::vector<char>& candidates,
  double distance, const ParallelFor& parallelFor);

/// For each of the first `count` patches, the distance of the nearest of the others that is not turned away, in units
/// of its own spacing, or `most` if that is less. A patch is not its own neighbour.
std::vector<double> clearances(const Buffer<Patch>& patches, std::size_t count,
  const Buffer<Patch>& others, double most, const ParallelFor& parallelFor);

/// Selects the first `count` patches in a given order. A patch nearer than a distance (see thinOut) to one before it is
/// passed over, as long as there are enough others.
/// \param order indices of patches, the best first
/// \return indices of patches
std::vector<int> selectSeparated(const Buffer<Patch>& patches, const std::vector<int>& order,
  std::size_t count, double distance, const ParallelFor& parallelFor);

/// For each sample, whether no patch stands on the piece of surface around it.
std::vector<char> findUncovered(const std::vector<SurfaceProxy::Sample>& samples,
  const Buffer<Patch>& patches, const ParallelFor& parallelFor);

/// Chooses, one after the other, the marked samples that none chosen before covers. A sample covers another that is
/// nearer than 0.7 of its spacing and not turned away.
std::vector<int> chooseUncovered(const std::vector<SurfaceProxy::Sample>& samples,
  const std::vector<char>& marks, const ParallelFor& parallelFor);

} // namespace hop
