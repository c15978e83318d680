#include "FaceJumps.h"

#include "ActiveFaces.h"
#include "FaceCrossings.h"

#include <atomic>
#include <cmath>
#include <numeric>

namespace hop
{
namespace
{

std::size_t slotOf(int element, int face)
{
  return static_cast<std::size_t>(element) * MaximumFaces + face;
}

/// Whether two elements may disagree on the face between them.
bool mayJump(const ElementMesh& mesh, int element, int face)
{
  // What rounding to single precision leaves of equal values.
  constexpr double rounding = 1e-6;
  const FaceNeighbor& neighbor = mesh.neighbor(element, face);
  const BernsteinForm here = mesh.form(element);
  const BernsteinForm there = mesh.form(neighbor.element);
  if (here.domain != there.domain || here.degrees != there.degrees)
  {
    return true;
  }
  const auto cornerValue = [](const BernsteinForm& form, int corner)
  {
    return controlPoint(form,
      coefficientIndex(
        form.domain, form.degrees, cornerLatticePoint(form.domain, form.degrees, corner)))
      .w;
  };
  const Range range = fieldRange(here);
  const double scale = std::max(std::abs(range.lower), std::abs(range.upper));
  const Face& which = facts(here.domain).faces[face];
  for (int c = 0; c < which.cornerCount; ++c)
  {
    const double jump =
      cornerValue(here, which.corners[c]) - cornerValue(there, neighbor.corners[c]);
    if (!(std::abs(jump) <= rounding * scale))
    {
      return true;
    }
  }
  return false;
}

/// Where the boxes of each element begin; they come in the order of the elements.
std::vector<std::size_t> boxRanges(const std::vector<SurfaceBox>& boxes, std::size_t elements)
{
  std::vector<std::size_t> first(elements + 1, 0);
  for (const SurfaceBox& box : boxes)
  {
    ++first[box.middle.element + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

class JumpFinder
{
public:
  JumpFinder(const Isosurface& surface, const SurfaceProxy& proxy)
    : Surface(surface)
    , Mesh(*surface.mesh)
    , Proxy(proxy)
    , Everywhere(this->Mesh.elements.size() * MaximumFaces, 0.0f)
    , OfElement(this->Mesh.elements.size())
    , FirstBox(boxRanges(proxy.boxes(), this->Mesh.elements.size()))
  {
  }

  FaceJumps run(const ParallelFor& parallelFor);

private:
  /// What was seen at a face, and the face on its other side.
  struct Finding
  {
    std::size_t here = 0;
    std::size_t there = 0;
    /// Infinite where the sides agree.
    float gap = std::numeric_limits<float>::infinity();
    bool turns = false;
  };

  /// One walker stays on the face as if the surface ended there, the other passes it.
  struct Walkers
  {
    SurfaceWalker along;
    SurfaceWalker across;
  };

  std::optional<Finding> look(const FaceCrossing& crossing, double spacing, Walkers& walkers) const;
  void lookAtElement(int element, Walkers& walkers);
  bool mayBeOpen(int element, int face) const;

  Isosurface Surface;
  const ElementMesh& Mesh;
  const SurfaceProxy& Proxy;
  /// Gaps by which the surface may end at all faces.
  std::vector<float> Everywhere;
  std::vector<std::vector<Finding>> OfElement;
  std::vector<std::size_t> FirstBox;
};

/// What the surface does at the place of a crossing; nothing where it does not reach the face, or nothing
/// lies behind.
std::optional<JumpFinder::Finding> JumpFinder::look(
  const FaceCrossing& crossing, double spacing, Walkers& walkers) const
{
  const int element = crossing.location.element;
  const Face& face = facts(this->Mesh.elements[element].domain).faces[crossing.face];
  Evaluated here;
  if (!walkers.along.project(crossing.location, 4.0 * spacing, here, true) ||
    faceMargin(face, here.location.u) > OnFace)
  {
    return std::nullopt;
  }
  const auto behind = walkers.across.behind(here.location, crossing.face);
  if (!behind)
  {
    return std::nullopt;
  }
  const double largest = LargestJumpPerSpacing * spacing;
  Finding finding{ slotOf(element, crossing.face),
    slotOf(behind->at.location.element, behind->face) };
  if (!(SurfaceWalker::missBetween(this->Mesh, here, crossing.face, *behind) <= largest))
  {
    finding.gap = static_cast<float>(largest);
  }
  else
  {
    const WorldVector& before = here.point.gradient;
    const WorldVector& after = behind->at.point.gradient;
    finding.turns = dot(before, after) < KinkCosine * length(after) * length(before);
  }
  return finding;
}

/// Whether there may be something behind a face that the mesh does not join.
bool JumpFinder::mayBeOpen(int element, int face) const
{
  return this->Mesh.neighbor(element, face).element < 0 && this->Surface.locator &&
    this->Surface.locator->mayGoOn(element, face);
}

/// A few looks at a face are enough to see a kink: at the first, second, fourth ... box. Jumps are looked
/// for at all of them, but one is enough.
void JumpFinder::lookAtElement(int element, Walkers& walkers)
{
  std::array<bool, MaximumFaces> jumps{};
  std::array<bool, MaximumFaces> open{};
  std::array<bool, MaximumFaces> wanted{};
  std::array<unsigned, MaximumFaces> boxesSeen{};
  const auto faceCount = static_cast<int>(facts(this->Mesh.elements[element].domain).faces.size());
  for (int f = 0; f < faceCount; ++f)
  {
    const int behind = this->Mesh.neighbor(element, f).element;
    jumps[f] = behind >= 0 && mayJump(this->Mesh, element, f);
    open[f] = this->mayBeOpen(element, f);
    wanted[f] = jumps[f] || open[f] || element < behind;
  }
  for (std::size_t b = this->FirstBox[element]; b < this->FirstBox[element + 1]; ++b)
  {
    const SurfaceProxy::Sample& sample = this->Proxy.samples()[b];
    std::array<bool, MaximumFaces> seen{};
    visitFaceCrossings(
      this->Mesh, this->Proxy.boxes()[b],
      [&](int face) { return wanted[face] && sample.found && !seen[face]; },
      [&](const FaceCrossing& crossing)
      {
        const int face = crossing.face;
        if (seen[face])
        {
          return;
        }
        seen[face] = true;
        const double spacing = sample.patch.spacing;
        if (open[face])
        {
          const std::size_t slot = slotOf(element, face);
          this->OfElement[element].push_back(
            { slot, slot, static_cast<float>(LargestJumpPerSpacing * spacing) });
        }
        const unsigned before = boxesSeen[face]++;
        if (!jumps[face] && (before & (before + 1)) != 0)
        {
          return;
        }
        if (const auto finding = this->look(crossing, spacing, walkers))
        {
          this->OfElement[element].push_back(*finding);
          wanted[face] = open[face] || !std::isfinite(finding->gap);
        }
      });
  }
}

FaceJumps JumpFinder::run(const ParallelFor& parallelFor)
{
  Isosurface walled = this->Surface;
  walled.gaps = &this->Everywhere;
  walled.walled = true;
  // Jumps and kinks are large beside this.
  walled.tolerance = std::max(this->Surface.tolerance, 0.02 * this->Proxy.smallestSpacing());
  std::atomic<std::int64_t> evaluations{ 0 };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->OfElement.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      Walkers walkers{ SurfaceWalker(walled), SurfaceWalker(this->Surface) };
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        this->lookAtElement(static_cast<int>(e), walkers);
      }
      evaluations += walkers.along.evaluations() + walkers.across.evaluations();
    });
  FaceJumps result;
  result.gaps.assign(this->Everywhere.size(), std::numeric_limits<float>::infinity());
  result.kinks.assign(this->Everywhere.size(), 0);
  for (const std::vector<Finding>& findings : this->OfElement)
  {
    for (const Finding& finding : findings)
    {
      for (const std::size_t slot : { finding.here, finding.there })
      {
        result.gaps[slot] = std::min(result.gaps[slot], finding.gap);
        result.kinks[slot] = result.kinks[slot] || finding.turns;
      }
    }
  }
  result.evaluations = evaluations;
  return result;
}

} // namespace

FaceJumps findFaceJumps(
  const Isosurface& surface, const SurfaceProxy& proxy, const ParallelFor& parallelFor)
{
  return JumpFinder(surface, proxy).run(parallelFor);
}

} // namespace hop
