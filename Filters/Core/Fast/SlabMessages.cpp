#include "Fast/SlabMessages.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace hop
{
namespace
{

template <class Particles>
void write(const Particles& particles, Bytes& bytes)
{
  using Item = typename Particles::value_type;
  const auto count = static_cast<std::int64_t>(particles.size());
  const std::size_t size = particles.size() * sizeof(Item);
  const std::size_t begin = bytes.size();
  bytes.resize(begin + sizeof(count) + size);
  std::memcpy(bytes.data() + begin, &count, sizeof(count));
  if (size > 0)
  {
    std::memcpy(bytes.data() + begin + sizeof(count), particles.data(), size);
  }
}

template <class Particles>
void read(const unsigned char*& from, Particles& particles)
{
  using Item = typename Particles::value_type;
  std::int64_t count = 0;
  std::memcpy(&count, from, sizeof(count));
  from += sizeof(count);
  particles.resize(static_cast<std::size_t>(count));
  if (count > 0)
  {
    std::memcpy(particles.data(), from, particles.size() * sizeof(Item));
  }
  from += particles.size() * sizeof(Item);
}

/// Calls with the element of each particle.
template <class Particles, class Use>
void visitElements(Particles& particles, const Use& use)
{
  for (auto& anchor : particles.anchors)
  {
    use(anchor.place.element);
  }
  for (auto* some : { &particles.onBoundary, &particles.thinned })
  {
    for (auto& one : *some)
    {
      use(one.particle.location.element);
    }
  }
}

} // namespace

ElementsByHome::ElementsByHome(const std::vector<ElementHome>& homes)
{
  for (std::size_t e = 0; e < homes.size(); ++e)
  {
    this->Elements.push_back({ { homes[e].rank, homes[e].element }, static_cast<int>(e) });
  }
  std::sort(this->Elements.begin(), this->Elements.end());
}

int ElementsByHome::elementOf(const ElementHome& home) const
{
  const std::pair<int, int> wanted(home.rank, home.element);
  const auto found = std::lower_bound(this->Elements.begin(), this->Elements.end(), wanted,
    [](const auto& entry, const auto& key) { return entry.first < key; });
  if (found == this->Elements.end() || found->first != wanted)
  {
    throw std::runtime_error("a particle beside a cut lies in a cell that its neighbour lacks");
  }
  return found->second;
}

Bytes written(const SlabParticles& particles, const std::vector<ElementHome>& homes)
{
  Bytes bytes;
  write(particles.anchors, bytes);
  write(particles.patches, bytes);
  write(particles.onBoundary, bytes);
  write(particles.thinned, bytes);
  std::vector<ElementHome> ofParticles;
  visitElements(particles, [&](int element) { ofParticles.push_back(homes[element]); });
  write(ofParticles, bytes);
  return bytes;
}

SlabParticles readParticles(const Bytes& bytes, const ElementsByHome& elements)
{
  SlabParticles particles;
  if (bytes.empty())
  {
    return particles;
  }
  const unsigned char* from = bytes.data();
  read(from, particles.anchors);
  read(from, particles.patches);
  read(from, particles.onBoundary);
  read(from, particles.thinned);
  std::vector<ElementHome> homes;
  read(from, homes);
  auto home = homes.begin();
  visitElements(particles, [&](int& element) { element = elements.elementOf(*home++); });
  return particles;
}

} // namespace hop
