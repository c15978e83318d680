/**
 * @class vtkSMIsovalueDomain
 * @brief the range of the chosen array, with a default that a few odd values do not spoil
 *
 * vtkSMArrayRangeDomain's default is the middle of the whole range, which one bad corner of a simulation
 * moves to where there is nothing to see. Here it is the middle of what remains without the lowest and the
 * highest hundredth of the nodal values, rounded to three digits of their range. Where that is 0 and values of both
 * signs exist, or values are alike on both sides of it and crowded there, a twentieth of the range is added: there
 * symmetric fields often have a saddle. Where the surface of that value is tiny beside others, as in the notch of a bar,
 * one of a value beside it is taken.
 *
 * Of a field made of derivatives, and of a formula, the values in the middles of cells count in place of nodal values. Of the Q criterion
 * the default is a high quantile: its positive values are what is looked for.
 *
 * Where another array, component, quantity or formula is chosen, an isovalue that is still the default of the last choice becomes the
 * default of the new one. In the panel, before Apply, this is the unchecked value.
 */
#ifndef vtkSMIsovalueDomain_h
#define vtkSMIsovalueDomain_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkSMArrayRangeDomain.h"

#include <string> // for the chosen array
#include <vector> // for the default isovalue

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkSMIsovalueDomain : public vtkSMArrayRangeDomain
{
public:
  static vtkSMIsovalueDomain* New();
  vtkTypeMacro(vtkSMIsovalueDomain, vtkSMArrayRangeDomain);

  /**
   * Sets the property to the default; 1 if there is one.
   */
  int SetDefaultValues(vtkSMProperty* property, bool useUnchecked) override;

  /**
   * Finds the range, and another default where another array or component is chosen and the isovalue is untouched.
   */
  void Update(vtkSMProperty* changed) override;

protected:
  vtkSMIsovalueDomain();
  ~vtkSMIsovalueDomain() override;

private:
  vtkSMIsovalueDomain(const vtkSMIsovalueDomain&) = delete;
  void operator=(const vtkSMIsovalueDomain&) = delete;

  /// A default, and the array and component for which it was found; no value: there was none.
  struct Default
  {
    std::string Choice;
    std::vector<double> Isovalue;
  };

  /// Quantity, component and array or formula, as text.
  std::string GetChoice(bool useUnchecked);
  void FollowChoice(bool useUnchecked);
  int SetMiddleOfRange(vtkSMProperty* property, bool useUnchecked);
  int GetQuantity(bool useUnchecked);
  std::string GetExpression(bool useUnchecked);
  double ValueOfLargeSurface(double low, double high, double isovalue);

  template <class Information>
  bool Gather(Information* information);

  /// Of the property's values, and of its unchecked values.
  Default Checked;
  Default Unchecked;
};

#endif
