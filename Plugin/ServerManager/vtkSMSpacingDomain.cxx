#include "vtkSMSpacingDomain.h"

#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"

vtkStandardNewMacro(vtkSMSpacingDomain);

vtkSMSpacingDomain::vtkSMSpacingDomain() = default;
vtkSMSpacingDomain::~vtkSMSpacingDomain() = default;

void vtkSMSpacingDomain::Update(vtkSMProperty* property)
{
  vtkPVDataInformation* input = this->GetInputInformation();
  if (input && vtkMath::AreBoundsInitialized(input->GetBounds()))
  {
    this->Superclass::Update(property);
  }
  else
  {
    this->SetEntries({});
  }
}
