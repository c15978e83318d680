#pragma once

#include "ElementCases.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <vector>

class vtkNonLinearCell;

namespace hop::testing
{

/// VTK's Lagrange cell of so many nodes, the same degree along every axis: it knows where they stand.
vtkSmartPointer<vtkNonLinearCell> makeLagrangeCell(Domain domain, int nodeCount);

/// VTK's Lagrange cell of the same kind as an element, slightly warped, with random nodal values.
class VtkCell
{
public:
  explicit VtkCell(const ElementCase& which);

  /// Position, by EvaluateLocation, and gradient of the field, by Derivatives.
  /// \return something that depends on both
  double evaluate(const ReferencePoint& u);

private:
  vtkSmartPointer<vtkNonLinearCell> Cell;
  std::vector<double> Values;
  std::vector<double> Weights;
};

} // namespace hop::testing
