#include "Run/KeptOutput.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkNew.h"

namespace hop
{

void KeptOutput::copyTo(vtkDataObject* output) const
{
  // What the pipeline noted of this request, its time for instance, is not that of the last one.
  vtkNew<vtkInformation> notes;
  notes->Copy(output->GetInformation());
  output->ShallowCopy(this->Data);
  output->GetInformation()->Copy(notes);
}

void KeptOutput::keep(std::uint64_t request, vtkDataObject* output)
{
  this->Request = request;
  this->Data.TakeReference(output->NewInstance());
  this->Data->ShallowCopy(output);
}

} // namespace hop
