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

/// Where faces are looked at: lengths in units of the spacing. Chosen by experiment.
struct Looks
{
  /// Distance from the surface within which a crossing shows what the two sides do on the surface. A larger one
  /// believes values and slopes too far off; with a smaller one more crossings cost Newton's method.
  static constexpr double NearSurface = 0.2;
  /// Largest distance on the way from a crossing to the surface.
  static constexpr double LongestWay = 4.0;
  /// Smallest jump that is worth an evaluation, in units of the largest one that the surface passes, estimated from
  /// what the fields of the two sides differ by anywhere on the face. Less than 1, as the estimate takes F to be
  /// linear; a larger one overlooks jumps, a smaller one costs evaluations.
  static constexpr double SmallestJump = 0.5;
  /// Nor is a jump worth an evaluation if it is smaller than this as far as samples tell.
  static constexpr double MeetingJump = 0.1;
  /// Largest distance from the surface of the places compared, in units of the smallest spacing: jumps and creases are
  /// large beside it.
  static constexpr double Tolerance = 0.02;
};

/// What counts as a dihedral angle, radians.
struct Angles
{
  /// Smaller ones are none: 1.5 degrees. Chosen by experiment: a smaller one gives clip planes to particles where a
  /// picture shows no edge.
  static constexpr double Smallest = 0.026;
  /// The largest angle that a jump counts as: no jump makes a crease.
  static constexpr double LargestOfJump = 0.99 * CreaseAngle;
};

/// The lattice of coefficients on an element's face: from its first corner along the edges to the second corner and to
/// the last one.
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

  /// Index of a coefficient, by the numbers of steps to it along the two edges.
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

/// Largest difference of the coefficients of two elements on the face between them. It bounds the difference of the
/// values (convex hull property of Bernstein polynomials). Infinite where the coefficients cannot be compared.
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
    , EndingEverywhere(this->Mesh.elements.size() * MaximumFaces, 0.0f)
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
    /// See FaceJumps::largestJump.
    double jump = 0.0;
  };

  /// Two walkers: one stays on the face as if the surface ended there, the other passes it.
  struct Walkers
  {
    SurfaceWalker along;
    SurfaceWalker across;
  };

  /// What is known of a face of an element while the element's boxes are gone through.
  struct FaceState
  {
    int neighbor = -1;
    /// See differenceAt().
    double difference = 0.0;
    /// See isUnmatched().
    bool unmatched = false;
    /// There may be more to see.
    bool wanted = false;
    unsigned boxesSeen = 0;
  };

  FaceState stateOf(int element, int face) const;
  std::optional<Finding> look(const FaceCrossing& crossing, double spacing, Walkers& walkers) const;
  void lookAtCrossing(const FaceCrossing& crossing, const SurfaceProxy::Sample& sample,
    FaceState& face, Walkers& walkers);
  void lookAtElement(int element, Walkers& walkers);
  FaceJumps gathered() const;
  bool isUnmatched(int element, int face) const;
  bool mayJump(
    const FaceCrossing& crossing, const SurfaceProxy::Sample& sample, double difference) const;

  Isosurface Surface;
  const ElementMesh& Mesh;
  const SurfaceProxy& Proxy;
  /// Jump tolerances with which the surface may end at every face.
  std::vector<float> EndingEverywhere;
  std::vector<std::vector<Finding>> OfElement;
  SampleComparison Samples;
};

/// What the surface does at a crossing; nothing where it does not reach the face, or where nothing lies behind the
/// face.
std::optional<JumpFinder::Finding> JumpFinder::look(
  const FaceCrossing& crossing, double spacing, Walkers& walkers) const
{
  const int element = crossing.location.element;
  const Face& face = this->Mesh.face(element, crossing.face);
  Evaluated here = walkers.along.evaluate(crossing.location);
  const bool isNear =
    std::abs(here.point.value) <= Looks::NearSurface * spacing * length(here.point.gradient);
  if (!isNear &&
    (!walkers.along.project(crossing.location, Looks::LongestWay * spacing, here, true) ||
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
  const double jump = SurfaceWalker::jumpBetween(this->Mesh, here, *behind);
  if (this->Mesh.neighbor(element, crossing.face).element >= 0)
  {
    finding.jump =
      std::abs(behind->at.point.value - here.point.value) / (spacing * length(here.point.gradient));
  }
  if (!(jump <= largest))
  {
    finding.jumpTolerance = static_cast<float>(largest);
  }
  else
  {
    const double angle = std::max(angleBetween(here.point.gradient, behind->at.point.gradient),
      std::min(jump / spacing, Angles::LargestOfJump));
    finding.dihedralAngle = angle >= Angles::Smallest ? static_cast<float>(angle) : 0.0f;
  }
  return finding;
}

/// Whether the mesh does not join a face, though something may lie behind it: elements whose faces do not match.
bool JumpFinder::isUnmatched(int element, int face) const
{
  return this->Mesh.neighbor(element, face).element < 0 && this->Surface.locator &&
    this->Surface.locator->mayContinue(element, face);
}

/// Whether there may be a jump at a crossing that is worth an evaluation. The field rises along the face at least as
/// steeply as between the corners of the box, so that a jump is at most difference / steepness.
/// \param difference of the values on both sides of the face, at most
bool JumpFinder::mayJump(
  const FaceCrossing& crossing, const SurfaceProxy::Sample& sample, double difference) const
{
  const glm::dvec3 edge =
    glm::inverse(glm::dmat3(sample.anchor.pull)) * (crossing.ends[1] - crossing.ends[0]);
  const double largest = Looks::SmallestJump * LargestJumpPerSpacing * sample.patch.spacing;
  return !(difference * glm::length(edge) <= largest * crossing.rise);
}

JumpFinder::FaceState JumpFinder::stateOf(int element, int face) const
{
  FaceState state;
  state.neighbor = this->Mesh.neighbor(element, face).element;
  state.difference = state.neighbor >= 0 ? differenceAt(this->Mesh, element, face) : 0.0;
  state.unmatched = this->isUnmatched(element, face);
  // Dihedral angles are measured from one side.
  state.wanted = state.difference > 0.0 || state.unmatched || element < state.neighbor;
  return state;
}

/// Looks at a face at a crossing of a box, if that may tell something new. For the dihedral angle a few looks are
/// enough: at the first, second, fourth ... box. A jump is looked for in every box until one is found.
void JumpFinder::lookAtCrossing(const FaceCrossing& crossing, const SurfaceProxy::Sample& sample,
  FaceState& face, Walkers& walkers)
{
  const int element = crossing.location.element;
  const double spacing = sample.patch.spacing;
  std::vector<Finding>& findings = this->OfElement[element];
  if (face.unmatched)
  {
    const std::size_t slot = faceSlot(element, crossing.face);
    findings.push_back({ slot, slot, static_cast<float>(LargestJumpPerSpacing * spacing) });
  }
  const unsigned before = face.boxesSeen++;
  const bool isPowerOfTwo = (before & (before + 1)) == 0; // the number of this box
  const bool forAngle = isPowerOfTwo &&
    (face.unmatched ||
      (element < face.neighbor && !this->Samples.isSmoothTo(sample, face.neighbor)));
  if (forAngle ||
    (this->mayJump(crossing, sample, face.difference) &&
      !this->Samples.meet(crossing, sample, Looks::MeetingJump)))
  {
    if (const auto finding = this->look(crossing, spacing, walkers))
    {
      findings.push_back(*finding);
      face.wanted = face.unmatched || !std::isfinite(finding->jumpTolerance);
    }
  }
}

/// Looks at all faces of an element that its boxes show, once a box.
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
  Isosurface ending = this->Surface.endingWhereItMay();
  ending.jumpTolerances = &this->EndingEverywhere;
  ending.tolerance =
    std::max(this->Surface.tolerance, Looks::Tolerance * this->Proxy.smallestSpacing());
  std::atomic<std::int64_t> evaluations{ 0 };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->OfElement.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      Walkers walkers{ SurfaceWalker(ending), SurfaceWalker(this->Surface) };
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        this->lookAtElement(static_cast<int>(e), walkers);
      }
      evaluations += walkers.along.evaluations() + walkers.across.evaluations();
    });
  FaceJumps result = this->gathered();
  result.evaluations = evaluations;
  return result;
}

/// The findings of all elements, entered at both sides of their faces.
FaceJumps JumpFinder::gathered() const
{
  FaceJumps result;
  result.jumpTolerances.assign(
    this->EndingEverywhere.size(), std::numeric_limits<float>::infinity());
  result.dihedralAngles.assign(this->EndingEverywhere.size(), 0.0f);
  for (const std::vector<Finding>& findings : this->OfElement)
  {
    for (const Finding& finding : findings)
    {
      result.largestJump = std::max(result.largestJump, finding.jump);
      for (const std::size_t slot : { finding.here, finding.there })
      {
        result.jumpTolerances[slot] = std::min(result.jumpTolerances[slot], finding.jumpTolerance);
        result.dihedralAngles[slot] = std::max(result.dihedralAngles[slot], finding.dihedralAngle);
      }
    }
  }
  result.isDiscontinuous = result.largestJump > LargestJumpPerSpacing;
  return result;
}

} // namespace

FaceJumps findFaceJumps(
  const Isosurface& surface, const SurfaceProxy& proxy, const ParallelFor& parallelFor)
{
  return JumpFinder(surface, proxy).run(parallelFor);
}

void endAround(const Isosurface& surface, const std::vector<int>& elements, FaceJumps& jumps)
{
  const ElementMesh& mesh = *surface.mesh;
  for (const int element : elements)
  {
    const auto faces = static_cast<int>(facts(mesh.elements[element].domain).faces.size());
    for (int face = 0; face < faces; ++face)
    {
      const FaceNeighbor& behind = mesh.neighbor(element, face);
      std::vector<std::size_t> slots;
      if (behind.element >= 0)
      {
        slots.push_back(faceSlot(behind.element, behind.face));
      }
      else if (surface.locator)
      {
        slots = surface.locator->slotsBehind(element, face);
      }
      if (!slots.empty())
      {
        slots.push_back(faceSlot(element, face));
      }
      for (const std::size_t slot : slots)
      {
        jumps.jumpTolerances[slot] = 0.0f;
        jumps.isDiscontinuous = true;
      }
    }
  }
}

FacePassages countFacePassages(const ElementMesh& mesh, const SurfaceProxy& proxy,
  const FaceJumps& jumps, const ParallelFor& parallelFor)
{
  std::atomic<std::int64_t> reached{ 0 };
  std::atomic<std::int64_t> ended{ 0 };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(mesh.elements.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (auto e = static_cast<int>(begin); e < end; ++e)
      {
        std::array<bool, MaximumFaces> seen{};
        const auto [firstBox, lastBox] = proxy.boxesOf(e);
        for (std::size_t b = firstBox; b < lastBox; ++b)
        {
          visitFaceCrossings(
            mesh, proxy.boxes()[b], [&](int face) { return !seen[face]; },
            [&](const FaceCrossing& crossing) { seen[crossing.face] = true; });
        }
        for (int face = 0; face < MaximumFaces; ++face)
        {
          const bool isBetween = seen[face] && mesh.neighbor(e, face).element >= 0;
          reached += isBetween;
          ended += isBetween && std::isfinite(jumps.jumpTolerances[faceSlot(e, face)]);
        }
      }
    });
  return { reached, ended };
}

} // namespace hop
