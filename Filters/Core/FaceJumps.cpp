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

} // namespace

double valueBehind(const Isosurface& surface, const Location& location, int face)
{
  const ElementMesh& mesh = *surface.mesh;
  if (mesh.neighbor(location.element, face).element < 0)
  {
    return 0.0;
  }
  const Location behind = crossFace(mesh, location, face);
  return evaluateGradient(mesh.form(behind.element), behind.u).value.w - surface.isovalue;
}

FaceJumps findFaceJumps(
  const Isosurface& surface, const SurfaceProxy& proxy, const ParallelFor& parallelFor)
{
  const ElementMesh& mesh = *surface.mesh;
  FaceJumps result;
  result.cuts.assign(mesh.elements.size() * MaximumFaces, 0);
  result.kinks = result.cuts;

  // As if the surface ended at all inner faces, so that Newton's method stays on them.
  const std::vector<char> everywhere(result.cuts.size(), 1);
  Isosurface walled = surface;
  walled.cuts = &everywhere;
  // Jumps and kinks are large beside this.
  walled.tolerance = std::max(surface.tolerance, 0.02 * proxy.smallestSpacing());
  enum Finding : char
  {
    Agrees,
    Jumps,
    Turns
  };
  struct Found
  {
    int face;
    Finding finding;
  };
  const std::vector<std::size_t> firstBox = boxRanges(proxy.boxes(), mesh.elements.size());
  std::vector<std::vector<Found>> ofElement(mesh.elements.size());
  std::atomic<std::int64_t> evaluations{ 0 };
  const auto check = [&](const FaceCrossing& crossing, double spacing, SurfaceWalker& walker)
  {
    Evaluated here;
    const Location& start = crossing.location;
    const Face& face = facts(mesh.elements[start.element].domain).faces[crossing.face];
    if (!walker.project(start, 4.0 * spacing, here, true) ||
      faceMargin(face, here.location.u) > OnFace)
    {
      return Agrees;
    }
    const Evaluated there = walker.evaluate(crossFace(mesh, here.location, crossing.face));
    const double slope = length(there.point.gradient);
    if (!(std::abs(there.point.value) <= LargestJumpPerSpacing * spacing * slope))
    {
      return Jumps;
    }
    return dot(here.point.gradient, there.point.gradient) <
        KinkCosine * slope * length(here.point.gradient)
      ? Turns
      : Agrees;
  };
  const auto checkElement = [&](int element, SurfaceWalker& walker)
  {
    // A few looks are enough to see a kink: at the first, second, fourth ... box. Jumps are looked for at
    // all of them.
    std::array<bool, MaximumFaces> jumps{};
    std::array<bool, MaximumFaces> wanted{};
    std::array<unsigned, MaximumFaces> boxesSeen{};
    const auto faceCount = static_cast<int>(facts(mesh.elements[element].domain).faces.size());
    for (int f = 0; f < faceCount; ++f)
    {
      const int behind = mesh.neighbor(element, f).element;
      jumps[f] = behind >= 0 && mayJump(mesh, element, f);
      wanted[f] = jumps[f] || element < behind;
    }
    for (std::size_t b = firstBox[element]; b < firstBox[element + 1]; ++b)
    {
      std::array<bool, MaximumFaces> seen{};
      visitFaceCrossings(
        mesh, proxy.boxes()[b], [&](int face) { return wanted[face] && proxy.samples()[b].found; },
        [&](const FaceCrossing& crossing)
        {
          if (!seen[crossing.face])
          {
            seen[crossing.face] = true;
            const unsigned before = boxesSeen[crossing.face]++;
            if (!jumps[crossing.face] && (before & (before + 1)) != 0)
            {
              return;
            }
            const Finding finding = check(crossing, proxy.samples()[b].patch.spacing, walker);
            ofElement[element].push_back({ crossing.face, finding });
            // One jump is enough to cut a face.
            wanted[crossing.face] = finding != Jumps;
          }
        });
    }
  };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(ofElement.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      SurfaceWalker walker(walled);
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        checkElement(static_cast<int>(e), walker);
      }
      evaluations += walker.evaluations();
    });
  for (std::size_t e = 0; e < ofElement.size(); ++e)
  {
    for (const Found& found : ofElement[e])
    {
      if (found.finding != Agrees)
      {
        std::vector<char>& marks = found.finding == Jumps ? result.cuts : result.kinks;
        const FaceNeighbor& neighbor = mesh.neighbor(static_cast<int>(e), found.face);
        marks[slotOf(static_cast<int>(e), found.face)] = 1;
        marks[slotOf(neighbor.element, neighbor.face)] = 1;
      }
    }
  }
  result.evaluations = evaluations;
  return result;
}

} // namespace hop
