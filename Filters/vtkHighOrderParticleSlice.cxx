#include "vtkHighOrderParticleSlice.h"

#include "Input/CutMap.h"
#include "Input/InputChecks.h"
#include "Output/AppendOutputs.h"
#include "Run/ParticleRun.h"
#include "Run/Ranks.h"
#include "Support/ByteHash.h"

#include "vtkBox.h"
#include "vtkImplicitFunction.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <map>
#include <sstream>

/// What the runs of the six faces of a box have in common.
struct vtkHighOrderParticleSlice::BoxRuns
{
  /// The one at hand.
  int face = 0;
  hop::UserMessages messages;
  /// This rank's particles of all faces so far, one an offset.
  std::map<double, std::int64_t> counts;
  bool isExplained = false;

  /// Faces of one box have much to tell that is the same.
  void add(const hop::UserMessage& message)
  {
    const auto isSame = [&](const hop::UserMessage& other) { return other.text == message.text; };
    if (std::none_of(this->messages.begin(), this->messages.end(), isSame))
    {
      this->messages.push_back(message);
    }
  }

  /// Tells of boxes without particles.
  hop::UserMessages review() const
  {
    std::string missing;
    for (const auto& [offset, count] : this->counts)
    {
      if (hop::sumOfRanks(static_cast<double>(count)) == 0.0)
      {
        std::ostringstream text;
        text << (missing.empty() ? "" : ", ") << offset;
        missing += text.str();
      }
    }
    const bool isToldWhy = hop::sumOfRanks(this->isExplained ? 1.0 : 0.0) > 0.0;
    if (missing.empty() || isToldWhy || !hop::isFirstOfRanks())
    {
      return {};
    }
    return { { hop::UserMessage::Warning,
      "Slices at offsets " + missing +
        ": no surface, as no face of the box passes through a cell; move the box or change its "
        "size." } };
  }
};

vtkStandardNewMacro(vtkHighOrderParticleSlice);

vtkHighOrderParticleSlice::vtkHighOrderParticleSlice()
{
  this->SetValue(0, 0.0);
}

vtkHighOrderParticleSlice::~vtkHighOrderParticleSlice() = default;

void vtkHighOrderParticleSlice::SetCutFunction(vtkImplicitFunction* function)
{
  if (function != this->CutFunction)
  {
    this->CutFunction = function;
    this->Modified();
  }
}

vtkImplicitFunction* vtkHighOrderParticleSlice::GetCutFunction()
{
  return this->CutFunction;
}

vtkMTimeType vtkHighOrderParticleSlice::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->CutFunction ? std::max(own, this->CutFunction->GetMTime()) : own;
}

/// Values of the map's scalars, or lengths of its vectors.
std::vector<double> vtkHighOrderParticleSlice::FindIsovalues()
{
  hop::UserMessages messages; // are told by FindScalars()
  const std::vector<hop::CutMap> maps = hop::cutMapsOf(this->CutFunction, messages);
  const double level = maps.empty() ? 0.0 : maps[0].level;
  std::vector<double> isovalues = this->Superclass::FindIsovalues();
  for (double& isovalue : isovalues)
  {
    isovalue += level;
  }
  return isovalues;
}

std::vector<hop::UserMessage> vtkHighOrderParticleSlice::CheckIsovalues(const hop::GatheredBlocks&)
{
  if (this->GetNumberOfContours() > 0)
  {
    return {};
  }
  return { { hop::UserMessage::Warning,
    "There are no particles, as no offset is given; set SliceOffsetValues, to 0 for one slice." } };
}

hop::CheckedBlocks vtkHighOrderParticleSlice::FindScalars(const hop::GatheredBlocks& gathered)
{
  hop::UserMessages messages;
  const std::vector<hop::CutMap> maps = hop::cutMapsOf(this->CutFunction, messages);
  if (maps.empty())
  {
    hop::CheckedBlocks none;
    none.messages = messages;
    return none;
  }
  const hop::CutMap& map = maps[this->Box ? this->Box->face : 0];
  return hop::checkBlocks(
    gathered, [&](vtkUnstructuredGrid* grid) { return hop::cutValues(map, grid); },
    this->CutFunction->GetMTime());
}

void vtkHighOrderParticleSlice::AddField(hop::ByteHash& hash)
{
  hop::UserMessages messages;
  for (const hop::CutMap& map : hop::cutMapsOf(this->CutFunction, messages))
  {
    hash.add(map.level);
    hash.add(&map.origin.x, sizeof(map.origin));
    hash.add(map.rows.data(), sizeof(glm::dvec3) * map.rows.size());
  }
}

/// Of a face, the offsets at which the box has not turned inside out, and what its planes are cut to.
hop::RunProperties vtkHighOrderParticleSlice::PropertiesOfRun()
{
  hop::RunProperties properties = this->Superclass::PropertiesOfRun();
  hop::UserMessages messages; // are told by FindScalars()
  const std::vector<hop::CutMap> maps = hop::cutMapsOf(this->CutFunction, messages);
  if (!this->Box || maps.empty())
  {
    return properties;
  }
  std::vector<double> offsets;
  std::swap(offsets, properties.isovalues);
  for (const double offset : offsets)
  {
    const hop::PlanePolygon polygon = maps[this->Box->face].polygonAt(offset);
    if (!polygon.isEverything())
    {
      properties.isovalues.push_back(offset);
      properties.polygons.push_back(polygon);
    }
  }
  properties.isWarmStart = false;
  return properties;
}

void vtkHighOrderParticleSlice::Run(vtkDataObject* input, vtkDataObject* output)
{
  if (!vtkBox::SafeDownCast(this->CutFunction))
  {
    this->Superclass::Run(input, output);
  }
  else if (this->TakesBox())
  {
    this->Box = std::make_unique<BoxRuns>();
    try
    {
      this->RunFaces(input, output);
    }
    catch (...)
    {
      this->Box.reset(); // else what is told of the failure would wait for the next box
      throw;
    }
  }
}

/// Whether other properties allow for a box; says what does not.
bool vtkHighOrderParticleSlice::TakesBox()
{
  const auto refuse = [this](const char* text)
  {
    this->Tell({ { hop::UserMessage::Error, text } });
    return false;
  };
  if (this->GetMethod() == CLASSIC)
  {
    return refuse("A slice along a box is made by the Method Fast only; choose it.");
  }
  return this->GetNumberOfParticles() == 0 ||
    refuse("A slice along a box takes no NumberOfParticles; set it to 0, and the Spacing instead.");
}

/// Makes the faces of a box one by one, and puts them together. Where one has failed or is aborted, there are none.
void vtkHighOrderParticleSlice::RunFaces(vtkDataObject* input, vtkDataObject* output)
{
  constexpr int faceCount = 6;
  std::vector<vtkSmartPointer<vtkDataObject>> faces;
  for (int face = 0; face < faceCount && !this->HasRunFailed(); ++face)
  {
    this->Box->face = face;
    this->SetProgressShiftScale(face / double(faceCount), 1.0 / faceCount);
    faces.emplace_back().TakeReference(output->NewInstance());
    this->Superclass::Run(input, faces.back());
  }
  this->SetProgressShiftScale(0.0, 1.0);
  if (this->HasRunFailed())
  {
    output->Initialize();
  }
  else
  {
    hop::appendOutputs(faces, output);
  }
  const std::unique_ptr<BoxRuns> runs = std::move(this->Box);
  this->Tell(runs->messages);
  this->Tell(runs->review());
}

/// What several faces tell is told once, when all are done.
void vtkHighOrderParticleSlice::Tell(const std::vector<hop::UserMessage>& messages)
{
  if (!this->Box)
  {
    this->Superclass::Tell(messages);
    return;
  }
  for (const hop::UserMessage& message : messages)
  {
    this->Box->add(message);
  }
}

void vtkHighOrderParticleSlice::ReviewSurfaces(const hop::InputBlocks& blocks,
  const std::vector<double>& isovalues, const std::vector<std::int64_t>& counts, bool isExplained)
{
  if (!this->Box)
  {
    this->Superclass::ReviewSurfaces(blocks, isovalues, counts, isExplained);
    return;
  }
  for (std::size_t i = 0; i < isovalues.size(); ++i)
  {
    this->Box->counts[isovalues[i]] += counts[i];
  }
  this->Box->isExplained = this->Box->isExplained || isExplained;
}

void vtkHighOrderParticleSlice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CutFunction: ";
  if (this->CutFunction)
  {
    os << "\n";
    this->CutFunction->PrintSelf(os, indent.GetNextIndent());
  }
  else
  {
    os << "(none)\n";
  }
}
