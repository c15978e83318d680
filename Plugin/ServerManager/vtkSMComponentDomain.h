/**
 * @class vtkSMComponentDomain
 * @brief the components of an array and its magnitude, by names that are known before the array is
 *
 * vtkSMNumberOfComponentsDomain is empty until the input has run, and refuses the names that Python state files and
 * traces use earlier: `Component = 'Y'`. As long as the array is not known, this domain offers X, Y, Z, Magnitude, and
 * the empty name, which the only component of a scalar has. Names of other components, of tensors for instance, cannot
 * be known; their numbers are accepted.
 *
 * The number of the magnitude is the number of components, as in vtkSMNumberOfComponentsDomain, or the property's own
 * value, if this is larger: it is the default, or was chosen as the magnitude of an array not known yet, or of another
 * array. So is the number of a scalar's only component: a vector that is chosen afterwards starts at its magnitude.
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
   * Lists the components of the chosen array, or the usual components where there is no array.
   */
  void Update(vtkSMProperty* property) override;

protected:
  vtkSMComponentDomain();
  ~vtkSMComponentDomain() override;

private:
  vtkSMComponentDomain(const vtkSMComponentDomain&) = delete;
  void operator=(const vtkSMComponentDomain&) = delete;

  void OfferUsualNames();
  void NumberLastAsChosen();
};

#endif
