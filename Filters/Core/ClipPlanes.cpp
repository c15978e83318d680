#include "ClipPlanes.h"

#include "ActiveFaces.h"
#include "SpacingGrid.h"

#include <atomic>
#include <cmath>

namespace hop
{
namespace
{

/// Keeps the nearer of two planes.
void offer(Particle& particle, const glm::dvec3& normal, double distance)
{
  const bool first = glm::dot(particle.clipNormal.xyz, particle.clipNormal.xyz) == 0.0;
  if (distance <= ClipReach * particle.spacing && (first || distance < particle.clipDistance))
  {
    particle.clipNormal = { normal };
    particle.clipDistance = std::max(0.0, distance);
  }
}

void offerRims(const SpacingGrid& grid, const std::vector<RimParticle>& rims, Particle& particle)
{
  double nearest = ClipReach * particle.spacing;
  int rim = -1;
  grid.visit(particle.position.xyz, particle.spacing,
    [&](int j)
    {
      const double distance = length(rims[j].particle.position - particle.position);
      if (distance < nearest && dot(rims[j].particle.normal, particle.normal) > 0.0)
      {
        nearest = distance;
        rim = j;
      }
    });
  if (rim >= 0)
  {
    const WorldVector& outward = rims[rim].outward;
    if (dot(outward, outward) > 0.0)
    {
      offer(particle, outward.xyz, dot(rims[rim].particle.position - particle.position, outward));
    }
  }
}

/// \return evaluations
int offerKinks(const ElementMesh& mesh, const std::vector<char>& kinks, Particle& particle)
{
  const Location& location = particle.location;
  const auto& faces = facts(mesh.elements[location.element].domain).faces;
  const auto kinked = [&](std::size_t face)
  { return kinks[static_cast<std::size_t>(location.element) * MaximumFaces + face] != 0; };
  LocalMap map;
  int evaluations = 0;
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    if (!kinked(f))
    {
      continue;
    }
    if (evaluations++ == 0)
    {
      map = fieldPoint(evaluateGradient(mesh.form(location.element), location.u), 0.0).map;
    }
    const glm::dvec3 inward = glm::transpose(map.inverse) * faces[f].inward.xyz;
    const double slope = glm::length(inward);
    if (slope > 0.0)
    {
      offer(particle, inward / -slope, faceMargin(faces[f], location.u) / slope);
    }
  }
  return std::min(evaluations, 1);
}

} // namespace

std::int64_t markClipPlanes(const ElementMesh& mesh, const FaceJumps& jumps,
  const std::vector<RimParticle>& rims, std::vector<Particle>& particles,
  const ParallelFor& parallelFor)
{
  std::vector<glm::dvec3> positions;
  std::vector<float> spacings;
  for (const RimParticle& rim : rims)
  {
    positions.push_back(rim.particle.position.xyz);
    spacings.push_back(rim.patch.spacing);
  }
  const SpacingGrid grid(positions, spacings, ClipReach, 0.5);
  std::atomic<std::int64_t> evaluations{ 0 };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(particles.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::int64_t cost = 0;
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        offerRims(grid, rims, particles[i]);
        cost += offerKinks(mesh, jumps.kinks, particles[i]);
      }
      evaluations += cost;
    });
  return evaluations;
}

} // namespace hop
