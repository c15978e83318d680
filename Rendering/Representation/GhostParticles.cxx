#include "GhostParticles.h"

#include "SplatInput.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace hop
{
namespace
{
// Factor on the radii of disks within which ranks see each other's. A splat bends as the particles within 1.5 radii do,
// see FitShapes.cxx: between disks of one radius that touch, 3.5 radii are looked at of the 4 that 2 stands for.
constexpr double Reach = 2.;

constexpr int Tag = 7310; // of messages between ranks; any number does that no other message has

// Largest number of a locator's buckets along an axis. More take more memory, up to 100^3 buckets; fewer hold more
// points each, among which the search is slower.
constexpr double FinestDivisions = 100.;

bool Touch(const double* disk, const double* other)
{
  const double reach = disk[3] + other[3];
  return vtkMath::Distance2BetweenPoints(disk, other) <= reach * reach;
}

// The box around all disks; not valid where there are none.
vtkBoundingBox BoxOf(vtkDoubleArray* disks)
{
  vtkBoundingBox box;
  for (vtkIdType i = 0; i < disks->GetNumberOfTuples(); ++i)
  {
    const double* disk = disks->GetPointer(4 * i);
    if (disk[3] > 0.)
    {
      box.AddBox(vtkBoundingBox(disk[0] - disk[3], disk[0] + disk[3], disk[1] - disk[3],
        disk[1] + disk[3], disk[2] - disk[3], disk[2] + disk[3]));
    }
  }
  return box;
}

std::vector<vtkBoundingBox> BoxesOfRanks(
  const vtkBoundingBox& mine, vtkMultiProcessController* controller)
{
  double bounds[6];
  mine.GetBounds(bounds);
  std::vector<double> all(6 * controller->GetNumberOfProcesses());
  controller->AllGather(bounds, all.data(), 6);
  std::vector<vtkBoundingBox> boxes;
  for (std::size_t i = 0; i < all.size(); i += 6)
  {
    vtkBoundingBox& box = boxes.emplace_back();
    if (all[i] <= all[i + 1])
    {
      box.SetBounds(&all[i]);
    }
  }
  return boxes;
}

// The particles whose disks reach a box.
std::vector<vtkIdType> ParticlesAt(vtkDoubleArray* disks, const vtkBoundingBox& box)
{
  std::vector<vtkIdType> found;
  for (vtkIdType i = 0; i < disks->GetNumberOfTuples(); ++i)
  {
    const double* disk = disks->GetPointer(4 * i);
    vtkBoundingBox around = box;
    around.Inflate(disk[3]);
    if (disk[3] > 0. && around.ContainsPoint(disk))
    {
      found.push_back(i);
    }
  }
  return found;
}

vtkSmartPointer<vtkDoubleArray> DisksOf(vtkDoubleArray* disks, const std::vector<vtkIdType>& ids)
{
  auto some = vtkSmartPointer<vtkDoubleArray>::New();
  some->SetNumberOfComponents(4);
  some->SetNumberOfTuples(static_cast<vtkIdType>(ids.size()));
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    std::copy_n(disks->GetPointer(4 * ids[i]), 4, some->GetPointer(4 * i));
  }
  return some;
}

// Finds which of some disks reach others.
class Finder
{
public:
  Finder(vtkDoubleArray* disks, const std::vector<vtkIdType>& ids)
    : Disks(disks)
    , Ids(ids)
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const vtkIdType id : ids)
    {
      const double* disk = disks->GetPointer(4 * id);
      points->InsertNextPoint(disk);
      this->LargestRadius = std::max(this->LargestRadius, disk[3]);
    }
    this->Points->SetPoints(points);
    if (ids.empty())
    {
      return;
    }
    // VTK's own choice of buckets is for points that fill a volume; with it each bucket of a surface would hold hundreds.
    const double* bounds = this->Points->GetBounds();
    int divisions[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double length = bounds[2 * axis + 1] - bounds[2 * axis];
      divisions[axis] =
        static_cast<int>(std::clamp(length / (2. * this->LargestRadius), 1., FinestDivisions));
    }
    this->Locator->SetDataSet(this->Points);
    this->Locator->AutomaticOff();
    this->Locator->SetDivisions(divisions);
    this->Locator->BuildLocator();
  }

  // Those that reach one of the others, ascending.
  std::vector<vtkIdType> FindTouching(vtkDoubleArray* others)
  {
    std::vector<vtkIdType> found;
    vtkNew<vtkIdList> near;
    for (vtkIdType i = 0; i < others->GetNumberOfTuples() && !this->Ids.empty(); ++i)
    {
      const double* other = others->GetPointer(4 * i);
      this->Locator->FindPointsWithinRadius(this->LargestRadius + other[3], other, near);
      for (const vtkIdType index : *near)
      {
        if (Touch(this->Disks->GetPointer(4 * this->Ids[index]), other))
        {
          found.push_back(this->Ids[index]);
        }
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

private:
  vtkDoubleArray* Disks;
  const std::vector<vtkIdType>& Ids;
  double LargestRadius = 0.;
  vtkNew<vtkPolyData> Points;
  vtkNew<vtkStaticPointLocator> Locator;
};

// The vertex cell of each point, or -1.
std::vector<vtkIdType> VertexCells(vtkPolyData* particles)
{
  std::vector<vtkIdType> cells(particles->GetNumberOfPoints(), -1);
  vtkIdType size = 0;
  const vtkIdType* points = nullptr;
  for (vtkIdType cell = 0; cell < particles->GetNumberOfVerts(); ++cell)
  {
    particles->GetVerts()->GetCellAtId(cell, size, points);
    std::for_each(points, points + size, [&](vtkIdType point) { cells[point] = cell; });
  }
  return cells;
}

// Some points, with their arrays and those of their vertex cells.
vtkSmartPointer<vtkPolyData> Extract(vtkPolyData* particles, const std::vector<vtkIdType>& ids)
{
  const auto count = static_cast<vtkIdType>(ids.size());
  const std::vector<vtkIdType> cells = VertexCells(particles);
  vtkNew<vtkIdList> from;
  vtkNew<vtkIdList> fromCells;
  vtkNew<vtkIdList> to;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->InsertNextPoint(particles->GetPoint(ids[i]));
    from->InsertNextId(ids[i]);
    fromCells->InsertNextId(cells[ids[i]]);
    to->InsertNextId(i);
  }
  auto some = vtkSmartPointer<vtkPolyData>::New();
  some->SetPoints(points);
  some->GetPointData()->CopyAllOn();
  some->GetPointData()->CopyAllocate(particles->GetPointData(), count);
  some->GetPointData()->CopyData(particles->GetPointData(), from, to);
  if (particles->GetNumberOfVerts() > 0)
  {
    // Data of cells would not be sent without cells.
    vtkNew<vtkCellArray> vertices;
    for (vtkIdType i = 0; i < count; ++i)
    {
      vertices->InsertNextCell(1, &i);
    }
    some->SetVerts(vertices);
    some->GetCellData()->CopyAllOn();
    some->GetCellData()->CopyAllocate(particles->GetCellData(), count);
    some->GetCellData()->CopyData(particles->GetCellData(), fromCells, to);
  }
  return some;
}

// A value for ghosts whose rank lacks an array: no number, or 0 where every value is a number.
void FillUnknown(vtkAbstractArray* array, vtkIdType begin, vtkIdType end)
{
  auto* numbers = vtkDataArray::SafeDownCast(array);
  const bool real =
    numbers && (numbers->GetDataType() == VTK_DOUBLE || numbers->GetDataType() == VTK_FLOAT);
  for (vtkIdType i = begin; i < end && numbers; ++i)
  {
    for (int c = 0; c < numbers->GetNumberOfComponents(); ++c)
    {
      numbers->SetComponent(i, c, real ? std::numeric_limits<double>::quiet_NaN() : 0.);
    }
  }
}

// The first `count` tuples of some data, and behind them all tuples of others. Arrays are the first one's.
void Join(vtkDataSetAttributes* own, vtkIdType count,
  const std::vector<vtkDataSetAttributes*>& others, const std::vector<vtkIdType>& counts,
  vtkDataSetAttributes* joined)
{
  const vtkIdType all = std::accumulate(counts.begin(), counts.end(), count);
  joined->CopyAllOn();
  joined->CopyAllocate(own, all);
  joined->SetNumberOfTuples(all);
  for (int a = 0; a < joined->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* array = joined->GetAbstractArray(a);
    array->InsertTuples(0, count, 0, own->GetAbstractArray(a));
    vtkIdType next = count;
    for (std::size_t i = 0; i < others.size(); ++i)
    {
      vtkAbstractArray* source =
        array->GetName() ? others[i]->GetAbstractArray(array->GetName()) : nullptr;
      const bool same = source && source->GetDataType() == array->GetDataType() &&
        source->GetNumberOfComponents() == array->GetNumberOfComponents();
      if (same)
      {
        array->InsertTuples(next, counts[i], 0, source);
      }
      else
      {
        FillUnknown(array, next, next + counts[i]);
      }
      next += counts[i];
    }
  }
}

// Sends something to another rank and receives the same kind of thing; of two ranks one sends first.
template <class Data>
vtkSmartPointer<Data> Trade(
  Data* mine, int other, bool sendsFirst, vtkMultiProcessController* controller)
{
  auto theirs = vtkSmartPointer<Data>::New();
  for (const bool sends : { sendsFirst, !sendsFirst })
  {
    if (sends)
    {
      controller->Send(mine, other, Tag);
    }
    else
    {
      controller->Receive(theirs.Get(), other, Tag);
    }
  }
  return theirs;
}

// The ghosts that one other rank has for this one; it gets those that this rank has for it.
vtkSmartPointer<vtkPolyData> TradeGhosts(vtkPolyData* own, vtkDoubleArray* disks,
  const vtkBoundingBox& theirBox, int other, vtkMultiProcessController* controller)
{
  const bool first = controller->GetLocalProcessId() < other;
  const std::vector<vtkIdType> atBox = ParticlesAt(disks, theirBox);
  const auto theirs = Trade<vtkDoubleArray>(DisksOf(disks, atBox), other, first, controller);
  const auto wanted = Extract(own, Finder(disks, atBox).FindTouching(theirs));
  return Trade<vtkPolyData>(wanted, other, first, controller);
}

// Marks particles as ghosts or not, and with the rank that has them. Particles that are marked already are hidden.
void Mark(vtkPolyData* particles, unsigned char type, int rank)
{
  const vtkIdType count = particles->GetNumberOfPoints();
  vtkNew<vtkUnsignedCharArray> types;
  types->SetName(vtkDataSetAttributes::GhostArrayName());
  types->SetNumberOfValues(count);
  constexpr unsigned char Hidden = vtkDataSetAttributes::HIDDENPOINT;
  vtkDataArray* before = particles->GetPointData()->GetArray(types->GetName());
  for (vtkIdType i = 0; i < count; ++i)
  {
    const bool marked = before && before->GetComponent(i, 0) != 0.;
    types->SetValue(i, marked ? Hidden : type);
  }
  vtkNew<vtkUnsignedIntArray> ranks; // the type that selections read
  ranks->SetName(GhostParticles::RankName);
  ranks->SetNumberOfValues(count);
  ranks->FillValue(static_cast<unsigned int>(rank));
  particles->GetPointData()->AddArray(types);
  particles->GetPointData()->AddArray(ranks);
}

// A rank's own particles, marked as no ghosts, with their numbers on the rank, by which selections name them.
vtkSmartPointer<vtkPolyData> MarkOwn(vtkPolyData* own, int rank)
{
  auto marked = vtkSmartPointer<vtkPolyData>::New();
  marked->ShallowCopy(own);
  Mark(marked, 0, rank);
  SplatInput::EnsureIds(marked);
  return marked;
}

// The disks without those of hidden particles, enlarged so that splats that touch have what shapes them.
vtkSmartPointer<vtkDoubleArray> ReachOf(vtkPolyData* particles, vtkDoubleArray* disks)
{
  vtkDataArray* types = particles->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  auto reach = vtkSmartPointer<vtkDoubleArray>::New();
  reach->DeepCopy(disks);
  for (vtkIdType i = 0; i < reach->GetNumberOfTuples(); ++i)
  {
    const bool isHidden = types->GetComponent(i, 0) != 0.;
    reach->SetComponent(i, 3, isHidden ? 0. : Reach * disks->GetComponent(i, 3));
  }
  return reach;
}

std::vector<vtkSmartPointer<vtkPolyData>> GhostsOfAll(
  vtkPolyData* own, vtkDoubleArray* disks, vtkMultiProcessController* controller)
{
  const std::vector<vtkBoundingBox> boxes = BoxesOfRanks(BoxOf(disks), controller);
  const int rank = controller->GetLocalProcessId();
  const int ranks = controller->GetNumberOfProcesses();
  std::vector<vtkSmartPointer<vtkPolyData>> ghosts;
  // All ranks go through the pairs in the same order, so that none waits for one that waits.
  for (int a = 0; a < ranks; ++a)
  {
    for (int b = a + 1; b < ranks; ++b)
    {
      const bool meet = boxes[a].IsValid() && boxes[b].IsValid() && boxes[a].Intersects(boxes[b]);
      if (meet && (rank == a || rank == b))
      {
        const int other = rank == a ? b : a;
        ghosts.push_back(TradeGhosts(own, disks, boxes[other], other, controller));
        Mark(ghosts.back(), vtkDataSetAttributes::DUPLICATEPOINT, other);
      }
    }
  }
  return ghosts;
}

void AppendPoints(vtkPolyData* particles, vtkPoints* points)
{
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(particles->GetPoint(i));
  }
}

vtkSmartPointer<vtkPolyData> Append(
  vtkPolyData* own, const std::vector<vtkSmartPointer<vtkPolyData>>& ghosts)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(own->GetPoints()->GetDataType());
  AppendPoints(own, points);
  std::vector<vtkIdType> counts;
  std::vector<vtkDataSetAttributes*> pointData;
  std::vector<vtkDataSetAttributes*> cellData;
  for (const auto& some : ghosts)
  {
    AppendPoints(some, points);
    counts.push_back(some->GetNumberOfPoints());
    pointData.push_back(some->GetPointData());
    cellData.push_back(some->GetCellData());
  }
  auto all = vtkSmartPointer<vtkPolyData>::New();
  all->ShallowCopy(own);
  all->SetPoints(points);
  vtkNew<vtkPointData> joined;
  Join(own->GetPointData(), own->GetNumberOfPoints(), pointData, counts, joined);
  all->GetPointData()->ShallowCopy(joined);
  if (const vtkIdType cells = own->GetNumberOfVerts())
  {
    vtkNew<vtkCellArray> vertices;
    vertices->DeepCopy(own->GetVerts());
    for (vtkIdType i = own->GetNumberOfPoints(); i < points->GetNumberOfPoints(); ++i)
    {
      vertices->InsertNextCell(1, &i);
    }
    vtkNew<vtkCellData> joinedCells;
    Join(own->GetCellData(), cells, cellData, counts, joinedCells);
    all->SetVerts(vertices);
    all->SetLines(nullptr);
    all->SetPolys(nullptr);
    all->SetStrips(nullptr);
    all->GetCellData()->ShallowCopy(joinedCells);
  }
  return all;
}
}

//------------------------------------------------------------------------------
double GhostParticles::LargestOfRanks(double radius, vtkMultiProcessController* controller)
{
  double largest = radius;
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    controller->AllReduce(&radius, &largest, 1, vtkCommunicator::MAX_OP);
  }
  return largest;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> GhostParticles::Add(
  vtkPolyData* own, vtkDoubleArray* disks, vtkMultiProcessController* controller)
{
  if (!controller || controller->GetNumberOfProcesses() == 1)
  {
    return own;
  }
  const auto marked = MarkOwn(own, controller->GetLocalProcessId());
  const auto ghosts = GhostsOfAll(marked, ReachOf(marked, disks), controller);
  return own->GetNumberOfPoints() > 0 ? Append(marked, ghosts) : marked;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> GhostParticles::Gather(
  vtkPolyData* own, vtkMultiProcessController* controller)
{
  if (!controller || controller->GetNumberOfProcesses() == 1)
  {
    return own;
  }
  const auto marked = MarkOwn(own, controller->GetLocalProcessId());
  if (controller->GetLocalProcessId() > 0)
  {
    controller->Send(marked, 0, Tag);
    return vtkSmartPointer<vtkPolyData>::New();
  }
  std::vector<vtkSmartPointer<vtkPolyData>> parts{ marked };
  for (int rank = 1; rank < controller->GetNumberOfProcesses(); ++rank)
  {
    parts.push_back(vtkSmartPointer<vtkPolyData>::New());
    controller->Receive(parts.back().Get(), rank, Tag);
  }
  const auto isEmpty = [](vtkPolyData* part) { return part->GetNumberOfPoints() == 0; };
  parts.erase(std::remove_if(parts.begin(), parts.end(), isEmpty), parts.end());
  return parts.empty() ? marked : Append(parts[0], { parts.begin() + 1, parts.end() });
}

//------------------------------------------------------------------------------
bool GhostParticles::AreMerged(vtkPolyData* particles)
{
  auto* ranks = vtkUnsignedIntArray::SafeDownCast(particles->GetPointData()->GetArray(RankName));
  vtkDataArray* types = particles->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  std::int64_t rank = -1;
  for (vtkIdType i = 0; ranks && types && i < ranks->GetNumberOfValues(); ++i)
  {
    if (types->GetComponent(i, 0) == 0.)
    {
      if (rank >= 0 && ranks->GetValue(i) != rank)
      {
        return true;
      }
      rank = ranks->GetValue(i);
    }
  }
  return false;
}
}
