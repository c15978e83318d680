/**
 * @class vtkSMComponentDomain
 * @brief the components of an array and its magnitude, by names that are known before the array is
 *
 * vtkSMNumberOfComponentsDomain is empty until the input has run, and refuses the names that Python state files and
 * traces give before: `Component = 'Y'`. This one offers X, Y, Z and Magnitude as long as it does not know the
 * array, and no name at all, which is what the only component of a scalar is called. What other components are called,
 * as those of tensors, cannot be known: their numbers are accepted.
 *
 * The magnitude has the number of components for its number, as in vtkSMNumberOfComponentsDomain, or the
 * property's own value, if that is larger: it was given for the magnitude of an array not known yet, or of another one.
 */
#ifndef vtkSMComponentDomain_h
#define vtkSMComponentDomain_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkSMNumberOfComponentsDomain.h"

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkSMComponentDomain
  : public vtkSMNumberOfComponentsDomain
{
public:
  static vtkSMComponentDomain* New();
  vtkTypeMacro(vtkSMComponentDomain, vtkSMNumberOfComponentsDomain);

  /**
   * Lists the components of the chosen array, or those that arrays usually have.
   */
  void Update(vtkSMProperty* property) override;

protected:
  vtkSMComponentDomain();
  ~vtkSMComponentDomain() override;

private:
  vtkSMComponentDomain(const vtkSMComponentDomain&) = delete;
  void operator=(const vtkSMComponentDomain&) = delete;

  void OfferUsualNames();
  void NumberMagnitudeAsChosen();
};

#endif
