#include "Surface/SurfacePieces.h"

#include "Support/DisjointSets.h"
#include "Surface/ActiveFaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

/// Calls use(element, face, slot) for every face of every element.
template <class Use>
void forFaces(const ElementMesh& mesh, const Use& use)
{
  for (int element = 0; element < static_cast<int>(mesh.elements.size()); ++element)
  {
    const auto faces = static_cast<int>(facts(mesh.elements[element].domain).faces.size());
    for (int face = 0; face < faces; ++face)
    {
      use(element, face, faceSlot(element, face));
    }
  }
}

/// Whether one face of an element holds two places, and the surface ends there.
template <class Ends>
bool isOnOneFace(const ElementMesh& mesh, const Location& a, const Location& b, const Ends& ends)
{
  constexpr double onFace =
    1e-8; // half-space value: rounding of places that were carried across a face
  if (a.element != b.element)
  {
    return false;
  }
  const auto faces = static_cast<int>(facts(mesh.elements[a.element].domain).faces.size());
  for (int face = 0; face < faces; ++face)
  {
    if (isOnFace(mesh, a, face, onFace) && isOnFace(mesh, b, face, onFace) && ends(a.element, face))
    {
      return true;
    }
  }
  return false;
}

} // namespace

SurfacePieces::SurfacePieces(const ElementMesh& mesh, const std::vector<float>& jumpTolerances)
  : Ends(jumpTolerances.size(), 0)
{
  DisjointSets pieces(mesh.elements.size());
  int unmatched = -1;
  forFaces(mesh,
    [&](int element, int face, std::size_t slot)
    {
      const int behind = mesh.neighbor(element, face).element;
      const float tolerance = jumpTolerances[slot];
      this->Ends[slot] = behind >= 0 && std::isfinite(tolerance);
      if (behind >= 0 && !this->Ends[slot])
      {
        pieces.unite(element, behind);
      }
      else if (behind < 0 && std::isfinite(tolerance) && tolerance > 0.0f)
      {
        unmatched = unmatched < 0 ? element : unmatched;
        pieces.unite(element, unmatched);
      }
    });
  this->OfElement.resize(mesh.elements.size());
  for (int element = 0; element < static_cast<int>(mesh.elements.size()); ++element)
  {
    this->OfElement[element] = pieces.root(element);
  }
}

bool SurfacePieces::endBetween(const ElementMesh& mesh, int element, int other) const
{
  const auto endsAt = [&](int here, int there)
  {
    const auto faces = static_cast<int>(facts(mesh.elements[here].domain).faces.size());
    for (int face = 0; face < faces; ++face)
    {
      if (mesh.neighbor(here, face).element == there && this->Ends[faceSlot(here, face)] != 0)
      {
        return true;
      }
    }
    return false;
  };
  return !this->areOne() && (endsAt(element, other) || endsAt(other, element));
}

bool SurfacePieces::areOnEnd(const ElementMesh& mesh, const Location& a, const Location& b) const
{
  if (this->areOne() || !this->areSame(a, b))
  {
    return false;
  }
  const auto ends = [&](int element, int face)
  { return this->Ends[faceSlot(element, face)] != 0 || mesh.neighbor(element, face).element < 0; };
  // On an edge of the mesh a place is in several elements of the piece.
  const auto isWithOther = [&](const Location& here, const Location& there)
  {
    const auto faces = static_cast<int>(facts(mesh.elements[there.element].domain).faces.size());
    for (int face = 0; face < faces; ++face)
    {
      if (isOnFace(mesh, there, face) && !ends(there.element, face) &&
        isOnOneFace(mesh, here, crossFace(mesh, there, face), ends))
      {
        return true;
      }
    }
    return false;
  };
  return isOnOneFace(mesh, a, b, ends) || isWithOther(a, b) || isWithOther(b, a);
}

std::vector<float> SurfacePieces::jumpTolerances() const
{
  std::vector<float> tolerances(this->Ends.size());
  std::transform(this->Ends.begin(), this->Ends.end(), tolerances.begin(),
    [](char ends) { return ends != 0 ? 0.0f : std::numeric_limits<float>::infinity(); });
  return tolerances;
}

} // namespace hop
