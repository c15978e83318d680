#include "Edges/CreaseSpacings.h"

#include "Edges/FaceCrossings.h"

#include <atomic>
#include <cmath>

namespace hop
{
namespace
{

/// Largest distance of places along a crease, in units of the spacing there. Chosen by experiment: a larger one lets
/// spacings rise between places (SizingField::GradationSlope times the distance), a smaller one costs evaluations.
constexpr double placesPerSpacing = 0.5;

using SpacingLimit = SizingField::Limit;

class CreaseSampler
{
public:
  CreaseSampler(const Isosurface& surface, const SurfaceProxy& proxy, const FaceJumps& jumps)
    : Mesh(*surface.mesh)
    , Proxy(proxy)
    , DihedralAngles(jumps.dihedralAngles)
    , Walker(surface)
  {
  }

  void addBox(std::size_t box, std::vector<SpacingLimit>& limits);
  std::int64_t evaluations() const { return this->Walker.evaluations(); }

private:
  void addSegment(
    const FaceCrossing& from, const FaceCrossing& to, std::vector<SpacingLimit>& limits);
  SpacingLimit limitAt(const Location& place, int face);

  const ElementMesh& Mesh;
  const SurfaceProxy& Proxy;
  const std::vector<float>& DihedralAngles;
  SurfaceWalker Walker;
};

/// The spacing wanted at a place on a face, by the dihedral angle there.
SpacingLimit CreaseSampler::limitAt(const Location& place, int face)
{
  const Evaluated here = this->Walker.evaluate(place);
  const auto behind = this->Walker.behind(here, face);
  const WorldVector& before = here.point.gradient;
  const WorldVector after = behind ? behind->at.point.gradient : before;
  const double angle = angleBetween(before, after);
  return { here.point.map.position.xyz,
    static_cast<float>(spacingAtCrease(this->Proxy.sizing(), angle > CreaseAngle ? angle : 0.0)) };
}

/// Adds places on the line between two crossings, which stands for the crease in the box.
void CreaseSampler::addSegment(
  const FaceCrossing& from, const FaceCrossing& to, std::vector<SpacingLimit>& limits)
{
  const SpacingLimit first = this->limitAt(from.location, from.face);
  const SpacingLimit last = this->limitAt(to.location, from.face);
  limits.insert(limits.end(), { first, last });
  const double step = placesPerSpacing * std::min(first.spacing, last.spacing);
  const auto count =
    static_cast<int>(std::ceil(glm::distance(first.position, last.position) / step));
  for (int n = 1; n < count; ++n)
  {
    const glm::dvec3 u =
      glm::mix(from.location.u.xyz, to.location.u.xyz, n / static_cast<double>(count));
    limits.push_back(this->limitAt({ from.location.element, { u } }, from.face));
  }
}

/// Adds places on the creases that a box shows.
void CreaseSampler::addBox(std::size_t box, std::vector<SpacingLimit>& limits)
{
  const int element = this->Proxy.boxes()[box].middle.element;
  const auto isCrease = [&](int face)
  {
    const int behind = this->Mesh.neighbor(element, face).element;
    // Joined faces are looked at from one side only.
    return this->DihedralAngles[faceSlot(element, face)] > CreaseAngle &&
      (behind < 0 || element < behind);
  };
  // Crossings of one side of the box come in pairs.
  std::optional<FaceCrossing> entered;
  visitFaceCrossings(this->Mesh, this->Proxy.boxes()[box], isCrease,
    [&](const FaceCrossing& crossing)
    {
      if (entered && entered->face == crossing.face)
      {
        this->addSegment(*entered, crossing, limits);
        entered.reset();
      }
      else
      {
        entered = crossing;
      }
    });
}

} // namespace

std::vector<SizingField::Limit> findCreaseSpacings(const Isosurface& surface,
  const SurfaceProxy& proxy, const FaceJumps& jumps, const ParallelFor& parallelFor,
  std::int64_t& evaluations)
{
  if (proxy.sizing().angularDensity == 0.0)
  {
    return {};
  }
  std::vector<std::vector<SpacingLimit>> ofBox(proxy.boxes().size());
  std::atomic<std::int64_t> cost{ 0 };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(ofBox.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      CreaseSampler sampler(surface, proxy, jumps);
      for (std::ptrdiff_t b = begin; b < end; ++b)
      {
        sampler.addBox(b, ofBox[b]);
      }
      cost += sampler.evaluations();
    });
  evaluations += cost;
  std::vector<SpacingLimit> limits;
  for (const std::vector<SpacingLimit>& some : ofBox)
  {
    std::copy_if(some.begin(), some.end(), std::back_inserter(limits),
      [&](const SpacingLimit& limit)
      { return limit.spacing < static_cast<float>(proxy.sizing().spacing); });
  }
  return limits;
}

} // namespace hop
