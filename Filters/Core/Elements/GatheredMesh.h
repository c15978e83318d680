#pragma once

#include "Elements/CanonicalOrder.h"
#include "Elements/ElementMesh.h"
#include "Support/Exchange.h"

#include <cstdint>
#include <vector>

namespace hop
{

/// What ranks know of each other's meshes.
struct MeshSize
{
  std::int64_t elements = 0;
  std::int64_t coefficients = 0;
  /// 0 where no element is rational.
  std::int64_t weights = 0;
  std::int64_t exactFields = 0;
  std::int64_t exactCoefficients = 0;
  /// Cells of the input, with and without surface.
  std::int64_t cells = 0;
};

/// \param cells of this rank's input
inline MeshSize sizeOf(const ElementMesh& mesh, std::int64_t cells)
{
  return { static_cast<std::int64_t>(mesh.elements.size()),
    static_cast<std::int64_t>(mesh.coefficients.size()),
    static_cast<std::int64_t>(mesh.weights.size()),
    static_cast<std::int64_t>(mesh.exactFields.size()),
    static_cast<std::int64_t>(mesh.exactCoefficients.size()), cells };
}

/// Where an element came from.
struct ElementHome
{
  int rank = 0;
  /// Its index in that rank's mesh.
  int element = 0;
};

/// The elements of all ranks in one rank's memory, in their canonical order. Their cells are numbered through: first
/// the cells of rank 0, then the cells of rank 1, and so on.
struct GatheredMesh
{
  ElementMesh mesh;
  /// One an element.
  std::vector<ElementHome> homes;
};

/// Room for the meshes of all ranks.
/// \throw std::length_error if there are more elements than can be numbered
GatheredMesh roomFor(const std::vector<MeshSize>& sizes);

/// Fills the room of one rank, the worker, with the meshes of all ranks. Every rank calls it.
/// \param mine without neighbours; it may be empty. A rank that is alone loses its coefficients, which are moved.
/// \param sizes of all ranks' meshes
/// \param all roomFor(sizes) on the worker, not used on other ranks
void gatherMesh(Exchange& exchange, int worker, ElementMesh& mine,
  const std::vector<MeshSize>& sizes, GatheredMesh& all);

/// The same of some of every rank's elements. It needs no memory beside the room: a rank without memory would leave the
/// others waiting for its messages.
/// \param part the chosen elements of this rank (pickElements()); it may be emptied
/// \param homes of these elements
/// \param sizes of all ranks' parts, with the cells of their whole meshes
void gatherElements(Exchange& exchange, int worker, ElementMesh& part,
  const std::vector<ElementHome>& homes, const std::vector<MeshSize>& sizes, GatheredMesh& all);

/// Some elements of a mesh, as a mesh without neighbours.
ElementMesh pickElements(const ElementMesh& mesh, const std::vector<int>& chosen);

/// Puts gathered elements into their canonical order.
void orderCanonically(GatheredMesh& all, const ParallelFor& parallelFor);

} // namespace hop
