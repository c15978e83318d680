#include "ScatteredMesh.h"

#include "Elements/CornerNumbers.h"

#include <algorithm>
#include <random>

namespace hop::testing
{

std::vector<ElementMesh> scattered(const ElementMesh& whole, int ranks, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<int> order(whole.elements.size());
  for (std::size_t e = 0; e < order.size(); ++e)
  {
    order[e] = static_cast<int>(e);
  }
  std::shuffle(order.begin(), order.end(), random);
  std::vector<ElementMesh> parts(ranks);
  for (const int e : order)
  {
    ElementMesh& part = parts[random() % ranks];
    const BernsteinForm form = whole.form(e);
    Element element = whole.elements[e];
    element.firstCoefficient = part.coefficients.size();
    element.cell = static_cast<std::int64_t>(part.elements.size());
    element.corners = {};
    part.coefficients.insert(part.coefficients.end(), form.coefficients,
      form.coefficients + coefficientCount(form.domain, form.degrees));
    part.elements.push_back(element);
  }
  return parts;
}

GatheredMesh gatheredAt(Exchange& exchange, int worker, ElementMesh& mine)
{
  const std::vector<MeshSize> sizes = gatherFromAll(exchange, sizeOf(mine, CellsOfRank));
  GatheredMesh all = exchange.rank() == worker ? roomFor(sizes) : GatheredMesh();
  gatherMesh(exchange, worker, mine, sizes, all);
  orderCanonically(all, {});
  joinElements(all.mesh);
  return all;
}

GatheredMesh gatheredAlone(ElementMesh mesh)
{
  NoExchange alone;
  return gatheredAt(alone, 0, mesh);
}

} // namespace hop::testing
