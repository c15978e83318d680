#include "Elements/GatheredMesh.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace hop
{

namespace
{

/// Entries of the meshes of all ranks before a rank's own, or of all.
MeshSize sumOf(const std::vector<MeshSize>& sizes, std::size_t count)
{
  MeshSize sum;
  for (std::size_t r = 0; r < count; ++r)
  {
    sum.elements += sizes[r].elements;
    sum.coefficients += sizes[r].coefficients;
    sum.weights += sizes[r].weights;
    sum.exactFields += sizes[r].exactFields;
    sum.exactCoefficients += sizes[r].exactCoefficients;
    sum.cells += sizes[r].cells;
  }
  return sum;
}

/// Copies an array here, or receives it.
template <class T>
void take(Exchange& exchange, const std::vector<T>& mine, T* room, std::int64_t count, int from)
{
  if (from == exchange.rank())
  {
    std::copy(mine.begin(), mine.end(), room);
  }
  else
  {
    receiveArray(exchange, room, static_cast<std::size_t>(count), from);
  }
}

/// Takes the mesh of a rank into its part of the room.
void takeMesh(Exchange& exchange, const ElementMesh& mine, const std::vector<MeshSize>& sizes,
  int from, GatheredMesh& all)
{
  const MeshSize before = sumOf(sizes, from);
  const MeshSize& size = sizes[from];
  Element* elements = all.mesh.elements.data() + before.elements;
  take(exchange, mine.elements, elements, size.elements, from);
  take(exchange, mine.coefficients, all.mesh.coefficients.data() + before.coefficients,
    size.coefficients, from);
  // Where any rank has weights there is room for a weight of every coefficient.
  take(exchange, mine.weights,
    all.mesh.weights.data() + (size.weights > 0 ? before.coefficients : 0), size.weights, from);
  ExactField* fields = all.mesh.exactFields.data() + before.exactFields;
  take(exchange, mine.exactFields, fields, size.exactFields, from);
  take(exchange, mine.exactCoefficients,
    all.mesh.exactCoefficients.data() + before.exactCoefficients, size.exactCoefficients, from);
  for (std::int64_t f = 0; f < size.exactFields; ++f)
  {
    fields[f].firstCoefficient += static_cast<std::size_t>(before.exactCoefficients);
  }
  for (std::int64_t e = 0; e < size.elements; ++e)
  {
    elements[e].exactField += elements[e].exactField < 0 ? 0 : static_cast<int>(before.exactFields);
    elements[e].firstCoefficient += static_cast<std::size_t>(before.coefficients);
    elements[e].cell += before.cells;
    all.homes[before.elements + e] = { from, static_cast<int>(e) };
  }
}

} // namespace

GatheredMesh roomFor(const std::vector<MeshSize>& sizes)
{
  GatheredMesh all;
  const MeshSize sum = sumOf(sizes, sizes.size());
  if (sum.elements > std::numeric_limits<int>::max())
  {
    throw std::length_error("too many cells at the surface");
  }
  all.homes.resize(sum.elements);
  all.mesh.elements.resize(sum.elements);
  if (sizes.size() > 1)
  {
    all.mesh.coefficients.resize(sum.coefficients);
    all.mesh.weights.resize(sum.weights > 0 ? sum.coefficients : 0);
    all.mesh.exactFields.resize(sum.exactFields);
    all.mesh.exactCoefficients.resize(sum.exactCoefficients);
  }
  return all;
}

void gatherMesh(Exchange& exchange, int worker, ElementMesh& mine,
  const std::vector<MeshSize>& sizes, GatheredMesh& all)
{
  if (exchange.isAlone())
  {
    all.mesh.coefficients = std::move(mine.coefficients);
    all.mesh.weights = std::move(mine.weights);
    all.mesh.exactFields = std::move(mine.exactFields);
    all.mesh.exactCoefficients = std::move(mine.exactCoefficients);
    all.mesh.elements = mine.elements;
    for (std::size_t e = 0; e < all.homes.size(); ++e)
    {
      all.homes[e] = { 0, static_cast<int>(e) };
    }
  }
  else if (exchange.rank() == worker)
  {
    for (int from = 0; from < exchange.size(); ++from)
    {
      takeMesh(exchange, mine, sizes, from, all);
    }
  }
  else
  {
    sendArray(exchange, mine.elements.data(), mine.elements.size(), worker);
    sendArray(exchange, mine.coefficients.data(), mine.coefficients.size(), worker);
    sendArray(exchange, mine.weights.data(), mine.weights.size(), worker);
    sendArray(exchange, mine.exactFields.data(), mine.exactFields.size(), worker);
    sendArray(exchange, mine.exactCoefficients.data(), mine.exactCoefficients.size(), worker);
  }
}

void gatherElements(Exchange& exchange, int worker, ElementMesh& part,
  const std::vector<ElementHome>& homes, const std::vector<MeshSize>& sizes, GatheredMesh& all)
{
  gatherMesh(exchange, worker, part, sizes, all);
  if (exchange.rank() != worker)
  {
    sendArray(exchange, homes.data(), homes.size(), worker);
    return;
  }
  for (int from = 0; from < exchange.size(); ++from)
  {
    take(
      exchange, homes, all.homes.data() + sumOf(sizes, from).elements, sizes[from].elements, from);
  }
}

ElementMesh pickElements(const ElementMesh& mesh, const std::vector<int>& chosen)
{
  ElementMesh picked;
  for (const int e : chosen)
  {
    const BernsteinForm form = mesh.form(e);
    const auto count = static_cast<std::ptrdiff_t>(coefficientCount(form.domain, form.degrees));
    Element element = mesh.elements[e];
    element.firstCoefficient = picked.coefficients.size();
    if (element.exactField >= 0)
    {
      ExactField field = mesh.exactFields[element.exactField];
      const auto first =
        mesh.exactCoefficients.begin() + static_cast<std::ptrdiff_t>(field.firstCoefficient);
      element.exactField = static_cast<int>(picked.exactFields.size());
      field.firstCoefficient = picked.exactCoefficients.size();
      picked.exactFields.push_back(field);
      picked.exactCoefficients.insert(picked.exactCoefficients.end(), first,
        first + static_cast<std::ptrdiff_t>(coefficientCount(element.domain, field)));
    }
    picked.elements.push_back(element);
    picked.coefficients.insert(
      picked.coefficients.end(), form.coefficients, form.coefficients + count);
    if (!mesh.weights.empty())
    {
      const auto first =
        mesh.weights.begin() + static_cast<std::ptrdiff_t>(mesh.elements[e].firstCoefficient);
      picked.weights.insert(picked.weights.end(), first, first + count);
    }
  }
  return picked;
}

void orderCanonically(GatheredMesh& all, const ParallelFor& parallelFor)
{
  const std::vector<int> order = canonicalOrder(all.mesh, parallelFor);
  std::vector<Element> elements(order.size());
  std::vector<ElementHome> homes(order.size());
  forAll(parallelFor, order.size(),
    [&](std::size_t i)
    {
      elements[i] = all.mesh.elements[order[i]];
      homes[i] = all.homes[order[i]];
    });
  all.mesh.elements = std::move(elements);
  all.homes = std::move(homes);
}

} // namespace hop
