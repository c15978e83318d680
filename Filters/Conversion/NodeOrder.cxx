#include "Conversion/NodeOrder.h"

#include "Conversion/ConvertCells.h"
#include "Elements/Bernstein.h"

#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

namespace hop
{

namespace
{

/// How many cells decide. All chosen by experiment.
struct Sample
{
  /// Folded cells whose nodes are compared with straight cells: in bent cells this may fail.
  static constexpr std::size_t Compared = 4;
  /// Folded cells on which orders are tried. More take longer; fewer may all be odd ones.
  static constexpr std::size_t Tried = 32;
  /// Sound cells of which most have to be displaced. Fewer say little about a mesh.
  static constexpr std::size_t LeastDisplaced = 10;
};

/// Some items, evenly spread over all.
template <class Item>
std::vector<Item> someOf(const std::vector<Item>& all, std::size_t most)
{
  std::vector<Item> some;
  const std::size_t count = std::min(all.size(), most);
  for (std::size_t i = 0; i < count; ++i)
  {
    some.push_back(all[i * all.size() / count]);
  }
  return some;
}

std::vector<int> asInTheMesh(const CellBasis& cell)
{
  std::vector<int> order(cell.basis.nodeCount());
  std::iota(order.begin(), order.end(), 0);
  return order;
}

/// The node at each corner of the domain; a pyramid's apex is all corners of the upper face. Empty where corners have
/// no nodes.
std::vector<int> nodesAtCorners(const CellBasis& cell)
{
  const auto nodeAt = [&](const auto& isThere)
  {
    const auto found = std::find_if(cell.nodes.begin(), cell.nodes.end(), isThere);
    return found == cell.nodes.end() ? -1 : static_cast<int>(found - cell.nodes.begin());
  };
  std::vector<int> nodes;
  for (const ReferencePoint& corner : facts(cell.basis.domain()).corners)
  {
    const int own = nodeAt([&](const ReferencePoint& u) { return u.xyz == corner.xyz; });
    const int apex = nodeAt([](const ReferencePoint& u) { return u.xyz.z == 1.0; });
    nodes.push_back(own < 0 && corner.xyz.z == 1.0 ? apex : own);
  }
  return std::find(nodes.begin(), nodes.end(), -1) == nodes.end() ? nodes : std::vector<int>();
}

bool isSound(JacobianSign sign)
{
  return sign == JacobianSign::Positive || sign == JacobianSign::Negative;
}

/// Finds orders for cells of one kind. Place n of a cell belongs to node order[n] of the mesh. Each thread has its own
/// OrderSearch.
class OrderSearch
{
public:
  using Order = std::vector<int>;

  OrderSearch(const InputBlocks& blocks, const CellBasis& cell)
    : Blocks(blocks)
    , Cell(cell)
    , Corners(nodesAtCorners(cell))
  {
  }

  /// The orders in which some cells are sound; those that mend most of them come first.
  std::vector<Order> ordersFor(const std::vector<BlockCell>& folded);
  /// The first order in which a cell is sound: one of those, or its own; empty if there is none.
  Order find(const BlockCell& where, const std::vector<Order>& orders);
  /// The order in which the nodes of a sound cell are much nearer to their places in the straight-sided cell; empty if
  /// there is none.
  Order straighten(const BlockCell& where);
  JacobianSign sign(const BlockCell& where, const Order& order)
  {
    return signInOrder(this->Blocks, where, this->Cell, order, this->Values);
  }

private:
  std::vector<glm::dvec3> nodesOf(const BlockCell& where);
  Order byPlace(const std::vector<glm::dvec3>& points) const;
  std::vector<glm::dvec3> straight(const std::vector<glm::dvec3>& points) const;
  Order lexicographic(const std::array<int, 3>& axes) const;

  const InputBlocks& Blocks;
  const CellBasis& Cell;
  std::vector<int> Corners;
  CellValues Values;
};

std::vector<OrderSearch::Order> OrderSearch::ordersFor(const std::vector<BlockCell>& folded)
{
  std::set<Order> orders{ this->lexicographic({ 2, 1, 0 }), this->lexicographic({ 0, 1, 2 }) };
  for (const BlockCell& where : someOf(folded, Sample::Compared))
  {
    orders.insert(this->byPlace(this->nodesOf(where)));
  }
  orders.erase(Order());
  orders.erase(asInTheMesh(this->Cell));
  std::vector<std::pair<std::ptrdiff_t, Order>> ranked;
  for (const Order& order : orders)
  {
    const std::ptrdiff_t mended = std::count_if(folded.begin(), folded.end(),
      [&](const BlockCell& where) { return isSound(this->sign(where, order)); });
    if (mended > 0)
    {
      ranked.emplace_back(-mended, order);
    }
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<Order> result;
  result.reserve(ranked.size());
  for (auto& [rank, order] : ranked)
  {
    result.push_back(std::move(order));
  }
  return result;
}

OrderSearch::Order OrderSearch::find(const BlockCell& where, const std::vector<Order>& orders)
{
  const auto known = std::find_if(orders.begin(), orders.end(),
    [&](const Order& order) { return isSound(this->sign(where, order)); });
  if (known != orders.end())
  {
    return *known;
  }
  Order own = this->byPlace(this->nodesOf(where));
  return own.empty() || isSound(this->sign(where, own)) ? own : Order();
}

OrderSearch::Order OrderSearch::straighten(const BlockCell& where)
{
  // Largest sum of the squared distances of nodes from their places, as a fraction of the sum in the order of the mesh.
  // Nodes of bent cells may be nearest to places of others, too, but hardly nearer. Chosen by experiment.
  constexpr double muchNearer = 0.25;
  const std::vector<glm::dvec3> points = this->nodesOf(where);
  Order order = this->byPlace(points);
  if (order.empty() || order == asInTheMesh(this->Cell))
  {
    return {};
  }
  const std::vector<glm::dvec3> places = this->straight(points);
  double before = 0.0;
  double after = 0.0;
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    before += glm::dot(points[n] - places[n], points[n] - places[n]);
    after += glm::dot(points[order[n]] - places[n], points[order[n]] - places[n]);
  }
  return after < muchNearer * before && isSound(this->sign(where, order)) ? order : Order();
}

/// Where the nodes of a cell stand; empty where the cell cannot be read, or its corners have no nodes.
std::vector<glm::dvec3> OrderSearch::nodesOf(const BlockCell& where)
{
  if (this->Corners.empty() ||
    readCell(this->Blocks, where, this->Cell, this->Values) != Verdict::Keep)
  {
    return {};
  }
  std::vector<glm::dvec3> points;
  for (int n = 0; n < this->Cell.basis.nodeCount(); ++n)
  {
    points.emplace_back();
    this->Blocks[where.block].grid->GetPoint(this->Values.ids[n], &points.back().x);
  }
  return points;
}

/// The node that stands nearest to the place of each node in the straight-sided cell with the same corners; empty where
/// a node is the nearest to two places.
std::vector<int> OrderSearch::byPlace(const std::vector<glm::dvec3>& points) const
{
  if (points.empty())
  {
    return {};
  }
  std::vector<int> order;
  std::vector<char> isTaken(points.size(), 0);
  for (const glm::dvec3& place : this->straight(points))
  {
    const auto distance2 = [&](const glm::dvec3& x) { return glm::dot(x - place, x - place); };
    const auto nearest = std::min_element(points.begin(), points.end(),
      [&](const glm::dvec3& a, const glm::dvec3& b) { return distance2(a) < distance2(b); });
    order.push_back(static_cast<int>(nearest - points.begin()));
    if (isTaken[order.back()]++)
    {
      return {};
    }
  }
  return order;
}

/// Where the nodes of a straight-sided cell with the same corners stand.
std::vector<glm::dvec3> OrderSearch::straight(const std::vector<glm::dvec3>& points) const
{
  const Domain domain = this->Cell.basis.domain();
  constexpr Degrees linear{ 1, 1, 1 };
  std::array<double, MaximumCorners> shares{};
  std::vector<glm::dvec3> places;
  for (const ReferencePoint& u : this->Cell.nodes)
  {
    evaluateBasis(domain, linear, u, shares.data());
    glm::dvec3 place(0.0);
    for (int c = 0; c < static_cast<int>(this->Corners.size()); ++c)
    {
      const int i = coefficientIndex(domain, linear, cornerLatticePoint(domain, linear, c));
      place += shares[i] * points[this->Corners[c]];
    }
    places.push_back(place);
  }
  return places;
}

/// The order of a mesh that sorts the nodes by the coordinates of their places.
/// \param axes of the coordinates, the first one decides first
OrderSearch::Order OrderSearch::lexicographic(const std::array<int, 3>& axes) const
{
  // Places that differ by less are equal but for rounding; nodes of the highest degree are 1/15 apart.
  constexpr double roundedTo = 1e-6;
  std::vector<std::array<long, 3>> keys;
  for (const ReferencePoint& u : this->Cell.nodes)
  {
    const auto key = [&](int axis) { return std::lround(u.xyz[axis] / roundedTo); };
    keys.push_back({ key(axes[0]), key(axes[1]), key(axes[2]) });
  }
  std::vector<int> listed(keys.size());
  std::iota(listed.begin(), listed.end(), 0);
  std::sort(listed.begin(), listed.end(), [&](int a, int b) { return keys[a] < keys[b]; });
  Order order(listed.size());
  for (std::size_t n = 0; n < listed.size(); ++n)
  {
    order[listed[n]] = static_cast<int>(n);
  }
  return order;
}

/// What an order changes.
std::string describe(const std::vector<int>& order)
{
  // Longer lists hide the rest of the message: hexahedra of degree 2 have 27 nodes.
  constexpr std::size_t mostListed = 27;
  std::vector<int> moved;
  for (int n = 0; n < static_cast<int>(order.size()); ++n)
  {
    if (order[n] != n)
    {
      moved.push_back(n);
    }
  }
  std::ostringstream text;
  if (moved.size() == 2)
  {
    text << "nodes " << moved[0] << " and " << moved[1] << " exchanged";
  }
  else if (order.size() <= mostListed)
  {
    text << "their nodes in the order";
    for (const int node : order)
    {
      text << " " << node;
    }
  }
  else
  {
    text << moved.size() << " of their " << order.size() << " nodes in other places (first: node "
         << order[moved[0]] << " in the place of " << moved[0] << ")";
  }
  return text.str();
}

/// What mends some cells; empty unless most of them are mended.
/// \param orderFor gives the order that mends a cell, or an empty one
template <class OrderFor>
std::string remedyOf(const std::vector<BlockCell>& cells, const OrderFor& orderFor)
{
  std::size_t mended = 0;
  std::set<std::vector<int>> used;
  for (const BlockCell& where : cells)
  {
    const std::vector<int> order = orderFor(where);
    mended += !order.empty();
    used.insert(order);
  }
  used.erase(std::vector<int>());
  return 2 * mended <= cells.size() ? ""
    : used.size() == 1              ? describe(*used.begin())
                                    : "their nodes in other orders, which differ from cell to cell";
}

/// Finds bad cells of one kind in all blocks.
class BadCells
{
public:
  BadCells(const InputBlocks& blocks, const CellBasis& cell)
    : Blocks(blocks)
    , Cell(cell)
    , Found(blocks.size())
  {
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      // The first look-up changes the grid: no thread may do it.
      this->Ghosts.push_back(blocks[b].grid->GetCellGhostArray());
    }
  }

  /// \param isBad whether a cell is one, by a search of its thread
  template <class IsBad>
  void find(const IsBad& isBad, CellBases& kinds, const ParallelFor& parallelFor);
  /// Whether these are most cells of the kind.
  bool areMost() const { return 2 * this->Count > this->OfKind; }
  /// One ascending list a block.
  std::vector<std::vector<vtkIdType>> take();

private:
  const InputBlocks& Blocks;
  const CellBasis& Cell;
  std::vector<vtkUnsignedCharArray*> Ghosts;
  std::mutex Access;
  std::vector<std::vector<vtkIdType>> Found;
  std::atomic<std::int64_t> OfKind{ 0 };
  std::atomic<std::int64_t> Count{ 0 };
};

template <class IsBad>
void BadCells::find(const IsBad& isBad, CellBases& kinds, const ParallelFor& parallelFor)
{
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Blocks.cellCount()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      BasisLookup bases(kinds);
      OrderSearch search(this->Blocks, this->Cell);
      for (std::ptrdiff_t number = begin; number < end; ++number)
      {
        const BlockCell where = this->Blocks.locate(number);
        if (isGhostCell(this->Ghosts[where.block], where.cell) ||
          bases.basisOf(this->Blocks[where.block].grid, where.cell) != &this->Cell)
        {
          continue;
        }
        ++this->OfKind;
        if (isBad(where, search))
        {
          ++this->Count;
          const std::lock_guard<std::mutex> lock(this->Access);
          this->Found[where.block].push_back(where.cell);
        }
      }
    });
}

std::vector<std::vector<vtkIdType>> BadCells::take()
{
  for (std::vector<vtkIdType>& cells : this->Found)
  {
    std::sort(cells.begin(), cells.end());
  }
  return std::move(this->Found);
}

} // namespace

std::string MisorderedCells::describe() const
{
  if (!this->areFolded)
  {
    return "bent, but much straighter with " + this->remedy;
  }
  return this->remedy.empty() ? "partly inverted, as most cells of the type are"
                              : "partly inverted, but sound with " + this->remedy;
}

MisorderedCells findMisordered(const InputBlocks& blocks, const std::vector<BlockCell>& folded,
  bool areMost, const CellBasis& cell, CellBases& kinds, const ParallelFor& parallelFor)
{
  const std::vector<BlockCell> sample = someOf(folded, Sample::Tried);
  OrderSearch search(blocks, cell);
  const std::vector<std::vector<int>> orders = search.ordersFor(sample);
  MisorderedCells result;
  result.cells.resize(blocks.size());
  result.remedy =
    remedyOf(sample, [&](const BlockCell& where) { return search.find(where, orders); });
  const bool isKnown = !result.remedy.empty();
  if (isKnown || areMost)
  {
    const std::vector<int> own = asInTheMesh(cell);
    BadCells all(blocks, cell);
    all.find(
      [&](const BlockCell& where, OrderSearch& orderSearch)
      {
        return orderSearch.sign(where, own) == JacobianSign::Mixed &&
          (!isKnown || !orderSearch.find(where, orders).empty());
      },
      kinds, parallelFor);
    if (isKnown || all.areMost())
    {
      result.cells = all.take();
    }
  }
  return result;
}

MisorderedCells findDisplaced(const InputBlocks& blocks, const std::vector<BlockCell>& sound,
  const CellBasis& cell, CellBases& kinds, const ParallelFor& parallelFor)
{
  MisorderedCells result;
  result.areFolded = false;
  result.cells.resize(blocks.size());
  if (sound.size() < Sample::LeastDisplaced)
  {
    return result;
  }
  OrderSearch search(blocks, cell);
  const std::string remedy = remedyOf(
    someOf(sound, Sample::Tried), [&](const BlockCell& where) { return search.straighten(where); });
  if (!remedy.empty())
  {
    result.remedy = remedy;
    BadCells all(blocks, cell);
    all.find([](const BlockCell& where, OrderSearch& orderSearch)
      { return !orderSearch.straighten(where).empty(); },
      kinds, parallelFor);
    result.cells = all.take();
  }
  return result;
}

} // namespace hop
