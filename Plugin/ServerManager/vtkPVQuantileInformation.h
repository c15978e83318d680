/**
 * @class vtkPVQuantileInformation
 * @brief quantiles of a point array, gathered where the values are
 *
 * The value below which a given share of an array's finite values lies: of all blocks, on whatever ranks of
 * whatever server they are. Each rank hands over at most 1,001 of its values, evenly spaced by rank in
 * order, so that little travels, and looks at every n-th only if there are more than a million. On one rank
 * quantiles of shares that are thousandths are exact up to there; on several they are off by less than a
 * thousandth of a rank's values.
 */
#ifndef vtkPVQuantileInformation_h
#define vtkPVQuantileInformation_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkPVInformation.h"

#include <string>  // for the array's name
#include <utility> // for values with weights
#include <vector>  // for the values

class vtkDataArray;

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkPVQuantileInformation : public vtkPVInformation
{
public:
  static vtkPVQuantileInformation* New();
  vtkTypeMacro(vtkPVQuantileInformation, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What to look at: an output port of the source, a point array, and its component, or one past the last
   * for the magnitude. Of an array with one component that one is taken, whatever is asked for.
   */
  vtkSetMacro(Port, int);
  vtkSetMacro(ArrayName, std::string);
  vtkSetMacro(Component, int);
  ///@}

  /**
   * Whether there are any finite values.
   */
  bool HasValues() const { return !this->Samples.empty(); }

  /**
   * The value below which that share of all values lies, 0 to 1. There must be values.
   */
  double GetQuantile(double share);

  /**
   * Takes its values from what a vtkAlgorithm has made.
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

  void AddValues(vtkDataArray* array, vtkIdType step, std::vector<double>& values) const;

  int Port = 0;
  std::string ArrayName;
  int Component = 0;
  /// A value, and for how many it stands.
  std::vector<std::pair<double, double>> Samples;
};

#endif
