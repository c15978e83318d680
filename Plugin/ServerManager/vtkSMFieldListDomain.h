/**
 * @class vtkSMFieldListDomain
 * @brief a list of arrays whose default is a field, if there is one
 *
 * vtkSMArrayListDomain chooses the active scalars or the first array by name, which may have no isosurface worth a
 * look. As long as there is another point array, this domain does not choose arrays that are constant, hold integers
 * (ids, ranks, ghost levels) or the weights of rational cells, deal.II's `subdomain`, and arrays with names of the
 * filter's own output arrays. All arrays stay in the list. There is no default for an input without an unstructured
 * grid.
 */
#ifndef vtkSMFieldListDomain_h
#define vtkSMFieldListDomain_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkSMArrayListDomain.h"

class vtkPVDataInformation;

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkSMFieldListDomain : public vtkSMArrayListDomain
{
public:
  static vtkSMFieldListDomain* New();
  vtkTypeMacro(vtkSMFieldListDomain, vtkSMArrayListDomain);

  /**
   * Sets the property to the default; 1 if there is one.
   */
  int SetDefaultValues(vtkSMProperty* property, bool useUnchecked) override;

protected:
  vtkSMFieldListDomain();
  ~vtkSMFieldListDomain() override;

private:
  vtkSMFieldListDomain(const vtkSMFieldListDomain&) = delete;
  void operator=(const vtkSMFieldListDomain&) = delete;

  vtkPVDataInformation* GetInputInformation();
};

#endif
