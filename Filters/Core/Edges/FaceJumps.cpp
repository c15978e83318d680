#include "Edges/FaceJumps.h"

#include "Edges/FaceCrossings.h"
#include "Edges/SampleComparison.h"
#include "Surface/ActiveFaces.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

/// What the two sides of a face do on the surface they also do nearer to it than this, in units of the
/// spacing.
constexpr double nearSurface = 0.2;
/// Sides that jump each other by less than this, in units of the largest jump that may be passed, as
/// estimated from what they differ by on the whole face, are taken to agree.
constexpr double smallJump = 0.5;
/// Nor is it looked at where they jump each other by less than this, in units of the spacing, as far as
/// samples tell.
constexpr double clearJump = 0.1;
/// Smaller turns and steps (see FaceJumps::dihedralAngles) are none: 1.5 degrees.
constexpr double smallestAngle = 0.026;
/// The largest angle that a step counts as.
constexpr double largestStep = 0.99 * CreaseAngle;

/// The lattice of an element's face: from its first corner along the edges to the second and to the last.
struct FaceLattice
{
  FaceLattice(const Element& element, const std::array<int, 3>& corners)
    : Domain(element.domain)
    , Degrees(element.degrees)
  {
    for (int c = 0; c < 3; ++c)
    {
      const LatticePoint at = cornerLatticePoint(this->Domain, this->Degrees, corners[c]);
      this->Corners[c] = { at.i, at.j, at.k };
    }
  }

  glm::ivec3 along(int edge) const { return this->Corners[edge] - this->Corners[0]; }
  int steps(int edge) const
  {
    const glm::ivec3 size = glm::abs(this->along(edge));
    return std::max({ size.x, size.y, size.z });
  }

  /// Index of the coefficient that many steps along the two edges.
  int index(int first, int second) const
  {
    const glm::ivec3 at = this->Corners[0] + first * this->along(1) / this->steps(1) +
      second * this->along(2) / this->steps(2);
    return coefficientIndex(this->Domain, this->Degrees, { at.x, at.y, at.z });
  }

  hop::Domain Domain;
  hop::Degrees Degrees;
  std::array<glm::ivec3, 3> Corners{};
};

/// By how much the coefficients of two elements differ at most on the face between them, and so the values;
/// infinite where they cannot be compared.
double differenceAt(const ElementMesh& mesh, int element, int face)
{
  const FaceNeighbor& neighbor = mesh.neighbor(element, face);
  const Element& here = mesh.elements[element];
  const Element& there = mesh.elements[neighbor.element];
  const Face& from = facts(here.domain).faces[face];
  const int sides = from.cornerCount;
  const auto* corners = neighbor.corners.data();
  const bool isFolded = std::any_of(
    corners, corners + sides, [&](int c) { return std::count(corners, corners + sides, c) > 1; });
  if (isFolded || here.rational || there.rational ||
    facts(there.domain).faces[neighbor.face].cornerCount != sides)
  {
    return std::numeric_limits<double>::infinity();
  }
  const FaceLattice mine(here, { from.corners[0], from.corners[1], from.corners[sides - 1] });
  const FaceLattice other(there, { corners[0], corners[1], corners[sides - 1] });
  if (mine.steps(1) != other.steps(1) || mine.steps(2) != other.steps(2))
  {
    return std::numeric_limits<double>::infinity();
  }
  double largest = 0.0;
  for (int i = 0; i <= mine.steps(1); ++i)
  {
    const int last = sides == 3 ? mine.steps(2) - i : mine.steps(2);
    for (int j = 0; j <= last; ++j)
    {
      const double difference = mesh.form(element).coefficients[mine.index(i, j)].w -
        mesh.form(neighbor.element).coefficients[other.index(i, j)].w;
      largest = std::max(largest, std::abs(difference));
    }
  }
  return largest;
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
    , Samples(this->Mesh, proxy)
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
    float jumpTolerance = std::numeric_limits<float>::infinity();
    float dihedralAngle = 0.0f;
  };

  /// One walker stays on the face as if the surface ended there, the other passes it.
  struct Walkers
  {
    SurfaceWalker along;
    SurfaceWalker across;
  };

  /// What is known of a face of an element, while the boxes there are gone through.
  struct FaceState
  {
    int neighbor = -1;
    /// By which its two sides differ at most.
    double difference = 0.0;
    /// See mayBeOpen().
    bool open = false;
    /// There may be more to see.
    bool wanted = false;
    unsigned boxesSeen = 0;
  };

  FaceState stateOf(int element, int face) const;
  std::optional<Finding> look(const FaceCrossing& crossing, double spacing, Walkers& walkers) const;
  void lookAtCrossing(const FaceCrossing& crossing, const SurfaceProxy::Sample& sample,
    FaceState& face, Walkers& walkers);
  void lookAtElement(int element, Walkers& walkers);
  bool mayBeOpen(int element, int face) const;
  bool mayJump(
    const FaceCrossing& crossing, const SurfaceProxy::Sample& sample, double difference) const;

  Isosurface Surface;
  const ElementMesh& Mesh;
  const SurfaceProxy& Proxy;
  /// Gaps by which the surface may end at all faces.
  std::vector<float> Everywhere;
  std::vector<std::vector<Finding>> OfElement;
  SampleComparison Samples;
};

/// What the surface does at the place of a crossing; nothing where it does not reach the face, or nothing
/// lies behind.
std::optional<JumpFinder::Finding> JumpFinder::look(
  const FaceCrossing& crossing, double spacing, Walkers& walkers) const
{
  const int element = crossing.location.element;
  const Face& face = this->Mesh.face(element, crossing.face);
  Evaluated here = walkers.along.evaluate(crossing.location);
  const bool isNear =
    std::abs(here.point.value) <= nearSurface * spacing * length(here.point.gradient);
  if (!isNear &&
    (!walkers.along.project(crossing.location, 4.0 * spacing, here, true) ||
      faceMargin(face, here.location.u) > OnFace))
  {
    return std::nullopt;
  }
  const auto behind = walkers.across.behind(here, crossing.face);
  if (!behind)
  {
    return std::nullopt;
  }
  const double largest = LargestJumpPerSpacing * spacing;
  Finding finding{ faceSlot(element, crossing.face),
    faceSlot(behind->at.location.element, behind->face) };
  const double jump = SurfaceWalker::jumpBetween(this->Mesh, here, crossing.face, *behind);
  if (!(jump <= largest))
  {
    finding.jumpTolerance = static_cast<float>(largest);
  }
  else
  {
    const double angle = std::max(angleBetween(here.point.gradient, behind->at.point.gradient),
      std::min(jump / spacing, largestStep));
    finding.dihedralAngle = angle >= smallestAngle ? static_cast<float>(angle) : 0.0f;
  }
  return finding;
}

/// Whether there may be something behind a face that the mesh does not join.
bool JumpFinder::mayBeOpen(int element, int face) const
{
  return this->Mesh.neighbor(element, face).element < 0 && this->Surface.locator &&
    this->Surface.locator->mayGoOn(element, face);
}

/// Whether the sides may jump each other at a crossing, if they differ by no more than that: the field
/// changes along the face at least as much as it does between the corners of the box.
bool JumpFinder::mayJump(
  const FaceCrossing& crossing, const SurfaceProxy::Sample& sample, double difference) const
{
  const glm::dvec3 edge =
    glm::inverse(glm::dmat3(sample.anchor.pull)) * (crossing.ends[1] - crossing.ends[0]);
  const double largest = smallJump * LargestJumpPerSpacing * sample.patch.spacing;
  return !(difference * glm::length(edge) <= largest * crossing.rise);
}

JumpFinder::FaceState JumpFinder::stateOf(int element, int face) const
{
  FaceState state;
  state.neighbor = this->Mesh.neighbor(element, face).element;
  state.difference = state.neighbor >= 0 ? differenceAt(this->Mesh, element, face) : 0.0;
  state.open = this->mayBeOpen(element, face);
  // Creases are looked for from one side.
  state.wanted = state.difference > 0.0 || state.open || element < state.neighbor;
  return state;
}

/// Looks at a face where a box crosses it, if that may tell something new. A few looks are enough to see a
/// crease: at the first, second, fourth ... box. Jumps are looked for at all of them, but one is enough.
void JumpFinder::lookAtCrossing(const FaceCrossing& crossing, const SurfaceProxy::Sample& sample,
  FaceState& face, Walkers& walkers)
{
  const int element = crossing.location.element;
  const double spacing = sample.patch.spacing;
  std::vector<Finding>& findings = this->OfElement[element];
  if (face.open)
  {
    const std::size_t slot = faceSlot(element, crossing.face);
    findings.push_back({ slot, slot, static_cast<float>(LargestJumpPerSpacing * spacing) });
  }
  const unsigned before = face.boxesSeen++;
  const bool forCreases = (before & (before + 1)) == 0 &&
    (face.open || (element < face.neighbor && !this->Samples.isSmoothTo(sample, face.neighbor)));
  if (forCreases ||
    (this->mayJump(crossing, sample, face.difference) &&
      !this->Samples.meet(crossing, sample, clearJump)))
  {
    if (const auto finding = this->look(crossing, spacing, walkers))
    {
      findings.push_back(*finding);
      face.wanted = face.open || !std::isfinite(finding->jumpTolerance);
    }
  }
}

void JumpFinder::lookAtElement(int element, Walkers& walkers)
{
  const auto [firstBox, lastBox] = this->Proxy.boxesOf(element);
  std::array<FaceState, MaximumFaces> faces{};
  const auto faceCount = static_cast<int>(facts(this->Mesh.elements[element].domain).faces.size());
  for (int f = 0; f < faceCount && firstBox < lastBox; ++f)
  {
    faces[f] = this->stateOf(element, f);
  }
  for (std::size_t b = firstBox; b < lastBox; ++b)
  {
    const SurfaceProxy::Sample& sample = this->Proxy.samples()[b];
    std::array<bool, MaximumFaces> seen{};
    visitFaceCrossings(
      this->Mesh, this->Proxy.boxes()[b],
      [&](int face) { return faces[face].wanted && sample.found && !seen[face]; },
      [&](const FaceCrossing& crossing)
      {
        if (!seen[crossing.face])
        {
          seen[crossing.face] = true;
          this->lookAtCrossing(crossing, sample, faces[crossing.face], walkers);
        }
      });
  }
}

FaceJumps JumpFinder::run(const ParallelFor& parallelFor)
{
  Isosurface walled = this->Surface.withWalls();
  walled.jumpTolerances = &this->Everywhere;
  // Jumps and creases are large beside this.
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
  result.jumpTolerances.assign(this->Everywhere.size(), std::numeric_limits<float>::infinity());
  result.dihedralAngles.assign(this->Everywhere.size(), 0.0f);
  for (const std::vector<Finding>& findings : this->OfElement)
  {
    for (const Finding& finding : findings)
    {
      for (const std::size_t slot : { finding.here, finding.there })
      {
        result.jumpTolerances[slot] = std::min(result.jumpTolerances[slot], finding.jumpTolerance);
        result.dihedralAngles[slot] = std::max(result.dihedralAngles[slot], finding.dihedralAngle);
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
