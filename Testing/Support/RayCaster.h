#pragma once

#include "Common/Monitor.h"
#include "Elements/ElementMesh.h"

#include <vector>

namespace hop::testing
{

/// A camera that looks at a centre, and its square picture.
struct PictureCamera
{
  glm::dvec3 centre{ 0.0 };
  /// Unit vector from the centre to the eye.
  glm::dvec3 back{ 0.0, 0.0, 1.0 };
  /// Whether the projection is parallel, not perspective.
  bool parallel = false;
  /// From the eye to the centre, world units.
  double distance = 4.0;
  /// Half the height of the picture, at the centre's depth, world units.
  double halfHeight = 1.3;
  /// Pixels along each side.
  int size = 512;
  /// Depth before which nothing is seen, as a near plane does; world units.
  double nearest = 0.0;

  glm::dvec3 right() const;
  glm::dvec3 up() const;
  glm::dvec3 eye() const { return this->centre + this->distance * this->back; }
  /// World units a pixel, at the centre.
  double pixel() const { return 2.0 * this->halfHeight / this->size; }

  struct Ray
  {
    glm::dvec3 origin;
    /// Length 1 along the camera's axis, so that a ray's parameter is the depth before the eye.
    glm::dvec3 direction;
  };
  /// The ray through a place of the picture, in pixels from its lower left corner; middles of pixels lie at
  /// halves.
  Ray ray(double x, double y) const;
  /// Where in the picture a point is seen.
  glm::dvec2 project(const glm::dvec3& point) const;
  /// Unit vector from a point to the eye.
  glm::dvec3 toEye(const glm::dvec3& point) const;
};

/// The point of the surface that is seen at a pixel.
struct SeenPoint
{
  /// Depth along the camera's axis, world units; infinite where no surface is seen.
  double depth = std::numeric_limits<double>::infinity();
  /// Unit normal -grad F/|grad F|.
  glm::dvec3 normal{ 0.0 };
  /// The input's cell, and how far off the nearest border of the cell is along the surface, to first order; world units.
  std::int64_t cell = -1;
  double toBorder = 0.0;

  bool covered() const { return this->depth < std::numeric_limits<double>::infinity(); }
};

/// The isosurface of the elements' own polynomials as the camera sees it, one ray a pixel: slow and
/// exact, without any triangle. A ray meets the surface where Newton's method in reference
/// coordinates and depth finds F = isovalue, from starts in every surface box (SurfaceBoxes.h) that the ray may pass;
/// boxes in the picture have the size of a few pixels. Slits between elements whose fields differ a little are closed up to a fifth
/// of a pixel on either side.
/// \return size * size pixels, lower left first
std::vector<SeenPoint> castRays(const ElementMesh& mesh, double isovalue,
  const PictureCamera& camera, const ParallelFor& parallelFor);

} // namespace hop::testing
