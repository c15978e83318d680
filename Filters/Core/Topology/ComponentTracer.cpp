#include "Topology/ComponentTracer.h"

#include <set>

namespace hop
{

void ComponentTracer::prepare(const std::vector<int>& elements)
{
  std::vector<ElementSurface> surfaces =
    findElementSurfaces(this->Mesh, elements, this->Isovalue, this->Parallel);
  for (std::size_t n = 0; n < elements.size(); ++n)
  {
    this->Surfaces.emplace(elements[n], std::make_unique<ElementSurface>(std::move(surfaces[n])));
  }
}

const ElementSurface& ComponentTracer::surfaceOf(int element)
{
  std::unique_ptr<ElementSurface>& surface = this->Surfaces[element];
  if (!surface)
  {
    askCaller(this->Parallel);
    surface = std::make_unique<ElementSurface>(
      findElementSurface(this->Mesh, element, this->Isovalue, this->Tests, this->Parallel));
  }
  return *surface;
}

PieceNumber ComponentTracer::pieceAt(const Location& location)
{
  const ElementSurface& surface = this->surfaceOf(location.element);
  return { location.element, surface.pieceAt(surface.shape.inCube(location.u)) };
}

std::vector<PieceNumber> ComponentTracer::closedComponent(
  const PieceNumber& start, const std::function<bool(const PieceNumber&)>& passes)
{
  const SurfaceOfElement surfaceOf = [this](int element) -> const ElementSurface&
  { return this->surfaceOf(element); };
  std::vector<PieceNumber> pieces{ start };
  std::set<PieceNumber> seen{ start };
  for (std::size_t n = 0; n < pieces.size(); ++n)
  {
    const auto [element, piece] = pieces[n];
    const ElementSurface& surface = this->surfaceOf(element);
    if (!surface.pieces[piece].proven || !passes(pieces[n]))
    {
      return {};
    }
    if (this->Matches.count(element) == 0)
    {
      this->Matches[element] = matchCurves(this->Mesh, this->Isovalue, element, surfaceOf, nullptr);
    }
    const std::vector<CurveMatch>& matches = this->Matches[element];
    for (std::size_t c = 0; c < matches.size(); ++c)
    {
      const CurveMatch& match = matches[c];
      if (surface.curves[c].piece != piece || match.kind == CurveMatch::Collapsed)
      {
        continue;
      }
      if (match.kind != CurveMatch::Joined)
      {
        return {};
      }
      const PieceNumber next{ match.element,
        this->surfaceOf(match.element).curves[match.curve].piece };
      if (seen.insert(next).second)
      {
        pieces.push_back(next);
      }
    }
  }
  return pieces;
}

} // namespace hop
