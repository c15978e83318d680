#include "PictureErrors.h"

#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

using hop::testing::PictureCamera;
using hop::testing::SeenPoint;

namespace
{
// What is too far off. Larger ones overlook errors that an eye sees, smaller ones show what splats average.
constexpr double LargestOffset = 0.1; // spacings
constexpr double LargestShade = 25. / 255.;

// Depths of the pixels around one that differ by more than a spacing, and by more than so many pixels, are those of two
// parts of the surface: a slope that is as steep (80 degrees) is at an outline, too.
constexpr double SteepPixels = 10.;

// The pixels around one, itself included.
template <class Use>
void VisitAround(int size, int x, int y, const Use& use)
{
  for (int v = std::max(0, y - 1); v <= std::min(size - 1, y + 1); ++v)
  {
    for (int u = std::max(0, x - 1); u <= std::min(size - 1, x + 1); ++u)
    {
      use(v * size + u);
    }
  }
}

// The brightness of the pixels around one as rays see it.
class ShadesAround
{
public:
  // largestStep: of the depth of one part of the surface, world units.
  explicit ShadesAround(double largestStep)
    : LargestStep(largestStep)
  {
  }

  void Add(const SeenPoint& seen, double shade)
  {
    this->Shades.push_back(shade);
    this->Nearest = std::min(this->Nearest, seen.depth);
    this->Farthest = std::max(this->Farthest, seen.depth);
  }

  // How far a brightness is from that of any of the pixels. Where they show what does not hang together, before another
  // part of the surface or the background (which is black), a pixel may also be a mixture, as outlines are smooth.
  double DistanceOf(double shade) const
  {
    const auto [darkest, brightest] = std::minmax_element(this->Shades.begin(), this->Shades.end());
    if (this->Farthest - this->Nearest > this->LargestStep)
    {
      return std::max({ 0., *darkest - shade, shade - *brightest });
    }
    double least = std::numeric_limits<double>::infinity();
    for (const double other : this->Shades)
    {
      least = std::min(least, std::abs(shade - other));
    }
    return least;
  }

private:
  std::vector<double> Shades;
  double LargestStep;
  double Nearest = std::numeric_limits<double>::infinity();
  double Farthest = 0.; // infinite if the background is seen
};

PixelError ErrorAt(const SurfacePicture& drawn, const SurfacePicture& reference,
  const PictureCamera& camera, double spacing, int x, int y)
{
  const int here = y * camera.size + x;
  int covered = 0;
  int around = 0;
  double offset = std::numeric_limits<double>::infinity();
  ShadesAround shades(std::max(spacing, SteepPixels * camera.pixel()));
  VisitAround(camera.size, x, y,
    [&](int there)
    {
      const SeenPoint& seen = reference.Seen[there];
      ++around;
      covered += seen.covered();
      shades.Add(seen, reference.Shade[there]);
      if (seen.covered() && drawn.Seen[here].covered())
      {
        const glm::dvec3 ray = camera.ray(x + 0.5, y + 0.5).direction;
        offset = std::min(
          offset, std::abs((drawn.Seen[here].depth - seen.depth) * glm::dot(ray, seen.normal)));
      }
    });
  if (!drawn.Seen[here].covered())
  {
    return covered == around ? PixelError::Hole : PixelError::None;
  }
  const bool isAtNearPlane =
    camera.nearest > 0. && drawn.Seen[here].depth < camera.nearest + 2. * spacing;
  return isAtNearPlane                                    ? PixelError::None
    : covered == 0                                        ? PixelError::Beyond
    : offset > LargestOffset * spacing                    ? PixelError::Depth
    : shades.DistanceOf(drawn.Shade[here]) > LargestShade ? PixelError::Shade
                                                          : PixelError::None;
}
}

int PictureErrors::Count(PixelError error) const
{
  return static_cast<int>(std::count(this->Pixels.begin(), this->Pixels.end(), error));
}

PictureErrors FindErrors(const SurfacePicture& drawn, const SurfacePicture& reference,
  const PictureCamera& camera, double spacing)
{
  PictureErrors errors;
  for (int y = 0; y < camera.size; ++y)
  {
    for (int x = 0; x < camera.size; ++x)
    {
      const int here = y * camera.size + x;
      errors.Pixels.push_back(ErrorAt(drawn, reference, camera, spacing, x, y));
      errors.Covered += drawn.Seen[here].covered() || reference.Seen[here].covered();
    }
  }
  return errors;
}

std::vector<glm::ivec2> WorstPlaces(const PictureErrors& errors, int size, int side, int count)
{
  std::vector<char> wrong(errors.Pixels.size());
  std::transform(errors.Pixels.begin(), errors.Pixels.end(), wrong.begin(),
    [](PixelError error) { return error != PixelError::None; });
  std::vector<glm::ivec2> corners;
  for (int n = 0; n < count; ++n)
  {
    int most = 0;
    glm::ivec2 best(0);
    for (int y = 0; y + side <= size; y += side / 4)
    {
      for (int x = 0; x + side <= size; x += side / 4)
      {
        int found = 0;
        for (int row = y; row < y + side; ++row)
        {
          const auto first = wrong.begin() + static_cast<std::ptrdiff_t>(row) * size + x;
          found += std::accumulate(first, first + side, 0);
        }
        if (found > most)
        {
          most = found;
          best = { x, y };
        }
      }
    }
    if (most == 0)
    {
      break;
    }
    corners.push_back(best);
    for (int row = best.y; row < best.y + side; ++row)
    {
      std::fill_n(wrong.begin() + static_cast<std::ptrdiff_t>(row) * size + best.x, side, 0);
    }
  }
  return corners;
}

namespace
{
using Color = std::array<unsigned char, 3>;

Color ColorOfError(PixelError error, double shade)
{
  const auto grey = static_cast<unsigned char>(std::lround(120. * shade));
  switch (error)
  {
    case PixelError::Hole:
      return { 255, 255, 255 };
    case PixelError::Beyond:
      return { 255, 0, 0 };
    case PixelError::Depth:
      return { 255, 0, 255 };
    case PixelError::Shade:
      return { 255, 255, 0 };
    default:
      return { grey, grey, grey };
  }
}

// Background is blue.
Color ColorOfShade(const SurfacePicture& picture, int at)
{
  const auto grey = static_cast<unsigned char>(std::lround(255. * std::min(1., picture.Shade[at])));
  return picture.Seen[at].covered() ? Color{ grey, grey, grey } : Color{ 30, 30, 90 };
}
}

void WriteCrops(const SurfacePicture& drawn, const SurfacePicture& reference,
  const PictureErrors& errors, int size, const std::vector<glm::ivec2>& corners, int side,
  const std::string& path)
{
  if (corners.empty())
  {
    return;
  }
  const int enlarged = std::max(1, 256 / side);
  const int cell = side * enlarged;
  const int rows = static_cast<int>(corners.size());
  vtkNew<vtkImageData> image;
  image->SetDimensions(3 * cell, rows * cell, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < rows * cell; ++y)
  {
    for (int x = 0; x < 3 * cell; ++x)
    {
      const glm::ivec2 place =
        corners[rows - 1 - y / cell] + glm::ivec2(x % cell, y % cell) / enlarged;
      const int at = place.y * size + place.x;
      const Color color = x < cell ? ColorOfShade(reference, at)
        : x < 2 * cell             ? ColorOfShade(drawn, at)
                                   : ColorOfError(errors.Pixels[at], reference.Shade[at]);
      std::copy(
        color.begin(), color.end(), static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0)));
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  writer->Write();
}

PictureCamera ViewOfAll(const SurfaceCase& surface, int size)
{
  double bounds[6];
  surface.Particles->GetBounds(bounds);
  const glm::dvec3 low(bounds[0], bounds[2], bounds[4]);
  const glm::dvec3 high(bounds[1], bounds[3], bounds[5]);
  PictureCamera camera;
  camera.centre = 0.5 * (low + high);
  camera.back = glm::normalize(glm::dvec3(-1., -1.6, 0.9));
  camera.halfHeight = std::max(0.5 * glm::distance(low, high), surface.Spacing);
  camera.distance = 4. * camera.halfHeight;
  camera.size = size;
  return camera;
}

namespace
{
constexpr double NearView = 8.; // half the height of a near view, spacings

// For each particle how many of its first two planes cut its splat: those with more than ten degrees within a spacing.
std::vector<int> CountEdges(vtkPolyData* particles)
{
  vtkDataArray* angles = particles->GetPointData()->GetArray("Clip_Angle");
  vtkDataArray* distances = particles->GetPointData()->GetArray("Clip_Distance");
  vtkDataArray* radii = particles->GetPointData()->GetArray("Radius");
  if (!angles || !distances || !radii)
  {
    throw std::invalid_argument("particles without clip planes: PassDiagnostics is off");
  }
  std::vector<int> counts(particles->GetNumberOfPoints(), 0);
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    for (int plane = 0; plane < std::min(2, angles->GetNumberOfComponents()); ++plane)
    {
      counts[i] += angles->GetComponent(i, plane) > 10. &&
        distances->GetComponent(i, plane) < radii->GetComponent(i, 0);
    }
  }
  return counts;
}
}

PictureCamera ViewNear(
  const SurfaceCase& surface, int size, const glm::dvec3& place, const glm::dvec3& back)
{
  const double half = NearView * surface.Spacing;
  PictureCamera camera;
  camera.centre = place;
  camera.back = glm::normalize(back);
  camera.halfHeight = half;
  camera.distance = 4. * half;
  camera.nearest = 2.5 * half;
  camera.size = size;
  return camera;
}

std::vector<PictureCamera> ViewsOfCorners(const SurfaceCase& surface, int size, int count)
{
  vtkPolyData* particles = surface.Particles;
  const std::vector<int> edges = CountEdges(particles);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(particles);
  locator->BuildLocator();
  const double half = NearView * surface.Spacing;
  std::vector<int> score(edges.size());
  vtkNew<vtkIdList> near;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    locator->FindPointsWithinRadius(0.3 * half, particles->GetPoint(i), near);
    for (vtkIdType n = 0; n < near->GetNumberOfIds(); ++n)
    {
      const int there = edges[near->GetId(n)];
      score[i] += there * there;
    }
  }
  std::vector<PictureCamera> cameras;
  for (int n = 0; n < count; ++n)
  {
    const auto best = std::max_element(score.begin(), score.end());
    if (best == score.end() || *best < 0)
    {
      break;
    }
    const vtkIdType id = best - score.begin();
    double x[3], normal[3];
    particles->GetPoint(id, x);
    particles->GetPointData()->GetNormals()->GetTuple(id, normal);
    cameras.push_back(ViewNear(surface, size, { x[0], x[1], x[2] },
      glm::dvec3(normal[0], normal[1], normal[2]) + glm::dvec3(0.31, 0.17, 0.23)));
    locator->FindPointsWithinRadius(1.5 * half, x, near);
    for (vtkIdType k = 0; k < near->GetNumberOfIds(); ++k)
    {
      score[near->GetId(k)] = -1;
    }
  }
  return cameras;
}
