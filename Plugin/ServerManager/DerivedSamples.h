#pragma once

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataSet;

namespace hop
{

/// Values of a field made of derivatives in the middles of cells, by VTK's own cells: good enough to choose an isovalue
/// by. Of a data set with many cells every n-th is looked at.
/// \param component of the array; its number of components, or more, for all of them
/// \param quantity one of vtkHighOrderParticleIsosurface::QuantityType
/// \param step every how many cells one is looked at
/// \return finite values only; none where the quantity needs a vector and the array is none
std::vector<double> sampleDerived(
  vtkDataSet* data, vtkDataArray* array, int component, int quantity, long long step);

/// The same of a formula of the data set's point arrays, see FieldExpression.
/// \return finite values only; none where the text is no formula of these arrays
std::vector<double> sampleExpression(vtkDataSet* data, const std::string& text, long long step);

} // namespace hop
