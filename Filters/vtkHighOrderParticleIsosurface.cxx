#include "vtkHighOrderParticleIsosurface.h"

#include "Conversion/CellBases.h"
#include "Conversion/CellValues.h"
#include "Input/Fingerprint.h"
#include "Input/GatherBlocks.h"
#include "Input/InputChecks.h"
#include "Input/MadeScalars.h"
#include "Input/VtkCompatibility.h"
#include "Output/OutputArrays.h"
#include "Run/KeptOutput.h"
#include "Run/ParticleRun.h"
#include "Run/PreviousRun.h"
#include "Run/Ranks.h"
#include "Run/RunMessages.h"
#include "Run/RunScale.h"
#include "Support/Exchange.h"

#include "vtkContourValues.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTypes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <string>
#include <vector>

namespace
{

/// The time step that is asked for, 0 if none is.
double timeOf(vtkInformationVector* outputs)
{
  vtkInformation* output = outputs->GetInformationObject(0);
  return output->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
    ? output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
    : 0.0;
}

/// nullptr where there is no array of that number.
const hop::OutputArray* outputArray(int i)
{
  const std::vector<hop::OutputArray>& arrays = hop::describeOutputArrays();
  return i >= 0 && i < static_cast<int>(arrays.size()) ? &arrays[i] : nullptr;
}

} // namespace

vtkStandardNewMacro(vtkHighOrderParticleIsosurface);

vtkHighOrderParticleIsosurface::vtkHighOrderParticleIsosurface()
  : Previous(std::make_unique<hop::PreviousRun>())
  , Kept(std::make_unique<hop::KeptOutput>())
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
  return name && hop::isOwnPointArray(name);
}

int vtkHighOrderParticleIsosurface::GetNumberOfOutputArrays()
{
  return static_cast<int>(hop::describeOutputArrays().size());
}

const char* vtkHighOrderParticleIsosurface::GetOutputArrayName(int i)
{
  const hop::OutputArray* array = outputArray(i);
  return array ? array->name : nullptr;
}

int vtkHighOrderParticleIsosurface::GetOutputArrayAssociation(int i)
{
  const hop::OutputArray* array = outputArray(i);
  return array ? array->association : -1;
}

int vtkHighOrderParticleIsosurface::GetOutputArrayNumberOfComponents(int i)
{
  const hop::OutputArray* array = outputArray(i);
  return array ? array->components : 0;
}

const char* vtkHighOrderParticleIsosurface::GetOutputArrayDescription(int i)
{
  const hop::OutputArray* array = outputArray(i);
  return array ? array->meaning : nullptr;
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

/// Of what is not a composite.
int vtkHighOrderParticleIsosurface::KindOfOutput() const
{
  return this->OutputType == CURVED_TRIANGLES ? VTK_UNSTRUCTURED_GRID : VTK_POLY_DATA;
}

/// Data of KindOfOutput() for a grid, a composite of the input's own kind for a composite.
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
    wanted.TakeReference(vtkDataObjectTypes::NewDataObject(this->KindOfOutput()));
  }
  if (!output || !output->IsA(wanted->GetClassName()))
  {
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), wanted);
  }
  return 1;
}

/// An exception, for want of memory as a rule, is told and leaves an empty output. On several ranks it goes on and ends
/// the program, as the others would wait for ever for a rank that has left.
int vtkHighOrderParticleIsosurface::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
  try
  {
    this->Answer(vtkDataObject::GetData(inputs[0], 0), output);
  }
  catch (const std::exception& failure)
  {
    if (!hop::makeExchange()->isAlone())
    {
      throw;
    }
    output->Initialize();
    this->Kept->forget();
    this->Previous->forget();
    this->Tell({ hop::describeFailure(failure, this->NumberOfParticles) });
  }
  return 1;
}

/// The output of the run before, where nothing has changed, or a run.
void vtkHighOrderParticleIsosurface::Answer(vtkDataObject* input, vtkDataObject* output)
{
  const std::uint64_t request = this->HashOfRequest(input);
  const bool isKept = this->Kept->answers(request) && !hop::isAborted(this);
  // A run takes all ranks: it is left out where none of them has anything new.
  if (hop::largestOfRanks(isKept ? 0 : 1) == 0)
  {
    this->Kept->copyTo(output);
    return;
  }
  this->Kept->forget();
  this->HasFailed = false;
  this->Run(input, output);
  if (!this->HasFailed && !hop::isAborted(this))
  {
    this->Kept->keep(request, output);
  }
}

void vtkHighOrderParticleIsosurface::Run(vtkDataObject* input, vtkDataObject* output)
{
  const hop::GatheredBlocks gathered = hop::gatherBlocks(input, this->KindOfOutput(), output);
  // Ranks agree on the scale before any of them may return.
  const hop::RunScale scale = hop::findScale(gathered.blocks, this->Spacing, this->Tolerance);
  if (!this->WarmStart)
  {
    this->Previous->forget();
  }
  const hop::RunProperties properties = this->PropertiesOfRun();
  if (!this->Accepts(gathered, properties, scale))
  {
    return;
  }
  const hop::CheckedBlocks checked = this->FindScalars(gathered);
  this->Tell(checked.messages);
  this->Tell(hop::reviewArrays(checked.sound, properties.passed));
  bool hasTold = !checked.messages.empty();
  this->SetProgressText("Finding the surface");
  hop::RunCaller caller = this->CallerOfRun();
  caller.tell = [&](const hop::UserMessages& messages)
  {
    hasTold = hasTold || !messages.empty();
    this->Tell(messages);
  };
  const hop::InputBlocks blocks(checked.sound,
    hop::componentOf(checked.sound, this->Component, checked.quantity), checked.quantity,
    checked.expression);
  const hop::RunResult result =
    hop::ParticleRun(properties, scale, caller, *this->Previous).run(blocks);
  this->HasFailed = this->HasFailed || !result.isComplete;
  this->ReviewSurfaces(
    blocks, properties.isovalues, result.counts, hasTold || hop::isAborted(this));
}

/// Tells of isosurfaces without particles, unless that is explained.
void vtkHighOrderParticleIsosurface::ReviewSurfaces(const hop::InputBlocks& blocks,
  const std::vector<double>& isovalues, const std::vector<std::int64_t>& counts, bool isExplained)
{
  this->Tell(hop::reviewSurfaces(blocks, isovalues, counts, isExplained));
}

/// One number for all that the output depends on but previous runs.
std::uint64_t vtkHighOrderParticleIsosurface::HashOfRequest(vtkDataObject* input)
{
  hop::ByteHash hash;
  const double* values = this->ContourValues->GetValues();
  hash.add(values, sizeof(double) * this->ContourValues->GetNumberOfContours());
  for (const double number :
    { this->Spacing, this->AngularDensity, this->SmallestSpacing, this->Tolerance })
  {
    hash.add(number);
  }
  for (const vtkIdType number :
    { vtkIdType(this->Component), vtkIdType(this->NodeSpacing), vtkIdType(this->Method),
      vtkIdType(this->Quality), vtkIdType(this->Seed), this->NumberOfParticles,
      this->ParticlesPerWorker, vtkIdType(this->WarmStart), vtkIdType(this->PassDiagnostics),
      vtkIdType(this->PassDerivatives), vtkIdType(this->OutputType), vtkIdType(this->Order) })
  {
    hash.addWord(static_cast<std::uint64_t>(number));
  }
  this->AddField(hash);
  hop::addData(input, hash);
  return hash.value();
}

void vtkHighOrderParticleIsosurface::AddField(hop::ByteHash& hash)
{
  if (vtkInformation* array = this->GetInputArrayInformation(0))
  {
    const char* name = array->Get(vtkDataObject::FIELD_NAME());
    hash.add(std::string(name ? name : ""));
    hash.addWord(array->Get(vtkDataObject::FIELD_ASSOCIATION()));
    hash.addWord(array->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()));
  }
  hash.addWord(static_cast<std::uint64_t>(this->Quantity));
  hash.addWord(static_cast<std::uint64_t>(this->Derivatives));
  hash.add(this->Expression);
}

std::vector<double> vtkHighOrderParticleIsosurface::FindIsovalues()
{
  const double* values = this->ContourValues->GetValues();
  std::vector<double> distinct;
  std::copy_if(values, values + this->ContourValues->GetNumberOfContours(),
    std::back_inserter(distinct),
    [&](double value)
    { return std::find(distinct.begin(), distinct.end(), value) == distinct.end(); });
  return distinct;
}

std::vector<hop::UserMessage> vtkHighOrderParticleIsosurface::CheckIsovalues(
  const hop::GatheredBlocks& gathered)
{
  return hop::checkIsovalues(this->FindIsovalues(), gathered);
}

hop::CheckedBlocks vtkHighOrderParticleIsosurface::FindScalars(const hop::GatheredBlocks& gathered)
{
  if (this->Quantity == EXPRESSION)
  {
    return hop::checkExpression(gathered, this->Expression);
  }
  const auto quantity = static_cast<hop::Quantity>(this->Quantity);
  hop::CheckedBlocks checked =
    hop::checkQuantity(hop::checkBlocks(gathered, this->GetInputArrayInformation(0)), quantity);
  if (this->Derivatives != AVERAGED_AT_NODES)
  {
    return checked;
  }
  // VTK's cells end the program where the number of points is wrong.
  hop::CellBases bases(hop::NodeSpacing::Uniform);
  hop::BasisLookup lookup(bases);
  hop::CellValues values;
  return hop::averagedAtNodes(checked, hop::componentOf(checked.sound, this->Component, quantity),
    [&](vtkUnstructuredGrid* grid, vtkIdType cell)
    { return lookup.basisOf(grid, cell) && hop::readIds(grid, cell, values); });
}

hop::RunProperties vtkHighOrderParticleIsosurface::PropertiesOfRun()
{
  hop::RunProperties properties;
  properties.isovalues = this->FindIsovalues();
  properties.angularDensity = this->AngularDensity;
  properties.smallestSpacing = this->SmallestSpacing;
  properties.averaged = this->Derivatives == AVERAGED_AT_NODES && this->Quantity != EXPRESSION
    ? static_cast<hop::Quantity>(this->Quantity)
    : hop::Quantity::Value;
  properties.nodeSpacing = this->NodeSpacing == UNIFORM ? hop::NodeSpacing::Uniform
                                                        : hop::NodeSpacing::GaussLobattoLegendre;
  properties.quality = static_cast<hop::Quality>(this->Quality);
  properties.seed = static_cast<std::uint64_t>(this->Seed);
  properties.numberOfParticles = this->NumberOfParticles;
  properties.particlesPerWorker = this->ParticlesPerWorker;
  properties.isClassic = this->Method == CLASSIC;
  properties.isWarmStart = this->WarmStart;
  properties.passed = { this->PassDiagnostics, this->PassDerivatives };
  properties.outputType = static_cast<hop::OutputType>(this->OutputType);
  properties.order = this->Order;
  return properties;
}

/// How a run reports its progress, learns whether to go on, and speaks to the user.
hop::RunCaller vtkHighOrderParticleIsosurface::CallerOfRun()
{
  const auto report = [this](double fraction)
  {
    this->UpdateProgress(fraction);
    return !hop::isAborted(this);
  };
  const auto expect = [this](double particles)
  { this->SetProgressText(hop::describeExpected(particles).c_str()); };
  return { report, [this]() { return hop::isAborted(this); },
    [this](const hop::UserMessages& messages) { this->Tell(messages); }, expect };
}

/// Whether a run is possible at all, whatever arrays there are.
bool vtkHighOrderParticleIsosurface::Accepts(const hop::GatheredBlocks& gathered,
  const hop::RunProperties& properties, const hop::RunScale& scale)
{
  hop::UserMessages messages = this->CheckIsovalues(gathered);
  if (messages.empty())
  {
    messages = hop::checkParameters(properties.isovalues, this->Spacing, this->SmallestSpacing,
      this->AngularDensity, this->Tolerance);
  }
  if (messages.empty())
  {
    messages = hop::checkDiagonal(scale.diagonal);
  }
  this->Tell(messages);
  return messages.empty();
}

void vtkHighOrderParticleIsosurface::Tell(const hop::UserMessages& messages)
{
  for (const hop::UserMessage& message : messages)
  {
    if (message.kind == hop::UserMessage::Error)
    {
      this->HasFailed = true;
      vtkErrorMacro(<< message.text);
    }
    else
    {
      vtkWarningMacro(<< message.text);
    }
  }
}

void vtkHighOrderParticleIsosurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Spacing: " << this->Spacing << "\n";
  os << indent << "AngularDensity: " << this->AngularDensity << "\n";
  os << indent << "SmallestSpacing: " << this->SmallestSpacing << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Component: " << this->Component << "\n";
  os << indent << "Quantity: " << this->Quantity << "\n";
  os << indent << "Expression: " << this->Expression << "\n";
  os << indent << "Derivatives: " << this->Derivatives << "\n";
  os << indent << "NodeSpacing: " << this->NodeSpacing << "\n";
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "Quality: " << this->Quality << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "NumberOfParticles: " << this->NumberOfParticles << "\n";
  os << indent << "ParticlesPerWorker: " << this->ParticlesPerWorker << "\n";
  os << indent << "WarmStart: " << (this->WarmStart ? "On" : "Off") << "\n";
  os << indent << "PassDiagnostics: " << (this->PassDiagnostics ? "On" : "Off") << "\n";
  os << indent << "PassDerivatives: " << (this->PassDerivatives ? "On" : "Off") << "\n";
  os << indent << "OutputType: " << this->OutputType << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "ContourValues:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
}
