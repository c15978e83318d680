#include "Edges/BoundaryFinisher.h"

#include "Edges/CellBorders.h"
#include "Edges/FacePlanes.h"
#include "Surface/ActiveFaces.h"

namespace hop
{

namespace
{

/// Unit vector along the surface that leaves the element by a face; zero where the surface is parallel to the face.
WorldVector outwardAt(const ElementMesh& mesh, const Evaluated& at, int face)
{
  const glm::dvec3 normal = surfaceNormal(at.point.gradient).xyz;
  const glm::dvec3 inward =
    glm::transpose(at.point.map.inverse) * mesh.face(at.location.element, face).inward.xyz;
  const glm::dvec3 along = inward - glm::dot(inward, normal) * normal;
  return { glm::length(along) > 0.0 ? -glm::normalize(along) : glm::dvec3(0.0) };
}

/// The surface as it would be if it passed every jump.
Isosurface seamless(Isosurface surface)
{
  surface.jumpTolerances = nullptr;
  return surface;
}

} // namespace

BoundaryFinisher::BoundaryFinisher(const Isosurface& surface, const FaceJumps& jumps,
  const SurfaceProxy& proxy, const SizingFunction& sizing)
  : Surface(surface)
  , Jumps(jumps)
  , Proxy(proxy)
  , Sizing(sizing)
  , Exact(surface, BoundaryTracer::Points::Exact)
  , Passer(seamless(surface))
{
}

PlaceKind BoundaryFinisher::finish(const BoundaryPlace& place, BoundaryParticle& result)
{
  const auto point = this->Exact.project(place.location, place.face, place.spacing);
  const auto beyond = point ? this->lookBehind(*point) : std::nullopt;
  if (point && !beyond)
  {
    return PlaceKind::Inside;
  }
  Anchor anchor;
  if (!point || !anchorPatch(point->at, anchor, result.patch))
  {
    return PlaceKind::Lost;
  }
  const FieldPoint& field = point->at.point;
  result.patch.spacing =
    this->Proxy.spacingAt(result.patch.position, result.patch.curvatureMagnitude());
  result.patch.fixed = true;
  const bool isUniform = this->Sizing.angularDensity == 0.0 && this->Proxy.spacingPlaces() == 0;
  result.particle =
    particleAt(point->at.location, field, curvature(field.gradient, point->at.hessian),
      isUniform ? this->Sizing.spacing : result.patch.spacing);
  result.particle.jump = beyond->jump;
  const Jet& jet = this->Exact.jetAt(*point);
  offerFaces(this->Surface, this->Jumps, jet, field, result.particle);
  markCellBorders(*this->Surface.mesh, jet, field.map, result.particle);
  result.side = this->sideAt(point->face, point->at, jet);
  result.otherSide = this->sideAt(beyond->otherFace, point->at, jet);
  if (this->Surface.isCutAt(point->at.location.element, point->face))
  {
    result.side = result.otherSide;
    result.otherSide = {};
  }
  return PlaceKind::OnCurve;
}

/// How the surface ends at a face; nothing for no face, and where the surface lies in the face.
BoundarySide BoundaryFinisher::sideAt(int face, const Evaluated& at, const Jet& jet) const
{
  if (face < 0 || !this->Exact.crosses({ at, face }))
  {
    return {};
  }
  const WorldVector outward = outwardAt(*this->Surface.mesh, at, face);
  const LevelSet field{ at.point.gradient, at.hessian };
  const LevelSet margin =
    faceLevels(jet, at.point.map, this->Surface.mesh->face(at.location.element, face));
  return { face, outward, dot(curvatureOfCrossing(field, margin), outward) };
}

/// Looks behind all boundary faces on which a point lies.
/// \return nothing where the surface goes on behind the point's own face
std::optional<BoundaryFinisher::Beyond> BoundaryFinisher::lookBehind(const BoundaryPoint& point)
{
  const Location& location = point.at.location;
  const ElementMesh& mesh = *this->Surface.mesh;
  const auto& faces = facts(mesh.elements[location.element].domain).faces;
  Beyond result;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    if (faceMargin(faces[f], location.u) >= OnFace || !this->Surface.mayEnd(location.element, f))
    {
      continue;
    }
    const auto behind = this->Passer.behind(point.at, f);
    const bool isCut = this->Surface.isCutAt(location.element, f);
    result.jump = behind && !isCut ? behind->at.point.value : result.jump;
    result.otherFace = behind || f == point.face ? result.otherFace : f;
    if (!behind || f != point.face)
    {
      continue;
    }
    // What is found behind a face that the mesh does not join may lie too far off to count.
    const bool joined = mesh.neighbor(location.element, f).element >= 0;
    if (joined ? SurfaceWalker::continuesIn(this->Surface, point.at, f, *behind)
               : !this->Exact.isOnBoundary(point))
    {
      return std::nullopt;
    }
  }
  return result;
}

} // namespace hop
