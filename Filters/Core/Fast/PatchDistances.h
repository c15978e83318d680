#pragma once

#include "Isolation/SurfaceProxy.h"

#include <vector>

namespace hop
{

/// Particles that a round of relaxation has squeezed nearer to a boundary curve than this, in units of their spacing, are
/// dropped, as is one of two that are that near in the end: where a strip between boundary curves has no room for both.
inline constexpr double Squeezed = 0.65;

/// For each of the first `count` patches, whether it keeps that distance, in units of its spacing, from
/// all others that are not turned away.
std::vector<char> areFarFrom(const Buffer<Patch>& patches, std::size_t count,
  const Buffer<Patch>& others, double distance, const ParallelFor& parallelFor);

/// For each of the first `count` patches, whether it keeps that distance, in units of the smaller of two
/// spacings, from every other patch that is not turned away.
std::vector<char> areAlone(
  const Buffer<Patch>& patches, std::size_t count, double distance, const ParallelFor& parallelFor);

/// For each of the first wanted.size() patches, whether to keep it if any two are to be that far apart, in
/// units of the smaller of their spacings: of two that are wanted the first stays, and those behind all these
/// do.
std::vector<char> thinOut(const Buffer<Patch>& patches, const std::vector<char>& wanted,
  double distance, const ParallelFor& parallelFor);

/// For each of the first `count` patches, how far the nearest of the others is that is not turned away, in units
/// of its spacing, or `most` if that is less. A patch is not its own other.
std::vector<double> clearances(const Buffer<Patch>& patches, std::size_t count,
  const Buffer<Patch>& others, double most, const ParallelFor& parallelFor);

/// The `count` first of some patches in a new order, but for those nearer than a distance (see thinOut) to one
/// before, as long as there are enough others.
/// \param order indices, the one wanted most first
/// \return indices of patches
std::vector<int> chooseApart(const Buffer<Patch>& patches, const std::vector<int>& order,
  std::size_t count, double distance, const ParallelFor& parallelFor);

/// For each sample, whether no patch stands on the piece of surface around it.
std::vector<char> findLonely(const std::vector<SurfaceProxy::Sample>& samples,
  const Buffer<Patch>& patches, const ParallelFor& parallelFor);

/// Of the samples that are marked, one after the other, those that none chosen before covers: by standing
/// nearer than 0.7 of its spacing, and not turned away.
std::vector<int> chooseUncovered(const std::vector<SurfaceProxy::Sample>& samples,
  const std::vector<char>& marks, const ParallelFor& parallelFor);

} // namespace hop
