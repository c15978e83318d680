#pragma once

#include "Support/BoxTree.h"
#include "Surface/SurfaceGeometry.h"

#include <optional>

namespace hop
{

/// A place behind a face that the mesh does not join to another.
struct LocatedPlace
{
  Location location;
  /// The face of that element by which one enters it.
  int face = -1;
  /// How far it is from the place asked for, or that one inside the element; world units.
  double gap = 0.0;
};

/// Finds what lies behind faces that the mesh does not join: beside hanging nodes of refined elements,
/// or where triangles meet quadrilaterals. Two such faces may touch if their boxes overlap and they look
/// at each other; where a point of one lies in the element of the other, Newton's method tells.
///
/// Only faces that the isosurface can pass are looked at: their coefficients straddle the isovalue.
class FaceLocator
{
public:
  /// \pre findFaceNeighbors has run; the mesh outlives the locator
  FaceLocator(const ElementMesh& mesh, double isovalue, const ParallelFor& parallelFor);

  /// Whether anything may lie behind a face that has no neighbour.
  bool mayGoOn(int element, int face) const { return this->find(element, face) != nullptr; }

  /// Whether `other` may lie behind a face.
  bool mayGoOnIn(int element, int face, int other) const;

  /// The place behind a face, next to a point of it. Of several elements the one that misses the point
  /// least, and the first of those that meet it to rounding.
  /// \param tolerance largest miss, world units; misses beyond ReachPerFace are never accepted
  /// \param evaluations is increased by the number of evaluations
  std::optional<LocatedPlace> locate(const WorldPoint& point, int element, int face,
    double tolerance, std::int64_t& evaluations) const;

  /// Evaluations that the set-up took.
  std::int64_t evaluations() const { return this->Evaluations; }

  /// Largest miss between two faces, in units of the smaller one's diagonal.
  static constexpr double ReachPerFace = 0.1;

private:
  /// A face without neighbour that the surface can pass.
  struct OpenFace
  {
    int element = -1;
    int face = -1;
    /// Of its control points.
    Bounds bounds;
    /// At its middle, out of the element; zero where the element is singular.
    WorldVector outward;
    /// Numbers of open faces that may touch it.
    std::vector<int> opposite;

    double reach() const { return ReachPerFace * this->bounds.diagonal(); }
  };

  std::vector<OpenFace> openFacesOf(int element, double isovalue) const;
  void findOpposites(const ParallelFor& parallelFor);
  const OpenFace* find(int element, int face) const;
  std::optional<LocatedPlace> locateIn(
    const OpenFace& to, const WorldPoint& point, double tolerance, std::int64_t& evaluations) const;

  const ElementMesh& Mesh;
  /// Those that others may touch, by element and face.
  std::vector<OpenFace> Faces;
  std::int64_t Evaluations = 0;
};

} // namespace hop
