/**
 * @class vtkSMIsovalueDomain
 * @brief the range of the chosen array, with a default that a few odd values do not spoil
 *
 * vtkSMArrayRangeDomain's default is the middle of the whole range, which one bad corner of a simulation
 * moves to where there is nothing to see. Here it is the middle of what remains without the lowest and the
 * highest hundredth of the nodal values, wherever they are.
 */
#ifndef vtkSMIsovalueDomain_h
#define vtkSMIsovalueDomain_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkSMArrayRangeDomain.h"

class vtkPVQuantileInformation;

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkSMIsovalueDomain : public vtkSMArrayRangeDomain
{
public:
  static vtkSMIsovalueDomain* New();
  vtkTypeMacro(vtkSMIsovalueDomain, vtkSMArrayRangeDomain);

  /**
   * Sets the property to the default; 1 if there is one.
   */
  int SetDefaultValues(vtkSMProperty* property, bool useUnchecked) override;

protected:
  vtkSMIsovalueDomain();
  ~vtkSMIsovalueDomain() override;

private:
  vtkSMIsovalueDomain(const vtkSMIsovalueDomain&) = delete;
  void operator=(const vtkSMIsovalueDomain&) = delete;

  void LookAtValues(vtkPVQuantileInformation* values);
};

#endif
