/**
 * @class vtkSMSpacingDomain
 * @brief a range of spacings that follows from the input's bounds; empty where the bounds are unknown or not finite
 *
 * The range of the slider is 0 to a share of the longest side of the bounds, in XML `mode="scaled_extent"` and
 * `scale_factor`. The default is a tenth of the largest spacing.
 *
 * Where the input was not read yet, vtkSMBoundsDomain computes with empty bounds and gives a length without meaning:
 * negative up to ParaView 5.13, 0.01 in 6.1. This domain stays empty instead. The property then keeps its own default,
 * with which the filter finds the spacing when it runs.
 */
#ifndef vtkSMSpacingDomain_h
#define vtkSMSpacingDomain_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkSMBoundsDomain.h"

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkSMSpacingDomain : public vtkSMBoundsDomain
{
public:
  static vtkSMSpacingDomain* New();
  vtkTypeMacro(vtkSMSpacingDomain, vtkSMBoundsDomain);

  /**
   * Sets the range; there is none where the bounds of the input are not known, or not finite.
   */
  void Update(vtkSMProperty* property) override;

  /**
   * Sets the property to the default and returns 1; where there is no range, leaves it alone and returns 0.
   */
  int SetDefaultValues(vtkSMProperty* property, bool useUnchecked) override;

protected:
  vtkSMSpacingDomain();
  ~vtkSMSpacingDomain() override;

private:
  vtkSMSpacingDomain(const vtkSMSpacingDomain&) = delete;
  void operator=(const vtkSMSpacingDomain&) = delete;
};

#endif
