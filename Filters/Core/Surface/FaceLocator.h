#pragma once

#include "Support/BoxTree.h"
#include "Surface/SurfaceGeometry.h"

#include <optional>

namespace hop
{

/// A place behind a face that the mesh does not join to another face.
struct LocatedPlace
{
  Location location;
  /// The face of the located element by which one enters it.
  int face = -1;
  /// Gap between the two faces there, or how deep they overlap; world units.
  double gap = 0.0;
};

/// Finds what lies behind faces that the mesh does not join: beside hanging nodes of refined elements,
/// or where triangles meet quadrilaterals. Two unmatched faces are opposite to each other if their bounding boxes,
/// widened by the largest gap, overlap and their outward normals point against each other, nearly at their middles and
/// closely at the place itself. Newton's method finds the place in the opposite face's element
/// (Documentation/algorithm.md, section Walking on the surface).
///
/// Only faces that the isosurface can pass are searched: their coefficients straddle the isovalue.
class FaceLocator
{
public:
  /// \pre findFaceNeighbors has run; the mesh outlives the locator
  FaceLocator(const ElementMesh& mesh, double isovalue, const ParallelFor& parallelFor);

  /// Whether another element may lie behind a face that has no neighbour.
  bool mayContinue(int element, int face) const { return this->find(element, face) != nullptr; }

  /// Whether the surface may meet a face that has no neighbour: the coefficients of the field on the face lie on both
  /// sides of the isovalue. A surface that runs along a face without meeting it, however near, does not end there.
  bool mayMeet(int element, int face) const { return this->Met[faceSlot(element, face)] != 0; }

  /// Whether the element `other` may lie behind a face that has no neighbour.
  bool mayContinueIn(int element, int face, int other) const;

  /// The faces, as faceSlot(), of elements that may lie behind a face that has no neighbour.
  std::vector<std::size_t> slotsBehind(int element, int face) const;

  /// The place behind a face that is nearest to a point of the face. Of several elements the one with the smallest gap
  /// is chosen, or the first whose gap is zero to rounding.
  /// \param point with the Jacobian of the face's element
  /// \param tolerance largest gap, world units; gaps beyond LargestGapPerDiagonal are never accepted
  /// \param evaluations is increased by the number of evaluations
  std::optional<LocatedPlace> locate(const LocalMap& point, int element, int face, double tolerance,
    std::int64_t& evaluations) const;

  /// Number of evaluations that the constructor made.
  std::int64_t evaluations() const { return this->Evaluations; }

  /// Largest gap between two faces, in units of the smaller one's diagonal; chosen by experiment. Larger: what lies
  /// behind thin plates may be taken for a neighbour; smaller: the surface ends where curved faces of different
  /// elements approximate each other badly.
  static constexpr double LargestGapPerDiagonal = 0.1;

private:
  /// A face without neighbour that the surface can pass.
  struct OpenFace
  {
    int element = -1;
    int face = -1;
    /// Bounds of the face's control points.
    Bounds bounds;
    /// Unit normal at the face's middle, out of the element; zero where the element is singular.
    WorldVector outward;
    /// Indices in Faces of the faces opposite to it.
    std::vector<int> opposite;

    double reach() const { return LargestGapPerDiagonal * this->bounds.diagonal(); }
  };

  std::vector<OpenFace> openFacesOf(int element, double isovalue);
  void findOpposites(const ParallelFor& parallelFor);
  const OpenFace* find(int element, int face) const;
  std::optional<LocatedPlace> locateIn(const OpenFace& to, const WorldPoint& point,
    const WorldVector& inward, double tolerance, std::int64_t& evaluations) const;

  const ElementMesh& Mesh;
  /// Open faces to which others are opposite, sorted by element and face.
  std::vector<OpenFace> Faces;
  /// MaximumFaces entries an element, see mayMeet().
  std::vector<char> Met;
  std::int64_t Evaluations = 0;
};

} // namespace hop
