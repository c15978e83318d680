#include "vtkHighOrderParticleIsosurface.h"

#include "Classic/ClassicDistribution.h"
#include "Common/VtkThreads.h"
#include "Conversion/GridElements.h"
#include "Fast/FastDistribution.h"
#include "Input/BlockGroups.h"
#include "Input/GatherBlocks.h"
#include "Input/InputChecks.h"
#include "Input/VtkCompatibility.h"
#include "Output/ParticlePacker.h"
#include "Run/PreviousRun.h"
#include "Run/Ranks.h"
#include "Run/RunMessages.h"
#include "Support/Interruptible.h"
#include "Surface/SpacingSearch.h"

#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <vtksys/SystemInformation.hxx>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

namespace
{

constexpr double automaticSpacingPerSide = 0.01;
/// Larger spacings say no more: a component has its least number of particles long before.
constexpr double largestSpacingPerSide = 1e3;
/// Where a run's progress stands when cells are converted, and when particles are done.
constexpr double convertedShare = 0.1;
constexpr double distributedShare = 0.95;
/// Peak of the whole filter, measured at 0.7 to 1.5 kB with one point array.
constexpr std::int64_t bytesPerParticle = 1536;
/// Particles are numbered by int, and so are places in tables with room for half as many more.
constexpr std::int64_t mostParticles = 1'000'000'000;

/// How many particles this machine has memory for now.
std::int64_t particlesThatFit()
{
  constexpr std::int64_t megabyte = 1024 * 1024;
  vtksys::SystemInformation system;
  system.RunMemoryCheck();
  const auto available = static_cast<std::int64_t>(system.GetAvailablePhysicalMemory());
  // 0: the system does not say.
  return available > 0 ? std::min(mostParticles, available * megabyte / bytesPerParticle)
                       : hop::DistributionParameters().particleLimit;
}

/// What the data say about a run; the properties say the rest.
RunOrigin originOf(const InputBlocks& blocks)
{
  RunOrigin origin;
  const char* name = blocks[0].scalars->GetName();
  origin.array = name ? name : "";
  origin.component = blocks.component();
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    // The grid itself is a new copy each time that ParaView's pipeline looks at it.
    vtkUnstructuredGrid* grid = blocks[b].grid;
    for (vtkObject* part : { static_cast<vtkObject*>(grid->GetPoints()),
           static_cast<vtkObject*>(grid->GetCells()), static_cast<vtkObject*>(blocks[b].scalars) })
    {
      origin.dataTime =
        std::max<std::uint64_t>(origin.dataTime, part ? part->GetMTime() : vtkMTimeType(0));
    }
    origin.cells += grid->GetNumberOfCells();
    origin.points += grid->GetNumberOfPoints();
  }
  return origin;
}

/// Which component of the blocks' scalars to contour by; `asked` may be more than they have.
int componentOf(const std::vector<InputBlock>& blocks, int asked)
{
  const int components = blocks.empty() ? 1 : blocks[0].scalars->GetNumberOfComponents();
  return components == 1 ? 0 : asked < components ? asked : InputBlocks::Magnitude;
}

/// The time step that is asked for, 0 if none is.
double timeOf(vtkInformationVector* outputs)
{
  vtkInformation* output = outputs->GetInformationObject(0);
  return output->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
    ? output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
    : 0.0;
}

} // namespace

/// A part of the run, as far as progress and threads are concerned.
struct vtkHighOrderParticleIsosurface::Work
{
  hop::Monitor monitor;
  const hop::ParallelFor& parallelFor;

  Work part(double begin, double end) const
  {
    return { { [this, begin, end](double fraction)
               { return this->monitor.proceed(begin + (end - begin) * fraction); } },
      this->parallelFor };
  }
};

vtkStandardNewMacro(vtkHighOrderParticleIsosurface);

vtkHighOrderParticleIsosurface::vtkHighOrderParticleIsosurface()
  : Previous(std::make_unique<PreviousRun>())
{
  // VTK's list begins with one value, 0: filters whose properties were never set would draw it.
  this->ContourValues->SetNumberOfContours(0);
}

vtkHighOrderParticleIsosurface::~vtkHighOrderParticleIsosurface() = default;

void vtkHighOrderParticleIsosurface::SetValue(int i, double value)
{
  this->ContourValues->SetValue(i, value);
}

double vtkHighOrderParticleIsosurface::GetValue(int i)
{
  return this->ContourValues->GetValue(i);
}

void vtkHighOrderParticleIsosurface::SetNumberOfContours(int number)
{
  this->ContourValues->SetNumberOfContours(number);
}

vtkIdType vtkHighOrderParticleIsosurface::GetNumberOfContours()
{
  return this->ContourValues->GetNumberOfContours();
}

bool vtkHighOrderParticleIsosurface::IsOwnPointArray(const char* name)
{
  return name && isOwnPointArray(name);
}

vtkMTimeType vtkHighOrderParticleIsosurface::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

int vtkHighOrderParticleIsosurface::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObjectTree");
  return 1;
}

int vtkHighOrderParticleIsosurface::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

int vtkHighOrderParticleIsosurface::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(request, inputs, outputs);
  }
  if (!request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->Superclass::ProcessRequest(request, inputs, outputs);
  }
  if (this->IsAskedForMore(outputs))
  {
    this->AbortExecute = 0;
  }
  const int success = this->Superclass::ProcessRequest(request, inputs, outputs);
  this->LastAbort = vtkTimeStamp();
  if (this->AbortExecute)
  {
    this->LastAbort.Modified();
    this->AbortedTime = timeOf(outputs);
  }
  return success;
}

/// Whether a property here or upstream, or the time step, has changed since an abort.
bool vtkHighOrderParticleIsosurface::IsAskedForMore(vtkInformationVector* outputs)
{
  auto* executive = vtkDemandDrivenPipeline::SafeDownCast(this->GetExecutive());
  return this->LastAbort.GetMTime() > 0 &&
    (timeOf(outputs) != this->AbortedTime ||
      (executive && executive->GetPipelineMTime() > this->LastAbort.GetMTime()));
}

/// vtkPolyData for a grid, a composite of the input's own kind for a composite.
int vtkHighOrderParticleIsosurface::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
  if (!input)
  {
    return 0;
  }
  vtkSmartPointer<vtkDataObject> wanted;
  if (auto* tree = vtkDataObjectTree::SafeDownCast(input))
  {
    wanted.TakeReference(tree->NewInstance());
  }
  else
  {
    wanted = vtkSmartPointer<vtkPolyData>::New();
  }
  if (!output || !output->IsA(wanted->GetClassName()))
  {
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), wanted);
  }
  return 1;
}

int vtkHighOrderParticleIsosurface::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const GatheredBlocks gathered =
    gatherBlocks(vtkDataObject::GetData(inputs[0], 0), vtkDataObject::GetData(outputs, 0));
  // Ranks agree on the scale before any of them may return.
  const Scale scale = this->FindScale(gathered.blocks);
  if (!this->WarmStart)
  {
    this->Previous->forget();
  }
  if (!this->Accepts(gathered, scale))
  {
    return 1;
  }
  const CheckedBlocks checked = checkBlocks(gathered, this->GetInputArrayInformation(0));
  const std::vector<InputBlock>& blocks = checked.sound;
  this->Tell(checked.messages);
  this->Tell(reviewArrays(blocks));
  const int component = componentOf(blocks, this->Component);
  const std::vector<InputBlocks> groups = this->Group(InputBlocks(blocks, component));
  const InputBlocks none({}, component);
  // A number of particles is shared out group by group, also by ranks that have fewer of them.
  const std::size_t count =
    this->NumberOfParticles > 0 ? largestOfRanks(groups.size()) : groups.size();
  for (std::size_t g = 0; g < count; ++g)
  {
    const InputBlocks& group = g < groups.size() ? groups[g] : none;
    const double share = 1.0 / static_cast<double>(count);
    const double begin = share * static_cast<double>(g);
    withThreads(
      [&](const hop::ParallelFor& parallelFor) {
        this->Process(group, scale, g, { this->MonitorOf(begin, begin + share), parallelFor });
      });
  }
  return 1;
}

vtkHighOrderParticleIsosurface::Scale vtkHighOrderParticleIsosurface::FindScale(
  const std::vector<InputBlock>& blocks)
{
  vtkBoundingBox box;
  for (const InputBlock& block : blocks)
  {
    if (block.grid->GetNumberOfPoints() > 0)
    {
      box.AddBox(finiteBounds(block.grid));
    }
  }
  box = overAllRanks(box);
  Scale scale;
  if (box.IsValid())
  {
    scale.Spacing = this->Spacing > 0.0
      ? std::min(this->Spacing, largestSpacingPerSide * box.GetMaxLength())
      : automaticSpacingPerSide * box.GetMaxLength();
    scale.Diagonal = box.GetDiagonalLength();
    // No point can be nearer to a surface than coordinates can say.
    double lower[3], upper[3];
    box.GetMinPoint(lower);
    box.GetMaxPoint(upper);
    const auto farther = [](double a, double b) { return std::max(a, std::abs(b)); };
    const double farthest =
      std::accumulate(upper, upper + 3, std::accumulate(lower, lower + 3, 0.0, farther), farther);
    scale.Tolerance = std::max(
      this->Tolerance * scale.Diagonal, 4.0 * std::numeric_limits<double>::epsilon() * farthest);
  }
  return scale;
}

std::vector<double> vtkHighOrderParticleIsosurface::DistinctIsovalues() const
{
  const double* values = this->ContourValues->GetValues();
  std::vector<double> distinct;
  std::copy_if(values, values + this->ContourValues->GetNumberOfContours(),
    std::back_inserter(distinct),
    [&](double value)
    { return std::find(distinct.begin(), distinct.end(), value) == distinct.end(); });
  return distinct;
}

/// Whether a run is possible at all, whatever arrays there are.
bool vtkHighOrderParticleIsosurface::Accepts(const GatheredBlocks& gathered, const Scale& scale)
{
  const std::vector<double> isovalues = this->DistinctIsovalues();
  UserMessages messages = checkIsovalues(isovalues, gathered);
  if (messages.empty())
  {
    messages = checkParameters(isovalues, this->Spacing, this->AngularDensity, this->Tolerance);
  }
  if (messages.empty())
  {
    messages = checkDiagonal(scale.Diagonal);
  }
  this->Tell(messages);
  return messages.empty();
}

void vtkHighOrderParticleIsosurface::Tell(const UserMessages& messages)
{
  for (const UserMessage& message : messages)
  {
    if (message.kind == UserMessage::Error)
    {
      vtkErrorMacro(<< message.text);
    }
    else
    {
      vtkWarningMacro(<< message.text);
    }
  }
}

/// What a run is made of, but for its isovalue.
RunOrigin vtkHighOrderParticleIsosurface::OriginOf(
  const InputBlocks& blocks, const Scale& scale) const
{
  RunOrigin origin = originOf(blocks);
  origin.nodeSpacing = this->NodeSpacing;
  origin.parameters.sizing = { scale.Spacing, this->AngularDensity };
  origin.parameters.quality = static_cast<hop::Quality>(this->Quality);
  origin.parameters.seed = static_cast<std::uint64_t>(this->Seed);
  origin.parameters.particleCount = this->NumberOfParticles;
  origin.parameters.particleLimit = particlesThatFit();
  return origin;
}

/// Reports part of the run, from `begin` to `end` of it, and learns whether to go on.
hop::Monitor vtkHighOrderParticleIsosurface::MonitorOf(double begin, double end)
{
  return { [this, begin, end](double fraction)
    {
      this->UpdateProgress(begin + (end - begin) * fraction);
      return !isAborted(this);
    } };
}

/// Blocks that are contoured as one mesh each; none where the run is to stop.
std::vector<InputBlocks> vtkHighOrderParticleIsosurface::Group(const InputBlocks& blocks)
{
  if (blocks.size() == 1)
  {
    return { blocks };
  }
  std::vector<InputBlocks> groups;
  const hop::Monitor monitor = this->MonitorOf(0.0, 0.0);
  withThreads(
    [&](const hop::ParallelFor& parallelFor)
    {
      hop::Interruptible loops(monitor, parallelFor);
      this->UnlessAborted(
        blocks, [&]() { groups = groupWithoutSharedCells(blocks, std::ref(loops)); });
    });
  return groups;
}

/// Particles of all isovalues in one group of blocks. A rank without a group of that number takes part in what
/// ranks agree on, as does one that is to stop.
void vtkHighOrderParticleIsosurface::Process(
  const InputBlocks& blocks, const Scale& scale, std::size_t group, const Work& work)
{
  std::optional<GridElements> elements;
  this->UnlessAborted(
    blocks, [&]() { elements = this->Convert(blocks, work.part(0.0, convertedShare)); });
  const GridElements none;
  const std::vector<RankShare> shares = this->ShareOut(
    blocks, elements ? *elements : none, scale, work.part(convertedShare, convertedShare));
  if (elements)
  {
    this->UnlessAborted(
      blocks, [&]() { this->Fill(blocks, *elements, scale, group, shares, work); });
  }
}

/// Does some work on blocks; where it is interrupted, or memory runs out, they stay without particles.
template <class Use>
void vtkHighOrderParticleIsosurface::UnlessAborted(const InputBlocks& blocks, const Use& use)
{
  if (blocks.size() == 0 || isAborted(this))
  {
    return;
  }
  const auto empty = [&]()
  {
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      blocks[b].particles->Initialize();
    }
  };
  try
  {
    use();
  }
  catch (const hop::Interrupted&)
  {
    empty();
  }
  catch (const std::exception& failure)
  {
    empty();
    this->Tell({ describeFailure(failure, this->NumberOfParticles) });
  }
}

/// How many particles of each isovalue this rank is to give, if their number is given; those in ghost cells, which
/// are not kept, are more.
std::vector<RankShare> vtkHighOrderParticleIsosurface::ShareOut(
  const InputBlocks& blocks, const GridElements& elements, const Scale& scale, const Work& work)
{
  const std::vector<double> isovalues = this->DistinctIsovalues();
  std::vector<RankShare> shares(isovalues.size(), { this->NumberOfParticles, 0.0 });
  const auto isGhost = [&](const hop::Element& element)
  { return blocks.isGhost(blocks.locate(element.cell)); };
  const std::vector<hop::Element>& all = elements.mesh.elements;
  const bool isShared = isOneOfRanks() || std::any_of(all.begin(), all.end(), isGhost);
  // More than all ranks hold is refused by each of them when it is asked for.
  if (isShared && this->NumberOfParticles > 0 &&
    static_cast<double>(this->NumberOfParticles) <=
      sumOfRanks(static_cast<double>(particlesThatFit())))
  {
    shares = shareOutToRanks(this->NumberOfParticles, isovalues.size(),
      hop::SpacingSearch::FirstSpacingPerDiagonal * scale.Diagonal,
      [&](std::size_t i, double spacing)
      {
        WantedParticles wanted;
        this->UnlessAborted(blocks,
          [&]()
          { wanted = this->CountWanted(blocks, elements, scale, isovalues[i], spacing, work); });
        return wanted;
      });
  }
  return shares;
}

/// \throw hop::Interrupted
WantedParticles vtkHighOrderParticleIsosurface::CountWanted(const InputBlocks& blocks,
  const GridElements& elements, const Scale& scale, double isovalue, double spacing,
  const Work& work)
{
  if (!elements.canBe(isovalue))
  {
    return {};
  }
  const std::vector<double> ofElements =
    hop::wantedParticles({ &elements.mesh, elements.fieldIsovalue(isovalue), scale.Tolerance },
      { spacing, this->AngularDensity }, work.monitor, work.parallelFor);
  WantedParticles wanted;
  for (std::size_t e = 0; e < ofElements.size(); ++e)
  {
    const bool isGhost = blocks.isGhost(blocks.locate(elements.mesh.elements[e].cell));
    (isGhost ? wanted.ghosts : wanted.owned) += ofElements[e];
  }
  return wanted;
}

/// Distributes particles, and writes them.
/// \throw hop::Interrupted
void vtkHighOrderParticleIsosurface::Fill(const InputBlocks& blocks, const GridElements& elements,
  const Scale& scale, std::size_t group, const std::vector<RankShare>& shares, const Work& work)
{
  const std::vector<double> isovalues = this->DistinctIsovalues();
  const double shareOfIsovalue =
    (distributedShare - convertedShare) / static_cast<double>(isovalues.size());
  RunOrigin origin = this->OriginOf(blocks, scale);
  std::vector<IsovalueParticles> particles;
  for (std::size_t i = 0; i < isovalues.size() && !isAborted(this); ++i)
  {
    origin.isovalue = isovalues[i];
    const double begin = convertedShare + static_cast<double>(i) * shareOfIsovalue;
    particles.push_back({ origin.isovalue,
      this->Distribute(elements, scale, origin, group * isovalues.size() + i, shares[i],
        work.part(begin, begin + shareOfIsovalue)) });
    this->Tell(reviewDistribution(
      blocks, particles.back().distribution, origin.isovalue, this->NumberOfParticles));
  }
  const Work packing = work.part(distributedShare, 1.0);
  hop::Interruptible loops(packing.monitor, packing.parallelFor);
  packParticles(blocks, elements, particles, loops);
}

/// \throw hop::Interrupted
GridElements vtkHighOrderParticleIsosurface::Convert(const InputBlocks& blocks, const Work& work)
{
  hop::Interruptible loops(work.monitor, work.parallelFor);
  const auto reached = [&](double share)
  {
    loops.raiseFraction(share);
    loops.ask();
  };
  const auto spacing = this->NodeSpacing == UNIFORM ? hop::NodeSpacing::Uniform
                                                    : hop::NodeSpacing::GaussLobattoLegendre;
  GridElements elements =
    buildGridElements(blocks, spacing, this->DistinctIsovalues(), std::ref(loops), reached);
  this->Tell(reviewCells(blocks, elements.census));
  return elements;
}

/// \param number tells the isosurfaces of a run from one another
hop::Distribution vtkHighOrderParticleIsosurface::Distribute(const GridElements& elements,
  const Scale& scale, const RunOrigin& origin, std::size_t number, const RankShare& share,
  const Work& work)
{
  if ((this->NumberOfParticles > 0 && share.count == 0) || !elements.canBe(origin.isovalue))
  {
    return {};
  }
  const bool continues = this->WarmStart && this->Method == FAST;
  hop::DistributionParameters parameters = origin.parameters;
  parameters.particleCount = share.count;
  parameters.firstSpacing = share.spacing;
  if (continues)
  {
    parameters.start = this->Previous->startOf(number, origin, elements.mesh);
  }
  const auto distribute = this->Method == CLASSIC ? hop::distributeClassic : hop::distributeFast;
  hop::Distribution distribution =
    distribute({ &elements.mesh, elements.fieldIsovalue(origin.isovalue), scale.Tolerance },
      parameters, work.monitor, work.parallelFor);
  if (continues)
  {
    this->Previous->remember(number, origin, elements.mesh, distribution, work.parallelFor);
  }
  return distribution;
}

void vtkHighOrderParticleIsosurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Spacing: " << this->Spacing << "\n";
  os << indent << "AngularDensity: " << this->AngularDensity << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Component: " << this->Component << "\n";
  os << indent << "NodeSpacing: " << this->NodeSpacing << "\n";
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "Quality: " << this->Quality << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "NumberOfParticles: " << this->NumberOfParticles << "\n";
  os << indent << "WarmStart: " << (this->WarmStart ? "On" : "Off") << "\n";
  os << indent << "ContourValues:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
}
