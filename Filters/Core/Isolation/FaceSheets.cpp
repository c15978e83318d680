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

/// Margin of a corner that counts as on a face of the element, reference units: some rounding errors of the corners of
/// boxes, which are in single precision. A larger margin takes sheets beside a face for sheets on the face.
constexpr double cornerRounding = 1e-6;

/// The largest of |c| and |F - c| at the control points, which rounding errors are a share of.
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

/// Whether a face has an area in world space: the face at the tip of a pyramid is a point there.
bool hasArea(const Element& element, const Face& face)
{
  std::set<std::int64_t> numbers;
  for (int c = 0; c < face.cornerCount; ++c)
  {
    numbers.insert(element.corners[face.corners[c]]);
  }
  return numbers.size() >= 3;
}

/// The sheet on a face of a box that lies in a face of the box's element.
struct Sheet
{
  /// Of the element; -1 if there is no sheet.
  int face = -1;
  /// Middle of the face of the box.
  ReferencePoint middle;
  /// 1 if F > c in the box, -1 if F < c.
  int sign = 0;
};

/// What the element behind a face with a sheet has there.
struct Behind
{
  int element = -1;
  /// Of F - c beside the face; 0 if there is nothing.
  int sign = 0;
  /// Whether F = c a little behind the face.
  bool isPassed = false;
  /// Whether a box there has a sheet on the face.
  bool hasSheet = false;
};

/// Finds and assigns the sheets in the faces of one element.
class SheetAssigner
{
public:
  SheetAssigner(const Isosurface& surface, int element)
    : Surface(surface)
    , Facts(facts(surface.mesh->elements[element].domain))
    , Number(element)
    , Slack(BisectionRounding * largestValue(surface.mesh->form(element), surface.isovalue))
  {
  }

  int element() const { return this->Number; }

  /// The sheet of a box whose corners are zero on one of its faces, and of one sign elsewhere.
  Sheet sheetOf(const SurfaceBox& box) const
  {
    const int corners = static_cast<int>(this->Facts.corners.size());
    const auto isZero = [&](int c) { return this->isZero(box, c); };
    std::array<int, 3> counts{}; // of corners below, at and above the isovalue
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

  /// Sets the values of a box with a sheet on a face of the element so that the box has the sheet, or not.
  /// \param faces with sheets, slots, ascending
  /// \return whether the box is to be kept
  bool assign(const Sheet& sheet, const std::vector<std::size_t>& faces, SurfaceBox& box) const
  {
    const Behind behind = this->findBehind(sheet, faces);
    const bool hasSheet = this->ownsSheet(sheet, behind);
    for (std::size_t c = 0; c < this->Facts.corners.size(); ++c)
    {
      const float size = std::abs(box.values[c]);
      box.values[c] = this->isZero(box, static_cast<int>(c)) ? 0.0f : hasSheet ? size : -size;
    }
    return hasSheet || behind.sign != sheet.sign;
  }

private:
  bool isZero(const SurfaceBox& box, int corner) const
  {
    return std::abs(box.values[corner]) * box.valueUnit <= this->Slack;
  }

  /// The sheet on a face of the box, if that face lies in a face of the element.
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

  /// What is behind the face with a sheet. Nothing, if there is no element, or the sheet is not in its field, too.
  Behind findBehind(const Sheet& sheet, const std::vector<std::size_t>& facesWithSheets) const
  {
    const auto place = this->placeBehind(sheet);
    if (!place)
    {
      return {};
    }
    const int element = place->location.element;
    const BernsteinForm form = this->Surface.mesh->form(element);
    const Jet jet = evaluateGradient(form, place->location.u);
    const double rise = glm::dot(gradientOf(jet), facts(form.domain).faces[place->face].inward.xyz);
    const double value = jet.value.w - this->Surface.isovalue;
    const double slack = BisectionRounding * largestValue(form, this->Surface.isovalue);
    if (std::abs(value) > std::max(slack, offSheet * std::abs(rise)))
    {
      return {};
    }
    return { element, (rise > 0.0) - (rise < 0.0), value * rise < 0.0,
      std::binary_search(
        facesWithSheets.begin(), facesWithSheets.end(), faceSlot(element, place->face)) };
  }

  /// The middle of the sheet as seen from the element behind the face.
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
    const LocalMap point =
      fieldPoint(evaluateGradient(mesh.form(this->Number), sheet.middle), 0.0).map;
    std::int64_t evaluations = 0;
    return this->Surface.locator->locate(
      point, this->Number, sheet.face, std::numeric_limits<double>::infinity(), evaluations);
  }

  /// Whether this element has the sheet.
  bool ownsSheet(const Sheet& sheet, const Behind& behind) const
  {
    if (behind.sign == sheet.sign)
    {
      return this->Number < behind.element;
    }
    // Rounding may have put the surface into the face here, but not there: it is there only if it has passed the face.
    return behind.sign == 0 || (behind.hasSheet ? sheet.sign > 0 : !behind.isPassed);
  }

  /// |F - c| behind the face at most for a sheet of both elements, as a share of the rise of the field across the
  /// element behind. Chosen by experiment: less parts the sheet where the fields differ by rounding of the input, more
  /// takes a jump of the field for one sheet.
  static constexpr double offSheet = 1e-6;

  const Isosurface& Surface;
  const DomainFacts& Facts;
  int Number;
  double Slack;
};

/// Calls use(assigner of its element, b) for each box.
template <class Use>
void forBoxes(const Isosurface& surface, const std::vector<SurfaceBox>& boxes,
  const ParallelFor& parallelFor, const Use& use)
{
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(boxes.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::optional<SheetAssigner> assigner;
      for (std::ptrdiff_t b = begin; b < end; ++b)
      {
        const int element = boxes[b].middle.element;
        if (!assigner || assigner->element() != element)
        {
          assigner.emplace(surface, element);
        }
        use(*assigner, static_cast<std::size_t>(b));
      }
    });
}

} // namespace

std::vector<SurfaceBox> assignFaceSheets(
  const Isosurface& surface, std::vector<SurfaceBox> boxes, const ParallelFor& parallelFor)
{
  std::vector<Sheet> sheets(boxes.size());
  forBoxes(surface, boxes, parallelFor,
    [&](const SheetAssigner& assigner, std::size_t b) { sheets[b] = assigner.sheetOf(boxes[b]); });
  std::vector<std::size_t> faces;
  for (std::size_t b = 0; b < boxes.size(); ++b)
  {
    if (sheets[b].face >= 0)
    {
      faces.push_back(faceSlot(boxes[b].middle.element, sheets[b].face));
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  std::vector<char> isKept(boxes.size(), 1);
  if (!faces.empty())
  {
    forBoxes(surface, boxes, parallelFor,
      [&](const SheetAssigner& assigner, std::size_t b)
      { isKept[b] = sheets[b].face < 0 || assigner.assign(sheets[b], faces, boxes[b]); });
  }
  keepMarked(boxes, isKept);
  return boxes;
}

} // namespace hop
