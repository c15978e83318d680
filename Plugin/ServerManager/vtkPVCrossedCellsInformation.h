/**
 * @class vtkPVCrossedCellsInformation
 * @brief how large isosurfaces are, roughly, gathered where the values are
 *
 * The size of an isosurface is estimated by the cells whose nodal values lie on both sides of the isovalue: each adds the
 * square of its bounding box's diagonal, over all blocks on all ranks of the server. Cells are larger than what they hold
 * of the surface, so that sizes tell a hundred times as much from a little, not twice as much. Of many cells a rank looks
 * at every n-th only.
 */
#ifndef vtkPVCrossedCellsInformation_h
#define vtkPVCrossedCellsInformation_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkPVInformation.h"

#include <string> // for the array's name
#include <vector> // for isovalues and sizes

class vtkDataArray;
class vtkDataSet;

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkPVCrossedCellsInformation
  : public vtkPVInformation
{
public:
  static vtkPVCrossedCellsInformation* New();
  vtkTypeMacro(vtkPVCrossedCellsInformation, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Which values are looked at, see vtkPVQuantileInformation.
   */
  vtkSetMacro(Port, int);
  vtkSetMacro(ArrayName, std::string);
  vtkSetMacro(Component, int);
  ///@}

  void SetIsovalues(const std::vector<double>& isovalues) { this->Isovalues = isovalues; }

  /**
   * Sizes of their isosurfaces, world units squared; empty before they are gathered.
   */
  const std::vector<double>& GetSizes() const { return this->Sizes; }

  /**
   * Looks at the output of a vtkAlgorithm.
   */
  void CopyFromObject(vtkObject* algorithm) override;
  void AddInformation(vtkPVInformation* other) override;
  void CopyToStream(vtkClientServerStream* stream) override;
  void CopyFromStream(const vtkClientServerStream* stream) override;
  void CopyParametersToStream(vtkMultiProcessStream& stream) override;
  void CopyParametersFromStream(vtkMultiProcessStream& stream) override;

protected:
  vtkPVCrossedCellsInformation();
  ~vtkPVCrossedCellsInformation() override;

private:
  vtkPVCrossedCellsInformation(const vtkPVCrossedCellsInformation&) = delete;
  void operator=(const vtkPVCrossedCellsInformation&) = delete;

  void AddCells(vtkDataSet* block, vtkDataArray* array);

  int Port = 0;
  std::string ArrayName;
  int Component = 0;
  std::vector<double> Isovalues;
  std::vector<double> Sizes;
};

#endif
