/**
 * @class vtkSMIsovalueDomain
 * @brief the range of the chosen array, with a default that a few odd values do not spoil
 *
 * vtkSMArrayRangeDomain's default is the middle of the whole range, which one bad corner of a simulation
 * moves to where there is nothing to see. Here it is the middle of what remains without the lowest and the
 * highest hundredth of the nodal values. It needs the values at hand: where they are on another machine or
 * on several ranks the default is the middle of the range as ever.
 */
#ifndef vtkSMIsovalueDomain_h
#define vtkSMIsovalueDomain_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkSMArrayRangeDomain.h"

#include <vector> // for the values

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

  std::vector<double> NodalValues();
};

#endif
