/**
 * @class vtkPVQuantileInformation
 * @brief quantiles of a point array, gathered where the values are
 *
 * A quantile is the value below which a given share of an array's finite values lies, over all blocks on all ranks of
 * the server. Each MPI rank sends at most 1,001 of its values, evenly spaced in the sorted list, so that little
 * travels. Of more than a million values a rank looks at every n-th only. With one rank and up to a million values,
 * quantiles of shares that are thousandths are exact; with several ranks they are off by less than a thousandth of a
 * rank's values.
 *
 * Of a field made of derivatives, or a formula, values in the middles of cells are looked at instead of nodal values, of a few
 * thousand cells a rank.
 *
 * Particles stand closer where the surface bends, so that half of them may cover a twentieth of it. With an array of
 * spacings a quantile is the value below which a given share of the surface's *area* lies.
 */
#ifndef vtkPVQuantileInformation_h
#define vtkPVQuantileInformation_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkPVInformation.h"

#include <string>  // for the array's name
#include <utility> // for values with weights
#include <vector>  // for the values

class vtkDataArray;
class vtkDataObject;

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkPVQuantileInformation : public vtkPVInformation
{
public:
  static vtkPVQuantileInformation* New();
  vtkTypeMacro(vtkPVQuantileInformation, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Which values are looked at: an output port of the source, a point array, and a component; the number of components,
   * or more, stands for the magnitude. For an array with one component, Component is ignored.
   */
  vtkSetMacro(Port, int);
  vtkSetMacro(ArrayName, std::string);
  vtkSetMacro(Component, int);
  ///@}

  ///@{
  /**
   * One of vtkHighOrderParticleIsosurface::QuantityType; 0, the default, is the array itself.
   */
  vtkSetMacro(Quantity, int);
  ///@}

  ///@{
  /**
   * The formula, where that is the quantity: of all point arrays, whatever the array is.
   */
  vtkSetMacro(Expression, std::string);
  ///@}

  /**
   * A point array whose square is proportional to the area that a point stands for, as the distance to its neighbours
   * is; empty by default: all points count alike, as they do in blocks without such an array. Points where it is not a
   * positive number do not count.
   */
  vtkSetMacro(SpacingArrayName, std::string);

  /**
   * Whether there are any finite values.
   */
  bool HasValues() const { return !this->Samples.empty(); }

  /**
   * The value below which a share of all values, or of their area, lies; the share is 0 to 1. There must be values.
   */
  double GetQuantile(double share);

  /**
   * Takes the values from the output of a vtkAlgorithm.
   */
  void CopyFromObject(vtkObject* algorithm) override;
  void AddInformation(vtkPVInformation* other) override;
  void CopyToStream(vtkClientServerStream* stream) override;
  void CopyFromStream(const vtkClientServerStream* stream) override;
  void CopyParametersToStream(vtkMultiProcessStream& stream) override;
  void CopyParametersFromStream(vtkMultiProcessStream& stream) override;

protected:
  vtkPVQuantileInformation();
  ~vtkPVQuantileInformation() override;

private:
  vtkPVQuantileInformation(const vtkPVQuantileInformation&) = delete;
  void operator=(const vtkPVQuantileInformation&) = delete;

  void AddValues(vtkDataArray* array, vtkDataArray* spacings, vtkIdType step);
  void AddDerived(vtkDataObject* data);
  void ThinOut();

  int Port = 0;
  std::string ArrayName;
  std::string SpacingArrayName;
  int Component = 0;
  int Quantity = 0;
  std::string Expression;
  /// Values, each with the number of values, or the area, for which it stands.
  std::vector<std::pair<double, double>> Samples;
};

#endif
