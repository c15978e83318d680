/**
 * @class vtkSMSpacingDomain
 * @brief a range of spacings, from bounds; nothing for an input which was not read yet or has no end
 *
 * The range, which is that of the slider, is 0 to a share of the longest side of the bounds, in XML
 * `mode="scaled_extent"` and `scale_factor`; the default is a tenth of that share.
 *
 * vtkSMBoundsDomain takes the bounds of such an input, which are empty, for real ones and gives a
 * length that means nothing: negative up to ParaView 5.13, 0.01 in 6.1. This one stays empty instead, so
 * that the property keeps the default of its own, with which the filter finds the length when it runs.
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
   * No range where the bounds of the input are not known, or not finite.
   */
  void Update(vtkSMProperty* property) override;

  /**
   * Sets the property to the default; 0, and leaves it alone, where there is no range.
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
