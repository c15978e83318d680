#include "Isolation/FaceSheets.h"

#include "Elements/Bisection.h"
#include "Support/KeepMarked.h"
#include "Surface/FaceLocator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hop
{
namespace
{

/// Corners of boxes are kept in single precision.
constexpr double cornerRounding = 1e-6;

/// Largest |F - c|, of which rounding errors are a share, or |c|.
double largestValue(const BernsteinForm& form, double isovalue)
{
  double largest = std::abs(isovalue);
  for (int i = 0; i < coefficientCount(form.domain, form.degrees); ++i)
  {
    const double weight = form.weights ? form.weights[i] : 1.0;
    largest = std::max(largest, std::abs(form.coefficients[i].w / weight - isovalue));
  }
  return largest;
}

/// Whether a face is one in world space, too: at the tip of a pyramid one is a point.
bool hasArea(const Element& element, const Face& face)
{
  std::set<std::int64_t> numbers;
  for (int c = 0; c < face.cornerCount; ++c)
  {
    numbers.insert(element.corners[face.corners[c]]);
  }
  return numbers.size() >= 3;
}

/// A side of a box that lies on a face of its element, and in the surface.
struct Sheet
{
  int face = -1;
  ReferencePoint middle;
  /// 1 if F > c in the box, -1 if F < c.
  int sign = 0;
};

class SheetGiver
{
public:
  SheetGiver(const Isosurface& surface, int element)
    : Surface(surface)
    , Facts(facts(surface.mesh->elements[element].domain))
    , Number(element)
    , Slack(RoundingShare * largestValue(surface.mesh->form(element), surface.isovalue))
  {
  }

  int element() const { return this->Number; }

  /// \return whether the box is to stay
  bool settle(SurfaceBox& box) const
  {
    const Sheet sheet = this->sheetOf(box);
    if (sheet.face < 0)
    {
      return true;
    }
    const int behind = this->signBehind(sheet);
    const bool isOurs = this->has(sheet, behind);
    for (std::size_t c = 0; c < this->Facts.corners.size(); ++c)
    {
      const float size = std::abs(box.values[c]);
      box.values[c] = this->isZero(box, static_cast<int>(c)) ? 0.0f : isOurs ? size : -size;
    }
    return isOurs || behind != sheet.sign;
  }

private:
  bool isZero(const SurfaceBox& box, int corner) const
  {
    return std::abs(box.values[corner]) * box.valueUnit <= this->Slack;
  }

  /// Where all corners of a side, and no others, are at zero, and the others on one side of it.
  Sheet sheetOf(const SurfaceBox& box) const
  {
    const int corners = static_cast<int>(this->Facts.corners.size());
    const auto isZero = [&](int c) { return this->isZero(box, c); };
    std::array<int, 3> counts{};
    for (int c = 0; c < corners; ++c)
    {
      ++counts[isZero(c) ? 1 : box.values[c] > 0.0f ? 2 : 0];
    }
    if (counts[1] < 3 || (counts[0] > 0) == (counts[2] > 0))
    {
      return {};
    }
    const auto& faces = this->Facts.faces;
    const auto side = std::find_if(faces.begin(), faces.end(),
      [&](const Face& face)
      {
        return face.cornerCount == counts[1] &&
          std::all_of(face.corners.begin(), face.corners.begin() + face.cornerCount, isZero);
      });
    return side == faces.end() ? Sheet{} : this->sheetOn(box, *side, counts[2] > 0 ? 1 : -1);
  }

  Sheet sheetOn(const SurfaceBox& box, const Face& side, int sign) const
  {
    Sheet sheet;
    sheet.sign = sign;
    for (int c = 0; c < side.cornerCount; ++c)
    {
      sheet.middle.xyz +=
        glm::dvec3(box.corners[side.corners[c]]) / static_cast<double>(side.cornerCount);
    }
    const Element& element = this->Surface.mesh->elements[this->Number];
    const auto& faces = this->Facts.faces;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
      const auto margin = [&](const glm::dvec3& u) { return faceMargin(faces[f], { u }); };
      if (hasArea(element, faces[f]) &&
        std::all_of(side.corners.begin(), side.corners.begin() + side.cornerCount,
          [&](int c) { return margin(glm::dvec3(box.corners[c])) < cornerRounding; }))
      {
        sheet.face = f;
        sheet.middle.xyz -= margin(sheet.middle.xyz) /
          glm::dot(faces[f].inward.xyz, faces[f].inward.xyz) * faces[f].inward.xyz;
      }
    }
    return sheet;
  }

  /// On which side of the isovalue the field is in the element behind; 0 where there is none, or it does
  /// not have the sheet, too.
  int signBehind(const Sheet& sheet) const
  {
    const auto place = this->placeBehind(sheet);
    if (!place)
    {
      return 0;
    }
    const ElementMesh& mesh = *this->Surface.mesh;
    const BernsteinForm form = mesh.form(place->location.element);
    const Jet jet = evaluateGradient(form, place->location.u);
    const double rise = glm::dot(gradientOf(jet), facts(form.domain).faces[place->face].inward.xyz);
    const double value = std::abs(jet.value.w - this->Surface.isovalue);
    const double slack = RoundingShare * largestValue(form, this->Surface.isovalue);
    return value > std::max(slack, sameSheet * std::abs(rise)) ? 0 : (rise > 0.0) - (rise < 0.0);
  }

  std::optional<LocatedPlace> placeBehind(const Sheet& sheet) const
  {
    const ElementMesh& mesh = *this->Surface.mesh;
    const Location here{ this->Number, sheet.middle };
    const FaceNeighbor& neighbor = mesh.neighbor(this->Number, sheet.face);
    if (neighbor.element >= 0)
    {
      return LocatedPlace{ crossFace(mesh, here, sheet.face), neighbor.face, 0.0 };
    }
    if (!this->Surface.locator)
    {
      return std::nullopt;
    }
    const WorldPoint point{ glm::dvec3(
      evaluateGradient(mesh.form(this->Number), sheet.middle).value) };
    std::int64_t evaluations = 0;
    return this->Surface.locator->locate(
      point, this->Number, sheet.face, std::numeric_limits<double>::infinity(), evaluations);
  }

  bool has(const Sheet& sheet, int behind) const
  {
    if (behind == sheet.sign)
    {
      return this->Number < this->placeBehind(sheet)->location.element;
    }
    return behind == 0 || sheet.sign > 0;
  }

  /// In units of what the field rises by across an element.
  static constexpr double sameSheet = 1e-6;

  const Isosurface& Surface;
  const DomainFacts& Facts;
  int Number;
  double Slack;
};

} // namespace

std::vector<SurfaceBox> giveFaceSheetsOnce(
  const Isosurface& surface, std::vector<SurfaceBox> boxes, const ParallelFor& parallelFor)
{
  std::vector<char> stays(boxes.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(boxes.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::optional<SheetGiver> giver;
      for (std::ptrdiff_t b = begin; b < end; ++b)
      {
        const int element = boxes[b].middle.element;
        if (!giver || giver->element() != element)
        {
          giver.emplace(surface, element);
        }
        stays[b] = giver->settle(boxes[b]);
      }
    });
  keepMarked(boxes, stays);
  return boxes;
}

} // namespace hop
