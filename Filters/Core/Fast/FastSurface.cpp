#include "Fast/FastSystem.h"

#include "Edges/CreaseSpacings.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace hop
{
namespace
{

/// Largest diagonals of the boxes in which the surface is sampled, in units of the spacing there: a box then holds some
/// five particles. Chosen by experiment. Smaller boxes cost more evaluations; in larger ones a single sample tells the
/// area and the spacing less exactly, and with them the number of particles.
struct BoxDiagonal
{
  static constexpr double Hexahedron = 6.0;
  /// More than in a hexahedron, as wedges and tetrahedra fill less of their bounds.
  static constexpr double Wedge = 7.0;
  static constexpr double Tetrahedron = 7.5;
  /// Where spacings turn out to be limited to less, boxes are kept up to so many times the size. Larger: too few particles
  /// near thin places; smaller: more boxes where spacings change much, up to a quarter more evaluations.
  static constexpr double Kept = 2.0;
  /// For drafts, in all elements. Larger: holes.
  static constexpr double Draft = 9.0;
  /// Where the gradient of the field vanishes nearby (SurfaceBox::risesWeakly), so that one sample tells less.
  static constexpr double Weak = 3.0;
  /// Where the surface is thinner than a spacing: each box gets a particle of its own.
  static constexpr double Thin = 1.0;
  /// Curvature magnitude times spacing from which on the surface counts as thin: its radius is a spacing.
  static constexpr double ThinBend = 1.0;

  static double of(Domain domain)
  {
    switch (domain)
    {
      case Domain::Hexahedron:
        return Hexahedron;
      case Domain::Wedge:
        return Wedge;
      case Domain::Tetrahedron:
        return Tetrahedron;
    }
    unknownDomain();
  }
};

/// Spacing at which particles are counted before memory is allocated, in units of the mesh's diagonal. A flat surface
/// across the mesh takes some 400,000 particles at it, so that no estimate is needed where the spacing asked for is
/// larger. Chosen by experiment. Larger: a cheaper estimate that tells curvature less exactly; smaller: the estimate
/// itself takes time and memory.
constexpr double estimateSpacingPerExtent = 0.001;

/// Marks the particles on curves that the relaxation sees: of those in one place one a sheet, as several would repel
/// others several times.
std::vector<char> onePerSheet(const BoundaryCurves& curves)
{
  std::vector<char> seen(curves.particles.size(), 1);
  std::map<int, std::vector<int>> inPlace;
  for (const auto& [first, other] : curves.edges.coincident)
  {
    std::vector<int>& chosen = inPlace.emplace(first, std::vector<int>{ first }).first->second;
    const WorldVector& normal = curves.particles[other].particle.normal;
    seen[other] = std::none_of(chosen.begin(), chosen.end(),
      [&](int one) { return dot(curves.particles[one].particle.normal, normal) > SheetCosine; });
    if (seen[other])
    {
      chosen.push_back(other);
    }
  }
  return seen;
}

} // namespace

/// Largest diagonal of a box of an element, in units of the spacing there.
double FastSystem::diagonalPerSpacing(int element) const
{
  return this->Parameters.quality == Quality::Draft
    ? BoxDiagonal::Draft
    : BoxDiagonal::of(this->Mesh.elements[element].domain);
}

/// Whether one sample tells enough about the surface in a box. It tells less where the gradient of the field vanishes
/// nearby; where the surface is thinner than a spacing every box gets a particle of its own.
/// \param limits what limits spacings further; nullptr: nothing is known of it yet
bool FastSystem::isFineEnough(
  const SurfaceBox& box, const SizingFunction& sizing, const SurfaceProxy* limits)
{
  const int element = box.middle.element;
  const double perSpacing = this->diagonalPerSpacing(element);
  const double largest = perSpacing * sizing.spacing;
  const double smallest =
    (box.mayBeThin ? 1.0 : perSpacing) * (limits ? limits->smallestSpacing() : sizing.smallest());
  if (this->isOutOfReach(box) || this->isFarBeyondPolygon(box))
  {
    return true;
  }
  if (box.size > largest || box.size <= smallest ||
    (sizing.angularDensity == 0.0 && !box.mayBeThin && !limits))
  {
    return box.size <= largest;
  }
  ++this->Evaluations;
  Anchor anchor;
  Patch patch;
  const Location place{ element, proxyMiddle(this->Mesh.elements[element].domain, box) };
  const Jet jet = exactHessian(this->Mesh, place);
  if (!anchorPatch(place, jet, this->Surface.isovalue, anchor, patch))
  {
    return true;
  }
  const double bend = patch.curvatureMagnitude();
  const double spacing =
    limits ? limits->spacingAt(patch.position, patch.curvatureMagnitude()) : sizing.at(bend);
  const bool isThin = bend * spacing > BoxDiagonal::ThinBend ||
    (box.risesWeakly && std::abs(anchor.offset) > MovingParticles::SeedOffset * spacing);
  const double perOwnSpacing = isThin ? BoxDiagonal::Thin
    : box.risesWeakly                 ? BoxDiagonal::Weak
                                      : perSpacing;
  return box.size <= perOwnSpacing * spacing;
}

/// Whether a box is so far from the slab that no particles are wanted in it.
bool FastSystem::isOutOfReach(const SurfaceBox& box) const
{
  const int element = box.middle.element;
  return !this->ReachesOut.empty() && this->ReachesOut[element] &&
    !this->Part.widened(this->overlap(SlabOverlap::Reach) + box.size)
       .holds(glm::dvec3(evaluateGradient(this->Mesh.form(element), box.middle.u).value));
}

/// The boxes of the surface. Where they are too many for the memory, the surface is followed no further.
/// \param isFineEnough whether a certified box is small enough
std::vector<SurfaceBox> FastSystem::findBoxes(
  const IsFine& isFineEnough, const KnownBoxes& known, const std::function<void(double)>& progress)
{
  this->BoxCount = 0;
  const auto isLast = [&](const SurfaceBox& box)
  {
    const bool ends = this->hasTooManyBoxes() || isFineEnough(box);
    this->BoxCount += ends ? 1 : 0;
    return ends;
  };
  std::vector<SurfaceBox> boxes =
    findSurfaceBoxes(this->Mesh, this->Surface.isovalue, isLast, this->Parallel, progress, known);
  this->dropFarBeyondPolygon(boxes);
  return boxes;
}

/// Boxes that were found before: on another distribution of the same surface, or roughly.
KnownBoxes FastSystem::boxesBefore(const IsFine& isFineEnough) const
{
  if (this->Parameters.boxes && !this->Parameters.boxes->empty())
  {
    return { this->Parameters.boxes, [](const SurfaceBox&) { return true; } };
  }
  return { this->RoughBoxes.empty() ? nullptr : &this->RoughBoxes,
    [&](const SurfaceBox& box) { return box.certified && isFineEnough(box); } };
}

/// \param sizing decides how fine the boxes are; the proxy's spacings follow the sizing function that is asked for
/// \param shareOfRun fraction of the run that is over when the surface is found
/// \return a proxy without boxes, and an error in the report, if they are too many
SurfaceProxy FastSystem::proxyOfBoxesAt(const SizingFunction& sizing, double shareOfRun)
{
  const auto isFineEnough = [&](const SurfaceBox& box)
  { return this->isFineEnough(box, sizing, nullptr); };
  // About a particle each, a second's work: what is known of how long it takes while it takes long.
  constexpr std::int64_t manyBoxes = 250'000;
  const auto progress = [&](double share)
  {
    this->Work.raiseFraction(shareOfRun * share);
    if (this->BoxCount > manyBoxes)
    {
      this->Work.raiseExpected(static_cast<double>(this->BoxCount));
    }
  };
  std::vector<SurfaceBox> boxes =
    this->findBoxes(isFineEnough, this->boxesBefore(isFineEnough), progress);
  if (this->hasTooManyBoxes())
  {
    this->Result.report.error = this->Parameters.refusalOfBoxes();
    boxes.clear();
  }
  SurfaceProxy proxy(this->Surface, this->Sizing, std::move(boxes), this->Parallel);
  this->Evaluations += proxy.evaluations();
  return proxy;
}

bool FastSystem::tooMany(double count)
{
  std::string& error = this->Result.report.error;
  error = error.empty() ? this->Parameters.refusal(count) : error;
  return !error.empty();
}

/// Particles along strips of the surface that are narrower than a spacing, as in cells like slivers: more than go by
/// their area. Only boxes many spacings wide count: a surface that is no strip takes more there by its area.
double FastSystem::countAlongStrips(const SurfaceProxy& proxy)
{
  constexpr double narrowest = 100.0; // box, in spacings
  double count = 0.0;
  for (std::size_t b = 0; b < proxy.boxes().size(); ++b)
  {
    const double spacings = proxy.boxes()[b].size / proxy.samples()[b].patch.spacing;
    count += proxy.samples()[b].found && spacings > narrowest ? spacings : 0.0;
  }
  return count;
}

/// Counts the particles on a coarse proxy, before memory is allocated. The proxy's boxes are coarse; its spacings
/// are the ones asked for, as a number that is scaled up from coarse spacings would count curvature twice.
/// \return whether there are few enough
bool FastSystem::estimateCount()
{
  if (this->Parameters.particleCount > 0)
  {
    return !this->tooMany(static_cast<double>(this->Parameters.particleCount));
  }
  const SizingFunction coarse{ meshExtent(this->Mesh) * estimateSpacingPerExtent,
    this->Sizing.angularDensity };
  if (coarse.smallest() <= this->Sizing.smallest())
  {
    return true;
  }
  const SurfaceProxy rough = this->proxyOfBoxesAt(coarse, ProgressAt::Estimated);
  return !this->tooMany(std::max(rough.particleCount(), countAlongStrips(rough)));
}

/// Makes the proxy, and traces the boundary curves. From then on the surface ends where the field jumps, and the
/// sizing function is lowered at creases, but not in drafts.
void FastSystem::prepareSurface()
{
  this->Surface.jumpTolerances = nullptr;
  this->Proxy =
    std::make_unique<SurfaceProxy>(this->proxyOfBoxesAt(this->Sizing, ProgressAt::Isolated));
  this->Work.ask();
  this->findJumps();
  std::int64_t cost = 0;
  std::vector<SizingField::Limit> limits;
  if (this->Parameters.quality != Quality::Draft)
  {
    limits = findCreaseSpacings(this->Surface, *this->Proxy, this->Jumps, this->Parallel, cost);
  }
  limits.insert(
    limits.end(), this->Parameters.spacingLimits.begin(), this->Parameters.spacingLimits.end());
  this->Proxy->limitSpacings(limits, this->Parallel);
  this->refineBoxes(limits);
  this->Work.ask();
  this->traceBoundaryCurves();
  this->Evaluations += cost + this->Curves.evaluations;
}

/// Makes the boxes of elements smaller where spacings are limited to much less than the curvature in a box asks for, as near
/// thin places and creases.
/// \param limits that the proxy has beside those of its samples
void FastSystem::refineBoxes(const std::vector<SizingField::Limit>& limits)
{
  const SurfaceProxy& coarse = *this->Proxy;
  const auto mayStay = [&](const SurfaceBox& box)
  {
    const SurfaceProxy::Sample& sample = coarse.samples()[&box - coarse.boxes().data()];
    const double largest = BoxDiagonal::Kept * this->diagonalPerSpacing(box.middle.element);
    return !box.certified || !sample.found || box.size <= largest * sample.patch.spacing ||
      this->isOutOfReach(box) || this->isFarBeyondPolygon(box);
  };
  if (std::all_of(coarse.boxes().begin(), coarse.boxes().end(), mayStay))
  {
    return;
  }
  std::vector<SurfaceBox> boxes = this->findBoxes([&](const SurfaceBox& box)
    { return this->isFineEnough(box, this->Sizing, &coarse); },
    { &coarse.boxes(), mayStay }, {});
  if (this->hasTooManyBoxes())
  {
    return;
  }
  auto finer = std::make_unique<SurfaceProxy>(coarse, std::move(boxes), limits, this->Parallel);
  this->Evaluations += finer->evaluations();
  this->Proxy = std::move(finer);
}

/// Until the boundary curves are traced the surface passes all jumps.
void FastSystem::findJumps()
{
  this->Surface.jumpTolerances = nullptr;
  this->Jumps = findFaceJumps(this->Surface, *this->Proxy, this->Parallel);
  endAround(this->Surface, this->Parameters.endedElements, this->Jumps);
  this->Evaluations += this->Jumps.evaluations;
}

void FastSystem::traceBoundaryCurves()
{
  this->Surface.jumpTolerances = &this->Jumps.jumpTolerances;
  const Slab inReach = this->Part.widened(this->overlap(SlabOverlap::Reach));
  const bool withCreases = this->Parameters.onCreases && this->CreasesFit;
  this->Curves = findBoundaryCurves(this->Surface, this->Jumps, *this->Proxy, this->Sizing,
    withCreases ? SampledCurves::ForMeshes : SampledCurves::Boundary, this->Parallel, this->Part,
    inReach);
  this->keepCurvesIn(inReach);
  this->BoundaryPatches.clear();
  this->BoundaryCount = 0.0;
  const std::vector<char> seen = onePerSheet(this->Curves);
  for (std::size_t n = 0; n < seen.size(); ++n)
  {
    const BoundaryParticle& boundary = this->Curves.particles[n];
    if (seen[n])
    {
      this->BoundaryPatches.push_back(boundary.patch);
      this->BoundaryCount +=
        boundary.side.exists() || !boundary.isOnCrease ? OnBoundary::Count : 0.0;
    }
  }
}

/// Drops what is on boundary curves outside of a slab.
void FastSystem::keepCurvesIn(const Slab& slab)
{
  if (slab.isEverything())
  {
    return;
  }
  const auto isOutside = [&](const BoundaryParticle& some)
  { return !slab.holds(some.patch.position); };
  for (Buffer<BoundaryParticle>* some : { &this->Curves.particles, &this->Curves.thinned })
  {
    some->erase(std::remove_if(some->begin(), some->end(), isOutside), some->end());
  }
  // Segments are for meshes, which are not made of slabs.
  this->Curves.edges = {};
}

/// Boxes within the slab that isolation could not decide.
std::vector<SurfaceBox> FastSystem::undecidedBoxes()
{
  std::vector<SurfaceBox> undecided;
  for (std::size_t b = 0; b < this->Proxy->boxes().size(); ++b)
  {
    const SurfaceBox& box = this->Proxy->boxes()[b];
    const SurfaceProxy::Sample& sample = this->Proxy->samples()[b];
    const auto position = [&]()
    {
      return sample.found
        ? sample.patch.position
        : glm::dvec3(evaluateGradient(this->Mesh.form(box.middle.element), box.middle.u).value);
    };
    if (!box.certified && this->Part.holds(position()))
    {
      undecided.push_back(box);
    }
  }
  return undecided;
}

} // namespace hop
