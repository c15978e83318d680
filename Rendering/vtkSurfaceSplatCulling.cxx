#include "vtkSurfaceSplatCulling.h"

#include "Threads.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

namespace
{
using vtkSurfaceSplatCulling::Camera;
using vtkSurfaceSplatCulling::Splats;

// Against rounding: as if splats that hide others were so much smaller,
constexpr float Shrink = 0.95f;
// ended so many pixels before the end of the squares that are drawn,
constexpr float Margin = 0.1f;
// and lay so much before those that they hide (device coordinates, -1 to 1).
constexpr float Before = 1e-5f;

// A splat in the picture.
struct Footprint
{
  vtkIdType Particle = 0;
  glm::vec3 CentreVC;
  float RadiusVC = 0.f;
  glm::vec2 Middle;     // pixels
  float HalfSize = 0.f; // of the square that is drawn, pixels; 0: nothing is
  glm::vec3 Device;
};

// A splat that hides others: where it does, and from which depth on.
struct Screen
{
  glm::vec3 NormalVC;
  glm::vec3 RayVC; // along which places have one pixel
  float PerSlant;  // how far along the ray, for every length along the normal
  float Depth;
};

class Projector
{
public:
  Projector(const Camera& camera, const Splats& splats)
    : View(camera)
    , All(splats)
    , Turn(camera.MCVC)
    , Scale(glm::length(this->Turn[0]))
    , Size(camera.Width, camera.Height)
    , Pixel(2.f / (glm::vec2(camera.VCDC[0][0], camera.VCDC[1][1]) * this->Size))
  {
  }

  // Of a pixel at a depth, view coordinates.
  glm::vec2 PixelAt(const Footprint& splat) const
  {
    return this->View.Parallel ? this->Pixel : std::abs(splat.CentreVC.z) * this->Pixel;
  }

  Footprint FootprintOf(vtkIdType number) const;
  bool HidesOthers(const Footprint& splat) const;
  Screen ScreenOf(const Footprint& splat) const;

private:
  const Camera& View;
  const Splats& All;
  const glm::mat3 Turn;
  const float Scale;
  const glm::vec2 Size;
  const glm::vec2 Pixel; // at distance 1, or everywhere if parallel
};

Footprint Projector::FootprintOf(vtkIdType number) const
{
  Footprint splat;
  splat.Particle = number * this->All.Stride;
  const float* centreRadius = this->All.CentreRadius + 4 * splat.Particle;
  const glm::vec3 centreMC(centreRadius[0], centreRadius[1], centreRadius[2]);
  splat.CentreVC = this->Turn * centreMC + glm::vec3(this->View.MCVC[3]);
  const glm::vec4 clip = this->View.VCDC * glm::vec4(splat.CentreVC, 1.f);
  const float radius = centreRadius[3] * this->All.RadiusScale * this->Scale;
  if (radius > 0.f && clip.w > 0.f)
  {
    const float pixel = this->PixelAt(splat).y;
    splat.RadiusVC = std::max(radius, this->All.LeastPixels * pixel);
    splat.HalfSize = std::max(splat.RadiusVC / pixel, 0.5f);
    splat.Device = glm::vec3(clip) / clip.w;
    splat.Middle = (0.5f * glm::vec2(splat.Device) + 0.5f) * this->Size;
  }
  return splat;
}

// Not those with clip planes, nor those whose middle is out of the view, which not all drivers draw.
bool Projector::HidesOthers(const Footprint& splat) const
{
  const auto isPlane = [](const float* normal)
  { return normal[0] != 0.f || normal[1] != 0.f || normal[2] != 0.f; };
  const float* planes = this->All.Clip ? this->All.Clip + 12 * splat.Particle : nullptr;
  return splat.HalfSize > 0.f && glm::all(glm::lessThan(glm::abs(splat.Device), glm::vec3(1.f))) &&
    !(planes && (isPlane(planes) || isPlane(planes + 4)));
}

Screen Projector::ScreenOf(const Footprint& splat) const
{
  constexpr float mostSlanted = 0.2f; // in the eyes of the shader
  const float* normal = this->All.Normal + 4 * splat.Particle;
  const glm::vec3 ray =
    this->View.Parallel ? glm::vec3(0.f, 0.f, -1.f) : splat.CentreVC / std::abs(splat.CentreVC.z);
  Screen screen;
  screen.NormalVC = this->Turn * glm::vec3(normal[0], normal[1], normal[2]);
  screen.RayVC = ray;
  screen.PerSlant = 1.f / glm::dot(screen.NormalVC, ray);
  const float push = this->All.Push * splat.RadiusVC / mostSlanted;
  const glm::vec4 pushed = this->View.VCDC * glm::vec4(splat.CentreVC + push * ray, 1.f);
  screen.Depth = pushed.z / pushed.w;
  return screen;
}

// Of every pixel, from which depth on nothing is seen.
class HidingDepths
{
public:
  HidingDepths(const Camera& camera, float solid)
    : Size(camera.Width, camera.Height)
    , Solid(solid)
    , Depths(new std::atomic<float>[static_cast<std::size_t>(camera.Width) * camera.Height])
  {
    std::for_each(this->Depths.get(),
      this->Depths.get() + static_cast<std::size_t>(camera.Width) * camera.Height,
      [](std::atomic<float>& depth) { depth.store(Nothing, std::memory_order_relaxed); });
  }

  void Add(const Footprint& splat, const Screen& screen, glm::vec2 pixel)
  {
    const float reach = Shrink * this->Solid * splat.RadiusVC;
    this->VisitPixels(splat, this->Solid * splat.HalfSize - Margin,
      [&](std::atomic<float>& depth, glm::vec2 offset)
      {
        const glm::vec3 across(offset * pixel, 0.f);
        const float along = glm::dot(screen.NormalVC, across) * screen.PerSlant;
        const glm::vec3 onDisk = across - along * screen.RayVC;
        if (glm::dot(onDisk, onDisk) < reach * reach)
        {
          Lower(depth, screen.Depth);
        }
        return true;
      });
  }

  bool Hide(const Footprint& splat) const
  {
    return this->VisitPixels(splat, splat.HalfSize + Margin,
      [&](const std::atomic<float>& depth, glm::vec2)
      { return depth.load(std::memory_order_relaxed) < splat.Device.z - Before; });
  }

private:
  static constexpr float Nothing = 2.f;

  static void Lower(std::atomic<float>& depth, float to)
  {
    float before = depth.load(std::memory_order_relaxed);
    while (to < before && !depth.compare_exchange_weak(before, to, std::memory_order_relaxed))
    {
    }
  }

  // Calls with those whose centres lie in a square around the splat's middle, and with their offsets from it, as
  // long as it gets true; returns whether it always did.
  template <typename Visit>
  bool VisitPixels(const Footprint& splat, float reach, const Visit& visit) const
  {
    const glm::vec2 size(this->Size);
    const glm::ivec2 first(glm::clamp(splat.Middle - reach + 0.5f, glm::vec2(0.f), size));
    const glm::ivec2 end(glm::clamp(splat.Middle + reach + 0.5f, glm::vec2(0.f), size));
    for (int y = first.y; y < end.y; ++y)
    {
      for (int x = first.x; x < end.x; ++x)
      {
        const glm::vec2 centre(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        if (!visit(
              this->Depths[static_cast<std::size_t>(y) * this->Size.x + x], centre - splat.Middle))
        {
          return false;
        }
      }
    }
    return true;
  }

  glm::ivec2 Size;
  float Solid; // radii
  std::unique_ptr<std::atomic<float>[]> Depths;
};
}

//------------------------------------------------------------------------------
bool vtkSurfaceSplatCulling::IsSimilarity(const glm::mat4& matrix)
{
  const glm::mat3 turn(matrix);
  const glm::mat3 products = glm::transpose(turn) * turn;
  const float square = products[0][0];
  const glm::mat3 difference = products - glm::mat3(square);
  float largest = 0.f;
  for (int column = 0; column < 3; ++column)
  {
    const glm::vec3 part = glm::abs(difference[column]);
    largest = std::max({ largest, part.x, part.y, part.z });
  }
  return largest < 1e-4f * square;
}

//------------------------------------------------------------------------------
std::vector<unsigned int> vtkSurfaceSplatCulling::FindVisible(
  const Camera& camera, const Splats& splats, vtkIdType first, vtkIdType end)
{
  const Projector projector(camera, splats);
  HidingDepths depths(camera, splats.Solid);
  std::vector<char> seen(end - first);
  withThreads(
    [&](const hop::ParallelFor& parallelFor)
    {
      parallelFor(end - first,
        [&](std::ptrdiff_t begin, std::ptrdiff_t stop)
        {
          for (std::ptrdiff_t n = begin; n < stop; ++n)
          {
            const Footprint splat = projector.FootprintOf(first + n);
            if (projector.HidesOthers(splat))
            {
              depths.Add(splat, projector.ScreenOf(splat), projector.PixelAt(splat));
            }
          }
        });
      parallelFor(end - first,
        [&](std::ptrdiff_t begin, std::ptrdiff_t stop)
        {
          for (std::ptrdiff_t n = begin; n < stop; ++n)
          {
            const Footprint splat = projector.FootprintOf(first + n);
            seen[n] = splat.HalfSize > 0.f && !depths.Hide(splat);
          }
        });
    });
  std::vector<unsigned int> visible;
  visible.reserve(std::count(seen.begin(), seen.end(), 1));
  for (vtkIdType number = first; number < end; ++number)
  {
    if (seen[number - first])
    {
      visible.push_back(static_cast<unsigned int>(number));
    }
  }
  return visible;
}
