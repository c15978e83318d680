#include "Edges/CellBorders.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// Which borders a particle sees. Lengths are in units of the spacing.
struct BorderSight
{
  /// Largest distance of a border: a splat ends at one spacing. A larger one keeps borders that cut nothing off.
  static constexpr double Reach = 1.0;
  /// Distances to first order up to which a face is looked at: curved ones may be nearer than that. Chosen by
  /// experiment; a larger one costs time, a smaller one misses borders of bent faces at the rim of a splat.
  static constexpr double FirstOrderReach = 1.25;
  /// Newton steps to the nearest place of a border. More move it by less than a hundredth.
  static constexpr int Steps = 3;
  /// Largest error of that place. A larger one accepts borders that Newton's method did not find, a smaller one drops
  /// borders that bend fast.
  static constexpr double Accuracy = 0.05;
  /// Largest curvature, 1/spacing, that a parabola follows within a splat.
  static constexpr double LargestCurvature = 1.0;
  /// Distance that stands for 0, so that the vector to a border keeps its direction. Far below what is seen, far above
  /// the smallest number of single precision.
  static constexpr double Least = 1e-5;
};

/// The margin of a face on the surface, as a function of the place (x, y) in the tangent plane of a particle:
/// value + slope x + (xx x^2 + 2 xy x y + yy y^2) / 2.
struct MarginOnSurface
{
  double value, slope, xx, xy, yy;

  double at(const glm::dvec2& t) const
  {
    return this->value + this->slope * t.x + 0.5 * (this->xx * t.x * t.x + this->yy * t.y * t.y) +
      this->xy * t.x * t.y;
  }
  glm::dvec2 gradientAt(const glm::dvec2& t) const
  {
    return { this->slope + this->xx * t.x + this->xy * t.y, this->xy * t.x + this->yy * t.y };
  }
};

/// The border {margin = 0} where it is nearest.
/// \param x, y axes of the tangent plane, unit vectors
/// \return no border if that place is not within reach
CellBorder nearestPlace(
  const MarginOnSurface& margin, const glm::dvec3& x, const glm::dvec3& y, double spacing)
{
  glm::dvec2 place(0.0);
  glm::dvec2 gradient = margin.gradientAt(place);
  for (int step = 0; step < BorderSight::Steps; ++step)
  {
    place =
      ((glm::dot(gradient, place) - margin.at(place)) / glm::dot(gradient, gradient)) * gradient;
    gradient = margin.gradientAt(place);
  }
  const double steepness = glm::length(gradient);
  const double error = std::abs(margin.at(place)) / steepness;
  if (!(glm::length(place) <= BorderSight::Reach * spacing) ||
    !(error <= BorderSight::Accuracy * spacing))
  {
    return {};
  }
  const glm::dvec2 outward = gradient / -steepness;
  const glm::dvec2 along(-outward.y, outward.x);
  const double second = margin.xx * along.x * along.x + 2.0 * margin.xy * along.x * along.y +
    margin.yy * along.y * along.y;
  const double largest = BorderSight::LargestCurvature / spacing;
  const double distance = std::max(glm::dot(place, outward), BorderSight::Least * spacing);
  return { glm::vec3(distance * (outward.x * x + outward.y * y)),
    static_cast<float>(std::clamp(second / steepness, -largest, largest)) };
}

/// The border at a face as the particle sees it; none if it is out of reach.
CellBorder borderAt(const Face& face, const Jet& jet, const LocalMap& map, const Particle& particle)
{
  const double margin = std::max(0.0, faceMargin(face, particle.location.u));
  const glm::dvec3 gradient = glm::transpose(map.inverse) * face.inward.xyz;
  const glm::dvec3& normal = particle.normal.xyz;
  const double rise = glm::dot(gradient, normal);
  const glm::dvec3 alongSurface = gradient - rise * normal;
  const double slope = glm::length(alongSurface);
  if (!(margin <= BorderSight::FirstOrderReach * particle.spacing * slope) || slope == 0.0)
  {
    return {};
  }
  // At t along the tangent plane the surface lies t.St / 2 below the plane, S the shape operator.
  const glm::dmat3 bend = faceLevels(jet, map, face).hessian - rise * particle.curvature.shape;
  const glm::dvec3 x = alongSurface / slope;
  const glm::dvec3 y = glm::cross(normal, x);
  const glm::dvec3 bendX = bend * x;
  const MarginOnSurface onSurface{ margin, slope, glm::dot(x, bendX), glm::dot(y, bendX),
    glm::dot(y, bend * y) };
  return nearestPlace(onSurface, x, y, particle.spacing);
}

/// Keeps the nearest borders, sorted by distance.
void keepNearest(const CellBorder& border, std::array<CellBorder, CellBorder::Most>& kept)
{
  const auto comesBefore = [](const CellBorder& a, const CellBorder& b)
  { return a.exists() && (!b.exists() || glm::dot(a.foot, a.foot) < glm::dot(b.foot, b.foot)); };
  const auto place = std::upper_bound(kept.begin(), kept.end(), border, comesBefore);
  if (border.exists() && place != kept.end())
  {
    std::move_backward(place, kept.end() - 1, kept.end());
    *place = border;
  }
}

} // namespace

void markCellBorders(
  const ElementMesh& mesh, const Jet& jet, const LocalMap& map, Particle& particle)
{
  for (const Face& face : facts(mesh.elements[particle.location.element].domain).faces)
  {
    keepNearest(borderAt(face, jet, map, particle), particle.borders);
  }
}

} // namespace hop
