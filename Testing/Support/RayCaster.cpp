#include "RayCaster.h"

#include "Isolation/SurfaceBoxes.h"
#include "Surface/ActiveFaces.h"
#include "Surface/SurfaceGeometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop::testing
{

glm::dvec3 PictureCamera::right() const
{
  const glm::dvec3 other =
    std::abs(this->back.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  return glm::normalize(glm::cross(other, this->back));
}

glm::dvec3 PictureCamera::up() const
{
  return glm::cross(this->back, this->right());
}

PictureCamera::Ray PictureCamera::ray(double x, double y) const
{
  const glm::dvec2 offset = this->pixel() * (glm::dvec2(x, y) - 0.5 * this->size);
  const glm::dvec3 across = offset.x * this->right() + offset.y * this->up();
  return this->parallel ? Ray{ this->eye() + across, -this->back }
                        : Ray{ this->eye(), across / this->distance - this->back };
}

glm::dvec2 PictureCamera::project(const glm::dvec3& point) const
{
  const glm::dvec3 offset = point - this->centre;
  const double depth = this->distance - glm::dot(offset, this->back);
  const double scale = this->parallel ? 1.0 : this->distance / depth;
  const glm::dvec2 across(glm::dot(offset, this->right()), glm::dot(offset, this->up()));
  return scale / this->pixel() * across + 0.5 * this->size;
}

glm::dvec3 PictureCamera::toEye(const glm::dvec3& point) const
{
  return this->parallel ? this->back : glm::normalize(this->eye() - point);
}

namespace
{

/// Largest size of a surface box, pixels. Larger: Newton's method may miss a sheet; smaller: boxes take longer to find.
constexpr double BoxPixels = 3.0;
/// Slits between elements are closed up to this width on either side, pixels. Larger: outlines of surfaces that end at
/// faces grow; smaller: single pixels show what is behind a slit.
constexpr double SlitPixels = 0.2;
/// Steps of Newton's method after which a start is given up.
constexpr int MaximumSteps = 20;

bool isInBall(const SurfaceBox& box, const ReferencePoint& u, double scale)
{
  return glm::distance(u.xyz, box.middle.u.xyz) <= 1.000001 * scale * box.referenceRadius;
}

/// How far outside of its element a place is, world units, to first order; 0 inside.
double distanceBeyond(Domain domain, const ReferencePoint& u, const LocalMap& map)
{
  double beyond = 0.0;
  for (const Face& face : facts(domain).faces)
  {
    const double slope = glm::length(glm::transpose(map.inverse) * face.inward.xyz);
    beyond = std::max(beyond, -faceMargin(face, u) / slope);
  }
  return insideMargin(domain, u) > -1e-9 ? 0.0 : beyond;
}

/// How far the nearest face of an element is from a place on the surface, along the surface, to first order.
double distanceToBorder(
  Domain domain, const ReferencePoint& u, const LocalMap& map, const glm::dvec3& normal)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (const Face& face : facts(domain).faces)
  {
    const glm::dvec3 gradient = glm::transpose(map.inverse) * face.inward.xyz;
    const double slope = glm::length(gradient - glm::dot(gradient, normal) * normal);
    nearest = std::min(nearest, std::abs(faceMargin(face, u)) / slope);
  }
  return nearest;
}

/// Where a ray meets the surface of an element, which is continued beyond the element.
struct Root
{
  SeenPoint seen;
  int element = -1;
  /// How far outside of the element, world units; 0 inside.
  double beyond = 0.0;
};

/// Newton's method for x(u) = origin + t direction, F(u) = isovalue. The tangent plane of F at u
/// gives the next t, the Jacobian then the next u. Only roots in the box's ball, and in its element or
/// less than `slit` beyond, count; the balls of all boxes hold the whole surface.
bool meet(const ElementMesh& mesh, double isovalue, const PictureCamera::Ray& ray, double nearest,
  const SurfaceBox& box, double slit, ReferencePoint u, Root& root)
{
  const BernsteinForm form = mesh.form(box.middle.element);
  for (int step = 0; step < MaximumSteps; ++step)
  {
    const FieldPoint at = fieldPoint(evaluateGradient(form, u), isovalue);
    const double slope = glm::dot(at.gradient.xyz, ray.direction);
    if (at.map.singular || slope == 0.0)
    {
      return false;
    }
    const glm::dvec3 fromOrigin = at.map.position.xyz - ray.origin;
    const double t = (glm::dot(at.gradient.xyz, fromOrigin) - at.value) / slope;
    const WorldVector move{ t * ray.direction - fromOrigin };
    if (length(move) < 1e-9 * box.size)
    {
      const glm::dvec3 normal = surfaceNormal(at.gradient).xyz;
      root.seen = { t, normal, mesh.elements[box.middle.element].cell,
        distanceToBorder(form.domain, u, at.map, normal) };
      root.element = box.middle.element;
      root.beyond = distanceBeyond(form.domain, u, at.map);
      return t > nearest && isInBall(box, u, root.beyond > 0.0 ? 1.5 : 1.0) && root.beyond <= slit;
    }
    u = u + at.map.pull(move);
    if (!isInBall(box, u, 4.0))
    {
      return false;
    }
  }
  return false;
}

/// What was found at a pixel so far.
struct Pixel
{
  SeenPoint nearest;
  /// The nearest root just outside of its element.
  Root outside;
};

/// Keeps the nearest root. Fields that differ a little at a face leave a slit between the ends of the
/// surface there, much narrower than a pixel, through which single rays pass: a ray that passes two elements'
/// surfaces just beyond their ends, at about the same depth, meets the surface.
void keep(const Root& root, double slit, Pixel& pixel)
{
  const bool inSlit = root.beyond > 0.0 && pixel.outside.element >= 0 &&
    pixel.outside.element != root.element &&
    std::abs(pixel.outside.seen.depth - root.seen.depth) < 5.0 * slit;
  if ((root.beyond == 0.0 || inSlit) && root.seen.depth < pixel.nearest.depth)
  {
    pixel.nearest = root.seen;
  }
  if (root.beyond > 0.0 && root.seen.depth < pixel.outside.seen.depth)
  {
    pixel.outside = root;
  }
}

/// Keeps the roots to which the starts lead.
void look(const ElementMesh& mesh, double isovalue, const PictureCamera::Ray& ray, double nearest,
  const SurfaceBox& box, const std::vector<ReferencePoint>& starts, double slit, Pixel& pixel)
{
  for (const ReferencePoint& start : starts)
  {
    Root root;
    if (meet(mesh, isovalue, ray, nearest, box, slit, start, root))
    {
      keep(root, slit, pixel);
    }
  }
}

/// The middle of a box, and places before and behind it as the camera sees them.
std::vector<ReferencePoint> startsIn(
  const ElementMesh& mesh, const SurfaceBox& box, const glm::dvec3& toEye)
{
  const LocalMap map =
    fieldPoint(evaluateGradient(mesh.form(box.middle.element), box.middle.u), 0.0).map;
  const ReferenceVector half = map.pull({ 0.4 * box.size * toEye });
  return { box.middle.u, box.middle.u + half, box.middle.u + -half };
}

struct PixelRange
{
  int left, right, bottom, top;
};

PixelRange pixelsOf(const PictureCamera& camera, const glm::dvec3& middle, double radius)
{
  const glm::dvec2 at = camera.project(middle);
  const double depth = camera.distance - glm::dot(middle - camera.centre, camera.back);
  const double scale =
    camera.parallel ? 1.0 : camera.distance / std::max(depth - radius, 1e-3 * camera.distance);
  const double reach = scale * radius / camera.pixel();
  const auto clamp = [&camera](double x)
  { return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(camera.size))); };
  return { clamp(std::floor(at.x - reach)), clamp(std::ceil(at.x + reach)),
    clamp(std::floor(at.y - reach)), clamp(std::ceil(at.y + reach)) };
}

glm::dvec3 middleOf(const ElementMesh& mesh, const SurfaceBox& box)
{
  const Jet jet = evaluateGradient(mesh.form(box.middle.element), box.middle.u);
  return fieldPoint(jet, 0.0).map.position.xyz;
}

/// Whether no ray of the picture passes a box.
bool isOutOfSight(const ElementMesh& mesh, const PictureCamera& camera, const SurfaceBox& box)
{
  const glm::dvec3 middle = middleOf(mesh, box);
  const PixelRange range = pixelsOf(camera, middle, box.size);
  const double depth = camera.distance - glm::dot(middle - camera.centre, camera.back);
  return range.left >= range.right || range.bottom >= range.top ||
    depth + box.size <= camera.nearest;
}

/// Boxes that hold all of the surface that is in the picture.
std::vector<SurfaceBox> boxesInPicture(const ElementMesh& mesh, double isovalue,
  const PictureCamera& camera, const ParallelFor& parallelFor)
{
  const auto isOut = [&](const SurfaceBox& box) { return isOutOfSight(mesh, camera, box); };
  std::vector<SurfaceBox> boxes = findSurfaceBoxes(
    mesh, isovalue,
    [&](const SurfaceBox& box) { return box.size <= BoxPixels * camera.pixel() || isOut(box); },
    parallelFor);
  boxes.erase(std::remove_if(boxes.begin(), boxes.end(), isOut), boxes.end());
  return boxes;
}

} // namespace

std::vector<SeenPoint> castRays(const ElementMesh& mesh, double isovalue,
  const PictureCamera& camera, const ParallelFor& parallelFor)
{
  const std::vector<SurfaceBox> boxes = boxesInPicture(mesh, isovalue, camera, parallelFor);
  std::vector<Pixel> pixels(camera.size * camera.size);
  // Bands of the picture, so that no two threads write to one pixel.
  constexpr int bandHeight = 16;
  const int bands = (camera.size + bandHeight - 1) / bandHeight;
  const auto castBand = [&](int band)
  {
    const int first = band * bandHeight;
    const int last = std::min(first + bandHeight, camera.size);
    for (const SurfaceBox& box : boxes)
    {
      const LocalMap map =
        fieldPoint(evaluateGradient(mesh.form(box.middle.element), box.middle.u), 0.0).map;
      const PixelRange range = pixelsOf(camera, map.position.xyz, 0.6 * box.size);
      if (range.top <= first || range.bottom >= last)
      {
        continue;
      }
      const std::vector<ReferencePoint> starts =
        startsIn(mesh, box, camera.toEye(map.position.xyz));
      for (int y = std::max(range.bottom, first); y < std::min(range.top, last); ++y)
      {
        for (int x = range.left; x < range.right; ++x)
        {
          look(mesh, isovalue, camera.ray(x + 0.5, y + 0.5), camera.nearest, box, starts,
            SlitPixels * camera.pixel(), pixels[y * camera.size + x]);
        }
      }
    }
  };
  runParallel(parallelFor, bands,
    [&castBand](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t band = begin; band < end; ++band)
      {
        castBand(static_cast<int>(band));
      }
    });
  std::vector<SeenPoint> picture;
  picture.reserve(pixels.size());
  for (const Pixel& pixel : pixels)
  {
    picture.push_back(pixel.nearest);
  }
  return picture;
}

} // namespace hop::testing
