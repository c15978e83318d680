#include "Drawing/Culling.h"

#include "Common/VtkThreads.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{
using Culling::Camera;
using Culling::Splats;

/**
 * What keeps rounding from leaving out a splat that is seen. Both numbers are far above the rounding of float32; larger
 * ones find fewer hidden splats.
 */
struct Safety
{
  /** Factor on the radius up to which a splat hides others, no unit. */
  static constexpr float Shrink = 0.95f;
  /** By how much a splat that hides ends earlier, and one that is hidden later, than it is drawn; pixels. */
  static constexpr float Margin = 0.1f;
};

// Number of splats from which on starting threads is worth it, chosen by experiment. A smaller one starts threads that
// cost more than they save; a larger one leaves cores idle.
constexpr vtkIdType WorthThreads = 20000;

// Largest difference of a similarity's scaled axes from right angles and equal lengths, as a share of the squared
// length. Some hundred times the rounding of float32; a larger one lets matrices through that stretch visibly.
constexpr float SimilarityError = 1e-4f;

// Where a splat is in the picture.
struct Footprint
{
  vtkIdType Particle = 0;
  glm::vec3 CentreVC;
  float RadiusVC = 0.f; // 0: nothing is drawn
  glm::vec2 Middle;     // pixels
  // Half the side of the square around the splat if it faces the eye, pixels; infinite near the eye.
  float HalfSize = 0.f;
  float Wider = 1.f;   // factor by which a splat in perspective may reach beyond this square
  float Nearest = 0.f; // smallest depth of the splat, device coordinates
};

class Projector
{
public:
  Projector(const Camera& camera, const Splats& splats)
    : View(camera)
    , All(splats)
    , Linear(camera.MCVC)
    , Scale(glm::length(this->Linear[0]))
    , Size(camera.Width, camera.Height)
    , Pixel(2.f / (glm::vec2(camera.VCDC[0][0], camera.VCDC[1][1]) * this->Size))
  {
  }

  Footprint FootprintOf(vtkIdType number) const;
  bool HidesOthers(const Footprint& splat) const;
  float FarthestOf(const Footprint& splat) const;
  glm::vec3 NormalOf(const Footprint& splat) const;
  glm::vec3 OnDisk(const Footprint& splat, const glm::vec3& normalVC, glm::vec2 offset) const;

private:
  float DepthAt(float z) const
  {
    const glm::mat4& projection = this->View.VCDC;
    return (projection[2][2] * z + projection[3][2]) / (projection[2][3] * z + projection[3][3]);
  }

  const Camera& View;
  const Splats& All;
  const glm::mat3 Linear; // part of MCVC
  const float Scale;
  const glm::vec2 Size;
  const glm::vec2 Pixel; // size of a pixel (VC) at distance 1, or everywhere if parallel
};

Footprint Projector::FootprintOf(vtkIdType number) const
{
  Footprint splat;
  splat.Particle = number * this->All.Stride;
  const float* centreRadius = this->All.CentreRadius + 4 * splat.Particle;
  const glm::vec3 centreMC(centreRadius[0], centreRadius[1], centreRadius[2]);
  splat.CentreVC = this->Linear * centreMC + glm::vec3(this->View.MCVC[3]);
  const float radius = centreRadius[3] * this->All.RadiusScale * this->Scale;
  const float distance = -splat.CentreVC.z;
  if (!(radius > 0.f))
  {
    return splat;
  }
  const float pixel = this->Pixel.y * (this->View.Parallel ? 1.f : std::abs(distance));
  splat.RadiusVC = std::max(radius, this->All.LeastPixels * pixel);
  splat.Nearest = this->DepthAt(splat.RadiusVC - distance);
  if (!this->View.Parallel && distance <= 2.f * splat.RadiusVC)
  {
    splat.HalfSize = std::numeric_limits<float>::infinity();
    return splat;
  }
  const glm::vec4 clip = this->View.VCDC * glm::vec4(splat.CentreVC, 1.f);
  splat.Middle = (0.5f * glm::vec2(clip) / clip.w + 0.5f) * this->Size;
  splat.HalfSize = splat.RadiusVC / pixel;
  // In perspective a splat lies in the outline of a ball of its radius.
  splat.Wider =
    this->View.Parallel ? 1.f : glm::length(splat.CentreVC) / (distance - splat.RadiusVC);
  return splat;
}

// Splats with clip planes hide nothing, nor do splats that may not be drawn whole.
bool Projector::HidesOthers(const Footprint& splat) const
{
  const auto isPlane = [](const float* normal)
  { return normal[0] != 0.f || normal[1] != 0.f || normal[2] != 0.f; };
  const float* planes =
    this->All.Clip ? this->All.Clip + this->All.ClipStride * splat.Particle : nullptr;
  return splat.RadiusVC > 0.f && std::isfinite(splat.HalfSize) && splat.Nearest > -1.f &&
    glm::all(glm::greaterThan(splat.Middle, glm::vec2(0.f))) &&
    glm::all(glm::lessThan(splat.Middle, this->Size)) &&
    !(planes && (isPlane(planes) || isPlane(planes + 4))); // a third plane comes after two others
}

// The largest depth that the passes give the splat.
float Projector::FarthestOf(const Footprint& splat) const
{
  return this->DepthAt(splat.CentreVC.z - (1.f + this->All.Push) * splat.RadiusVC);
}

glm::vec3 Projector::NormalOf(const Footprint& splat) const
{
  const float* normal = this->All.Normal + 4 * splat.Particle;
  return this->Linear * glm::vec3(normal[0], normal[1], normal[2]);
}

// The place on a disk, relative to its middle (VC), that is seen at this offset from its middle in the picture
// (pixels).
glm::vec3 Projector::OnDisk(
  const Footprint& splat, const glm::vec3& normalVC, glm::vec2 offset) const
{
  const glm::vec3 across(offset * this->Pixel, 0.f);
  if (this->View.Parallel)
  {
    return across - glm::vec3(0.f, 0.f, glm::dot(normalVC, across) / normalVC.z);
  }
  const glm::vec3 ray = across - splat.CentreVC / splat.CentreVC.z;
  const float along = glm::dot(normalVC, splat.CentreVC) / glm::dot(normalVC, ray);
  return along * ray - splat.CentreVC;
}

// For each square cell of the picture, the depth behind which nothing is seen.
class HidingDepths
{
public:
  HidingDepths(const Camera& camera, int cellSize)
    : CellSize(cellSize)
    , Size(camera.Width, camera.Height)
    , Cells((this->Size + cellSize - 1) / cellSize)
    , Depths(static_cast<std::size_t>(this->Cells.x) * this->Cells.y)
  {
    for (std::atomic<float>& depth : this->Depths)
    {
      depth.store(Nothing, std::memory_order_relaxed);
    }
  }

  // Adds a splat that is nowhere deeper than a depth. isSolid() tells whether the splat covers the pixel at an offset
  // (pixels) from its middle.
  template <typename IsSolid>
  void Add(glm::vec2 middle, float halfSize, float depth, const IsSolid& isSolid)
  {
    const auto [firstPixel, endPixel] = this->PixelsIn(middle, halfSize);
    const glm::ivec2 end = endPixel / this->CellSize;
    const glm::ivec2 first = (firstPixel + this->CellSize - 1) / this->CellSize;
    for (int y = first.y; y < end.y; ++y)
    {
      for (int x = first.x; x < end.x; ++x)
      {
        const glm::vec2 low(this->CellSize * glm::ivec2(x, y));
        const glm::vec2 from = low + 0.5f - middle;
        const glm::vec2 to = from + static_cast<float>(this->CellSize - 1);
        if (isSolid(from) &&
          (this->CellSize == 1 ||
            (isSolid(to) && isSolid({ from.x, to.y }) && isSolid({ to.x, from.y }))))
        {
          Lower(this->Depths[static_cast<std::size_t>(y) * this->Cells.x + x], depth);
        }
      }
    }
  }

  // Whether the splats that were added hide all that lies in a square at this depth or behind it.
  bool Hide(glm::vec2 middle, float halfSize, float depth) const
  {
    const auto [firstPixel, endPixel] = this->PixelsIn(middle, halfSize);
    const glm::ivec2 end = (endPixel + this->CellSize - 1) / this->CellSize;
    const glm::ivec2 first = firstPixel / this->CellSize;
    for (int y = first.y; y < end.y; ++y)
    {
      const std::atomic<float>* row = &this->Depths[static_cast<std::size_t>(y) * this->Cells.x];
      const bool hidden = std::all_of(row + first.x, row + std::max(first.x, end.x),
        [&](const std::atomic<float>& nearest)
        { return nearest.load(std::memory_order_relaxed) < depth; });
      if (!hidden)
      {
        return false;
      }
    }
    return true;
  }

private:
  static constexpr float Nothing = 2.f; // behind all depths, which end at 1

  static void Lower(std::atomic<float>& depth, float to)
  {
    float before = depth.load(std::memory_order_relaxed);
    while (to < before && !depth.compare_exchange_weak(before, to, std::memory_order_relaxed))
    {
    }
  }

  // The pixels whose centres lie in a square: the first one, and the one after the last.
  std::array<glm::ivec2, 2> PixelsIn(glm::vec2 middle, float halfSize) const
  {
    const glm::vec2 none(0.f);
    const glm::vec2 all(this->Size);
    return { glm::ivec2(glm::clamp(middle - halfSize + 0.5f, none, all)),
      glm::ivec2(glm::clamp(middle + halfSize + 0.5f, none, all)) };
  }

  int CellSize;     // pixels
  glm::ivec2 Size;  // pixels
  glm::ivec2 Cells; // columns and rows
  std::vector<std::atomic<float>> Depths;
};
}

//------------------------------------------------------------------------------
bool Culling::IsSimilarity(const glm::mat4& matrix)
{
  const glm::mat3 linear(matrix);
  const glm::mat3 products = glm::transpose(linear) * linear;
  const float square = products[0][0];
  const glm::mat3 difference = products - glm::mat3(square);
  float largest = 0.f;
  for (int column = 0; column < 3; ++column)
  {
    const glm::vec3 part = glm::abs(difference[column]);
    largest = std::max({ largest, part.x, part.y, part.z });
  }
  return largest < SimilarityError * square;
}

namespace
{
void Add(HidingDepths& depths, const Splats& splats, const Projector& projector, vtkIdType number)
{
  const Footprint splat = projector.FootprintOf(number);
  if (!projector.HidesOthers(splat))
  {
    return;
  }
  const float solid = Safety::Shrink * splats.Solid * splat.RadiusVC;
  const glm::vec3 normal = projector.NormalOf(splat);
  depths.Add(splat.Middle, splats.Solid * splat.HalfSize - Safety::Margin,
    projector.FarthestOf(splat),
    [&](glm::vec2 offset)
    {
      const glm::vec3 place = projector.OnDisk(splat, normal, offset);
      return glm::dot(place, place) < solid * solid;
    });
}

bool MayBeSeen(const HidingDepths& depths, const Footprint& splat)
{
  const float halfSize = splat.Wider * splat.HalfSize + Safety::Margin;
  return splat.RadiusVC > 0.f &&
    !(std::isfinite(halfSize) && depths.Hide(splat.Middle, halfSize, splat.Nearest));
}

// For each splat whether it may be seen. First all splats are added that hide others, then all are looked at.
std::vector<char> FindSeen(const Camera& camera, const Splats& splats, vtkIdType first,
  vtkIdType end, const hop::ParallelFor& parallelFor)
{
  const Projector projector(camera, splats);
  HidingDepths depths(camera, splats.CellSize);
  parallelFor(end - first,
    [&](std::ptrdiff_t begin, std::ptrdiff_t stop)
    {
      for (std::ptrdiff_t n = begin; n < stop; ++n)
      {
        Add(depths, splats, projector, first + n);
      }
    });
  std::vector<char> seen(end - first);
  parallelFor(end - first,
    [&](std::ptrdiff_t begin, std::ptrdiff_t stop)
    {
      for (std::ptrdiff_t n = begin; n < stop; ++n)
      {
        seen[n] = MayBeSeen(depths, projector.FootprintOf(first + n));
      }
    });
  return seen;
}
}

//------------------------------------------------------------------------------
std::vector<unsigned int> Culling::FindVisible(
  const Camera& camera, const Splats& splats, vtkIdType first, vtkIdType end)
{
  std::vector<char> seen;
  const auto find = [&](const hop::ParallelFor& parallelFor)
  { seen = FindSeen(camera, splats, first, end, parallelFor); };
  if (end - first < WorthThreads)
  {
    find([](std::ptrdiff_t count, const hop::LoopBody& body) { body(0, count); });
  }
  else
  {
    withThreads(find);
  }
  std::vector<unsigned int> visible;
  visible.reserve(std::count(seen.begin(), seen.end(), 1));
  for (std::size_t n = 0; n < seen.size(); ++n)
  {
    if (seen[n])
    {
      visible.push_back(static_cast<unsigned int>(first + static_cast<vtkIdType>(n)));
    }
  }
  return visible;
}
}
