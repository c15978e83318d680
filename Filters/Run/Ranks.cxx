#include "Run/Ranks.h"

#include "Surface/SpacingSearch.h"

#include "vtkBoundingBox.h"
#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace hop
{

namespace
{

/// The controller of all ranks, or none where there is only one rank.
vtkMultiProcessController* controllerOfRanks()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

/// Gathers one number a surface from every rank: one list a surface, in the order of ranks. From these lists all ranks
/// compute the same sums to the last bit, which MPI's own sums do not promise.
std::vector<std::vector<double>> gather(const std::vector<double>& local)
{
  vtkMultiProcessController* controller = controllerOfRanks();
  const std::size_t ranks = controller ? controller->GetNumberOfProcesses() : 1;
  std::vector<double> received(local);
  if (controller)
  {
    received.resize(ranks * local.size());
    controller->AllGather(local.data(), received.data(), static_cast<vtkIdType>(local.size()));
  }
  std::vector<std::vector<double>> lists(local.size());
  for (std::size_t n = 0; n < received.size(); ++n)
  {
    lists[n % local.size()].push_back(received[n]);
  }
  return lists;
}

double sum(const std::vector<double>& numbers)
{
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

/// Splits a number into whole numbers in the ratio of the weights, by largest remainders; all are zero if no weight is
/// positive.
std::vector<std::int64_t> split(std::int64_t number, const std::vector<double>& weights)
{
  const double all = sum(weights);
  std::vector<std::int64_t> parts(weights.size(), 0);
  if (!(all > 0.0))
  {
    return parts;
  }
  std::vector<double> remainders;
  for (std::size_t r = 0; r < weights.size(); ++r)
  {
    const double exact = static_cast<double>(number) * (weights[r] / all);
    parts[r] = static_cast<std::int64_t>(exact);
    remainders.push_back(exact - static_cast<double>(parts[r]));
  }
  std::vector<std::size_t> order(weights.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return remainders[a] > remainders[b]; });
  std::int64_t missing = number - std::accumulate(parts.begin(), parts.end(), std::int64_t(0));
  for (auto r = order.begin(); r != order.end() && missing > 0; ++r, --missing)
  {
    ++parts[*r];
  }
  return parts;
}

/// One isosurface on its way to the spacing at which all ranks together want as many particles as asked for.
struct CommonSpacing
{
  hop::SpacingSearch search;
  /// Wanted at that spacing.
  SurfaceCount here;
  std::vector<double> ofRanks;
};

void gatherWanted(std::vector<CommonSpacing>& surfaces, const CountAt& wanted)
{
  std::vector<double> owned;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    if (!surfaces[i].search.isOver())
    {
      surfaces[i].here = wanted(i, surfaces[i].search.spacing());
    }
    owned.push_back(surfaces[i].here.owned);
  }
  std::vector<std::vector<double>> lists = gather(owned);
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    surfaces[i].ofRanks = std::move(lists[i]);
  }
}

/// Whether to go on follows from what was gathered: all ranks come to the same end.
std::vector<CommonSpacing> findSpacings(
  std::int64_t number, std::size_t surfaces, double firstSpacing, const CountAt& wanted)
{
  std::vector<CommonSpacing> found(surfaces, { { number, firstSpacing }, {}, {} });
  const auto isOver = [](const CommonSpacing& surface) { return surface.search.isOver(); };
  do
  {
    gatherWanted(found, wanted);
    for (CommonSpacing& surface : found)
    {
      surface.search.update(sum(surface.ofRanks));
    }
  } while (!std::all_of(found.begin(), found.end(), isOver));
  return found;
}

} // namespace

vtkBoundingBox overAllRanks(const vtkBoundingBox& local)
{
  vtkMultiProcessController* controller = controllerOfRanks();
  if (!controller)
  {
    return local;
  }
  double lower[3], upper[3], globalLower[3], globalUpper[3];
  local.GetMinPoint(lower);
  local.GetMaxPoint(upper);
  controller->AllReduce(lower, globalLower, 3, vtkCommunicator::MIN_OP);
  controller->AllReduce(upper, globalUpper, 3, vtkCommunicator::MAX_OP);
  return vtkBoundingBox(
    globalLower[0], globalUpper[0], globalLower[1], globalUpper[1], globalLower[2], globalUpper[2]);
}

bool isOneOfRanks()
{
  return controllerOfRanks() != nullptr;
}

bool isFirstOfRanks()
{
  vtkMultiProcessController* controller = controllerOfRanks();
  return !controller || controller->GetLocalProcessId() == 0;
}

std::size_t largestOfRanks(std::size_t local)
{
  const std::vector<double> all = gather({ static_cast<double>(local) })[0];
  return static_cast<std::size_t>(*std::max_element(all.begin(), all.end()));
}

double sumOfRanks(double local)
{
  return sum(gather({ local })[0]);
}

std::vector<RankShare> shareOutToRanks(
  std::int64_t number, std::size_t surfaces, double firstSpacing, const CountAt& wanted)
{
  vtkMultiProcessController* controller = controllerOfRanks();
  const std::vector<CommonSpacing> found = findSpacings(number, surfaces, firstSpacing, wanted);
  std::vector<RankShare> shares;
  for (const CommonSpacing& surface : found)
  {
    const double all = sum(surface.ofRanks);
    const double perWanted = all > 0.0 ? static_cast<double>(number) / all : 0.0;
    const std::int64_t owned =
      split(number, surface.ofRanks)[controller ? controller->GetLocalProcessId() : 0];
    shares.push_back(
      { owned + std::llround(perWanted * surface.here.ghosts), surface.search.spacing() });
  }
  return shares;
}

} // namespace hop
