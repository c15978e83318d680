#pragma once

#include "SurfaceGeometry.h"

#include <cstdint>

namespace hop
{

/// The isosurface {F = isovalue} of a mesh, and how exactly points have to lie on it.
struct Isosurface
{
  const ElementMesh* mesh = nullptr;
  double isovalue = 0.0;
  /// Largest distance |F - c|/|grad F| of a particle from the surface, world units.
  double tolerance = 0.0;
  /// MaximumFaces entries an element; nonzero: the surface ends at that face on both sides, as the
  /// field jumps there. nullptr: it ends at no inner face.
  const std::vector<char>* cuts = nullptr;

  /// What lies behind a face, as far as the surface goes on there.
  FaceNeighbor neighbor(int element, int face) const
  {
    const bool cut =
      this->cuts && (*this->cuts)[static_cast<std::size_t>(element) * MaximumFaces + face];
    return cut ? FaceNeighbor() : this->mesh->neighbor(element, face);
  }
};

/// A place that was evaluated.
struct Evaluated
{
  Location location;
  FieldPoint point;
  /// Zero unless asked for.
  glm::dmat3 hessian{ 0.0 };
};

/// Moves points through the mesh and onto the surface. Counts its evaluations. One a thread.
class SurfaceWalker
{
public:
  explicit SurfaceWalker(const Isosurface& surface)
    : Surface(surface)
  {
  }

  /// Value and gradient at a place.
  Evaluated evaluate(const Location& location);

  /// Value, gradient and Hessian at a place.
  Evaluated evaluateCurved(const Location& location);

  /// Follows a world vector from a place, through as many elements as it takes: at each face the
  /// rest of the vector, towards the same world target, is continued with the Jacobian of the next
  /// element. At a boundary the rest slides along it. Within an element the step is first order
  /// in u, so that the place reached lies near the target, not on it. Steps that would need more
  /// than MaximumHops elements end at the last face.
  Location move(const Evaluated& start, const WorldVector& step);

  /// Newton's method u <- u - K F_x F/|F_x|^2 (the paper's eq. 1), across faces, and along the
  /// boundary where the surface leaves the domain.
  /// \param maximumTravel give up when the steps add up to more (world units)
  /// \param result the place on the surface, if the method converged
  /// \return whether |F - c|/|grad F| fell to the tolerance
  /// \param keepWall a start on the boundary stays on it
  bool project(
    const Location& start, double maximumTravel, Evaluated& result, bool keepWall = false);

  std::int64_t evaluations() const { return this->Evaluations; }

  static constexpr int MaximumHops = 8;
  static constexpr int MaximumNewtonSteps = 25;

private:
  WorldVector newtonStep(const Evaluated& at, bool& alongWall) const;

  Isosurface Surface;
  std::int64_t Evaluations = 0;
};

/// How many boundary faces (faces behind which the surface does not go on) of its element a place lies on.
int boundaryFaceCount(const Isosurface& surface, const Location& location);
/// The same for faces without neighbour.
int boundaryFaceCount(const ElementMesh& mesh, const Location& location);

} // namespace hop
