/**
 * @class vtkHighOrderParticleSlice
 * @brief slices of high-order finite elements as evenly spread, oriented particles
 *
 * A slice is an isosurface of the distance from a plane, or from the center of a sphere or the axis of a cylinder; along
 * a box six such planes, each cut to its face. The
 * distance is a polynomial, or a rational function, of each curved element like its coordinates: particles lie on the
 * slice and in their cells to rounding, and carry all point arrays, evaluated by the cells' own polynomials. Input, output, properties
 * and arrays are those of vtkHighOrderParticleIsosurface but for the choice of an array, which is not read; `Isovalue`
 * is the offset from the plane, or the distance from the center or axis, and `Normals` point to where it is smaller. The
 * active scalars of the input stay active.
 *
 * ParaView's Slice cuts the linear pieces into which it divides high-order cells.
 */
#ifndef vtkHighOrderParticleSlice_h
#define vtkHighOrderParticleSlice_h

#include "vtkHighOrderParticleFiltersModule.h" // for the export macro
#include "vtkHighOrderParticleIsosurface.h"
#include "vtkSmartPointer.h" // for the function

#include <memory> // for the runs of a box

class vtkImplicitFunction;

class VTKHIGHORDERPARTICLEFILTERS_EXPORT vtkHighOrderParticleSlice
  : public vtkHighOrderParticleIsosurface
{
public:
  static vtkHighOrderParticleSlice* New();
  vtkTypeMacro(vtkHighOrderParticleSlice, vtkHighOrderParticleIsosurface);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Along what to slice: a vtkPlane, vtkSphere, vtkCylinder or vtkBox, with a linear transform or none. None by default.
   *
   * Slices are made at the values given by SetValue: offsets from the plane along its normal, or to be added to the
   * radius, or by which the faces of the box move outwards; world units, or those of the space to which the function's transform leads. One value, 0, by default.
   */
  void SetCutFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetCutFunction();
  ///@}

  /**
   * Also counts changes of the function.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkHighOrderParticleSlice();
  ~vtkHighOrderParticleSlice() override;

  std::vector<double> FindIsovalues() override;
  std::vector<hop::UserMessage> CheckIsovalues(const hop::GatheredBlocks& gathered) override;
  hop::CheckedBlocks FindScalars(const hop::GatheredBlocks& gathered) override;
  void AddField(hop::ByteHash& hash) override;
  hop::RunProperties PropertiesOfRun() override;
  void Run(vtkDataObject* input, vtkDataObject* output) override;
  void Tell(const std::vector<hop::UserMessage>& messages) override;
  void ReviewSurfaces(const hop::InputBlocks& blocks, const std::vector<double>& isovalues,
    const std::vector<std::int64_t>& counts, bool isExplained) override;

private:
  vtkHighOrderParticleSlice(const vtkHighOrderParticleSlice&) = delete;
  void operator=(const vtkHighOrderParticleSlice&) = delete;

  bool TakesBox();
  void RunFaces(vtkDataObject* input, vtkDataObject* output);

  vtkSmartPointer<vtkImplicitFunction> CutFunction;
  /** The runs of a box, one a face, and what they have told; null for other functions. */
  struct BoxRuns;
  std::unique_ptr<BoxRuns> Box;
};

#endif
