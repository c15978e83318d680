/**
 * @class vtkHighOrderParticleSlice
 * @brief slices of high-order finite elements as evenly spread, oriented particles
 *
 * A slice is an isosurface of the distance from a plane, or from the center of a sphere or the axis of a cylinder. The
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
   * Along what to slice: a vtkPlane, vtkSphere or vtkCylinder, with a linear transform or none. None by default.
   *
   * Slices are made at the values given by SetValue: offsets from the plane along its normal, or to be added to the
   * radius; world units, or those of the space to which the function's transform leads. One value, 0, by default.
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

private:
  vtkHighOrderParticleSlice(const vtkHighOrderParticleSlice&) = delete;
  void operator=(const vtkHighOrderParticleSlice&) = delete;

  vtkSmartPointer<vtkImplicitFunction> CutFunction;
};

#endif
