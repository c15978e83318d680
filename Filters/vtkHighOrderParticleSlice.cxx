#include "vtkHighOrderParticleSlice.h"

#include "Input/CutMap.h"
#include "Input/InputChecks.h"
#include "Support/ByteHash.h"

#include "vtkImplicitFunction.h"
#include "vtkObjectFactory.h"

#include <algorithm>

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
  const double level = hop::cutMapOf(this->CutFunction, messages).level;
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
  const hop::CutMap map = hop::cutMapOf(this->CutFunction, messages);
  if (!messages.empty())
  {
    hop::CheckedBlocks none;
    none.messages = messages;
    return none;
  }
  return hop::checkBlocks(
    gathered, [&](vtkUnstructuredGrid* grid) { return hop::cutValues(map, grid); },
    this->CutFunction->GetMTime());
}

void vtkHighOrderParticleSlice::AddField(hop::ByteHash& hash)
{
  hop::UserMessages messages;
  const hop::CutMap map = hop::cutMapOf(this->CutFunction, messages);
  hash.add(map.level);
  hash.add(&map.origin.x, sizeof(map.origin));
  hash.add(map.rows.data(), sizeof(glm::dvec3) * map.rows.size());
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
