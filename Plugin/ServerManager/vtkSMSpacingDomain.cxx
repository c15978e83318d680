#include "vtkSMSpacingDomain.h"

#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkSMSpacingDomain);

vtkSMSpacingDomain::vtkSMSpacingDomain() = default;
vtkSMSpacingDomain::~vtkSMSpacingDomain() = default;

void vtkSMSpacingDomain::Update(vtkSMProperty* property)
{
  vtkPVDataInformation* input = this->GetInputInformation();
  const double* bounds = input ? input->GetBounds() : nullptr;
  if (bounds && vtkMath::AreBoundsInitialized(bounds) &&
    std::all_of(bounds, bounds + 6, [](double x) { return std::isfinite(x); }))
  {
    this->Superclass::Update(property);
  }
  else
  {
    this->SetEntries({});
  }
}

int vtkSMSpacingDomain::SetDefaultValues(vtkSMProperty* property, bool useUnchecked)
{
  constexpr double shareOfRange = 0.1; // leaves room for larger spacings on the slider
  if (!this->GetMaximumExists(0))
  {
    return 0;
  }
  vtkSMPropertyHelper spacing(property);
  spacing.SetUseUnchecked(useUnchecked);
  spacing.Set(shareOfRange * this->GetMaximum(0));
  return 1;
}
