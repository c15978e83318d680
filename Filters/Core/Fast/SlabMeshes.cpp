#include "Fast/SlabMeshes.h"

#include "Elements/CornerNumbers.h"
#include "Elements/SlabElements.h"
#include "Fast/SlabDistribution.h"
#include "Fast/SlabWorkers.h"

namespace hop
{
namespace
{

class SlabGathering
{
public:
  SlabGathering(Exchange& exchange, const std::vector<Slab>& slabs, bool isSound)
    : Ranks(exchange)
    , Slabs(slabs)
    , IsSound(isSound)
  {
  }

  SlabMeshes run(
    const ElementMesh& mine, std::int64_t cells, double spacing, const ParallelFor& parallelFor);

private:
  template <class Use>
  bool attempt(const Use& use)
  {
    return attemptOnAll(this->Ranks, this->IsSound, this->Result.failure, use);
  }
  bool gather(const ElementMesh& mine, std::int64_t cells, const Slab& slab, int worker,
    GatheredMesh& all, const ParallelFor& parallelFor);

  Exchange& Ranks;
  const std::vector<Slab>& Slabs;
  bool IsSound;
  SlabMeshes Result;
};

/// Gathers the elements of one slab, so that no rank keeps copies for more than one.
bool SlabGathering::gather(const ElementMesh& mine, std::int64_t cells, const Slab& slab,
  int worker, GatheredMesh& all, const ParallelFor& parallelFor)
{
  std::vector<ElementHome> homes;
  ElementMesh part;
  if (!this->attempt(
        [&]()
        {
          const std::vector<int> chosen = elementsIn(mine, slab, parallelFor);
          part = pickElements(mine, chosen);
          homes.reserve(chosen.size());
          for (const int element : chosen)
          {
            homes.push_back({ this->Ranks.rank(), element });
          }
        }))
  {
    return false;
  }
  const std::vector<MeshSize> sizes = gatherFromAll(this->Ranks, sizeOf(part, cells));
  if (!this->attempt(
        [&]()
        {
          if (this->Ranks.rank() == worker)
          {
            all = roomFor(sizes);
          }
        }))
  {
    return false;
  }
  gatherElements(this->Ranks, worker, part, homes, sizes, all);
  return true;
}

SlabMeshes SlabGathering::run(
  const ElementMesh& mine, std::int64_t cells, double spacing, const ParallelFor& parallelFor)
{
  std::vector<GatheredMesh>& meshes = this->Result.meshes;
  if (!this->attempt([&]() { meshes.resize(this->Slabs.size()); }))
  {
    return std::move(this->Result);
  }
  for (std::size_t slab = 0; slab < meshes.size(); ++slab)
  {
    if (!this->gather(mine, cells, this->Slabs[slab].widened(SlabOverlap::Reach * spacing),
          rankOfSlab(slab, meshes.size(), this->Ranks.size()), meshes[slab], parallelFor))
    {
      return std::move(this->Result);
    }
  }
  this->Result.isComplete = this->attempt(
    [&]()
    {
      for (GatheredMesh& all : meshes)
      {
        if (!all.mesh.elements.empty())
        {
          orderCanonically(all, parallelFor);
          joinElements(all.mesh, parallelFor);
        }
      }
    });
  return std::move(this->Result);
}

} // namespace

SlabMeshes gatherSlabs(Exchange& exchange, const ElementMesh& mine, std::int64_t cells,
  const std::vector<Slab>& slabs, double spacing, bool isSound, const ParallelFor& parallelFor)
{
  return SlabGathering(exchange, slabs, isSound).run(mine, cells, spacing, parallelFor);
}

} // namespace hop
