#include "vtkSMComponentDomain.h"

#include "vtkObjectFactory.h"
#include "vtkSMUncheckedPropertyHelper.h"
#include "vtkType.h"

#include <string>
#include <vector>

namespace
{

constexpr const char* magnitude = "Magnitude"; // as in vtkSMNumberOfComponentsDomain
/// Number of the magnitude of an array that is not known: no array has as many components.
constexpr int magnitudeOfAny = VTK_INT_MAX;

} // namespace

vtkStandardNewMacro(vtkSMComponentDomain);

vtkSMComponentDomain::vtkSMComponentDomain() = default;
vtkSMComponentDomain::~vtkSMComponentDomain() = default;

void vtkSMComponentDomain::Update(vtkSMProperty* property)
{
  DeferDomainModifiedEvents once(this);
  // Where the superclass finds no array, it keeps the entries of the previous one.
  this->RemoveAllEntries();
  this->Superclass::Update(property);
  if (this->GetNumberOfEntries() == 0)
  {
    this->OfferUsualNames();
  }
  else if (this->HasEntryText(magnitude))
  {
    this->NumberMagnitudeAsChosen();
  }
}

void vtkSMComponentDomain::OfferUsualNames()
{
  for (const char* name : { "X", "Y", "Z" })
  {
    this->AddEntry(name, static_cast<int>(this->GetNumberOfEntries()));
  }
  this->AddEntry(magnitude, magnitudeOfAny);
  this->AddEntry("", 0);
  this->DomainModified();
}

/// Gives the magnitude the property's value, if this is larger. Entries cannot be changed, so all are listed again.
void vtkSMComponentDomain::NumberMagnitudeAsChosen()
{
  const int components = this->GetEntryValueForText(magnitude);
  const int chosen = vtkSMUncheckedPropertyHelper(this->GetProperty()).GetAsInt();
  if (chosen <= components)
  {
    return;
  }
  std::vector<std::string> names;
  names.reserve(components);
  for (int component = 0; component < components; ++component)
  {
    names.emplace_back(this->GetEntryTextForValue(component));
  }
  this->RemoveAllEntries();
  for (const std::string& name : names)
  {
    this->AddEntry(name.c_str(), static_cast<int>(this->GetNumberOfEntries()));
  }
  this->AddEntry(magnitude, chosen);
}
