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
  else if (this->GetNumberOfEntries() == 1 || this->HasEntryText(magnitude))
  {
    this->NumberLastAsChosen();
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

/// Gives the last entry, a magnitude or the only component, the property's value, if this is larger. Entries cannot be
/// changed, so all are listed again.
void vtkSMComponentDomain::NumberLastAsChosen()
{
  const int last = static_cast<int>(this->GetNumberOfEntries()) - 1;
  const int chosen = vtkSMUncheckedPropertyHelper(this->GetProperty()).GetAsInt();
  if (chosen <= last)
  {
    return;
  }
  std::vector<std::string> names;
  for (int number = 0; number <= last; ++number)
  {
    const char* name = this->GetEntryTextForValue(number);
    names.emplace_back(name ? name : "");
  }
  this->RemoveAllEntries();
  for (int number = 0; number <= last; ++number)
  {
    this->AddEntry(names[number].c_str(), number < last ? number : chosen);
  }
}
