#include "Particles/MarkLayers.h"

#include "Particles/ParticleLocator.h"
#include "Particles/SplatParticles.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkSMPTools.h"
#include "vtkVector.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hop
{
namespace
{
/** What makes a step of the surface. Lengths are in radii of the particle. All were chosen by experiment. */
struct Step
{
  /** Distance up to which a particle looks. A larger one takes sheets farther off for layers, and costs more. */
  static constexpr double Reach = 1.5;
  /** Smallest height of a step. Smaller ones are hardly seen; a smaller bound marks surfaces that bend strongly. */
  static constexpr double LeastHeight = 0.08;
  /**
   * Smallest height over distance aside of a particle that lies above or below the layer. At a crease whose normals differ
   * by 37 degrees it is 0.3, on surfaces that bend evenly 0. A larger one overlooks layers near each other.
   */
  static constexpr double Steepness = 0.35;
  /** Smallest cosine between the normals of both layers: 37 degrees. Others are no layers that would be averaged. */
  static constexpr double LeastCosine = 0.8;
};

vtkVector3d VectorAt(const std::vector<float>& values, vtkIdType first)
{
  return vtkVector3d(values[first], values[first + 1], values[first + 2]);
}

/** Whether a plane, which is that of a boundary curve or of a sharp crease then, ends the splat of a particle. */
bool EndsSplat(const SplatParticles& particles, vtkIdType particle, int plane)
{
  const float* clip = &particles.Clip[particles.ClipStride * particle];
  const float* normal = clip + SplatParticles::PlaneAt(plane);
  const bool exists = normal[0] != 0.f || normal[1] != 0.f || normal[2] != 0.f;
  return exists && clip[SplatParticles::OverlapPlace(plane)] == 0.f &&
    normal[3] < particles.CentreRadius[4 * particle + 3];
}

/**
 * Whether a neighbour lies on another layer: steeply above or below the particle, or a step higher or lower behind an end
 * of the particle's layer.
 */
bool IsOnOtherLayer(const SplatParticles& particles, vtkIdType particle, vtkIdType neighbor)
{
  // Different isovalues are told apart by their tags.
  const auto isovalueOf = [&](vtkIdType i)
  { return static_cast<int>(particles.Normal[4 * i + 3]) / 2; };
  if (isovalueOf(particle) != isovalueOf(neighbor))
  {
    return false;
  }
  const vtkVector3d normal = VectorAt(particles.Normal, 4 * particle);
  const vtkVector3d there = VectorAt(particles.Normal, 4 * neighbor);
  vtkVector3d offset = VectorAt(particles.CentreRadius, 4 * neighbor);
  vtkMath::Subtract(offset, VectorAt(particles.CentreRadius, 4 * particle), offset);
  // Between two particles of one layer that bends evenly this is zero: the normal turns as much before the middle as
  // behind it.
  const double height = 0.5 * (offset.Dot(normal) + offset.Dot(there));
  const double radius = particles.CentreRadius[4 * particle + 3];
  if (normal.Dot(there) < Step::LeastCosine || std::abs(height) < Step::LeastHeight * radius)
  {
    return false;
  }
  const double square = height * height;
  if (square > Step::Steepness * Step::Steepness * (offset.SquaredNorm() - square))
  {
    return true;
  }
  const int planes = SplatParticles::ClipPlanesIn(particles.ClipStride);
  for (int plane = 0; plane < planes; ++plane)
  {
    const vtkIdType first = particles.ClipStride * particle + SplatParticles::PlaneAt(plane);
    if (EndsSplat(particles, particle, plane) &&
      offset.Dot(VectorAt(particles.Clip, first)) >= particles.Clip[first + 3])
    {
      return true;
    }
  }
  return false;
}
}

//------------------------------------------------------------------------------
void MarkLayers(SplatParticles& particles)
{
  const vtkIdType count = particles.GetNumberOfParticles();
  const ParticleLocator locator(
    particles.CentreRadius.data(), particles.ClipStride > 0 ? count : 0);
  if (locator.GetDistance() == 0.)
  {
    return;
  }
  std::vector<char> marked(count, 0);
  vtkSMPTools::For(0, count,
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkNew<vtkIdList> around;
      for (vtkIdType i = begin; i < end; ++i)
      {
        const double radius = particles.CentreRadius[4 * i + 3];
        if (radius > 0.)
        {
          locator.FindAround(i, std::min(Step::Reach * radius, 4. * locator.GetDistance()), around);
          marked[i] = std::any_of(around->begin(), around->end(),
            [&](vtkIdType j) { return j != i && IsOnOtherLayer(particles, i, j); });
        }
      }
    });
  for (vtkIdType i = 0; i < count; ++i)
  {
    particles.Normal[4 * i + 3] += marked[i] ? SplatParticles::LayerMark : 0.f;
    particles.HasLayers = particles.HasLayers || marked[i];
  }
}
}
