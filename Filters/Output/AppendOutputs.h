#pragma once

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataObject;

namespace hop
{

/// Puts outputs of the same input together, leaf by leaf. Point and cell arrays are those that all leaves with points have;
/// of counts in the field data the sums are taken, other field data are those of the first.
/// \param parts of the same kind and structure; at least one
void appendOutputs(const std::vector<vtkSmartPointer<vtkDataObject>>& parts, vtkDataObject* output);

} // namespace hop
