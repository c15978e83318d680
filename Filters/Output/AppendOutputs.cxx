#include "Output/AppendOutputs.h"

#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace hop
{
namespace
{

/// Adds the counts of one leaf, arrays of one id, to those of another.
void addCounts(vtkFieldData* from, vtkFieldData* to)
{
  for (int a = 0; a < to->GetNumberOfArrays(); ++a)
  {
    auto* sum = vtkIdTypeArray::SafeDownCast(to->GetAbstractArray(a));
    auto* more =
      sum ? vtkIdTypeArray::SafeDownCast(from->GetAbstractArray(sum->GetName())) : nullptr;
    if (more && more->GetNumberOfValues() == 1 && sum->GetNumberOfValues() == 1)
    {
      sum->SetValue(0, sum->GetValue(0) + more->GetValue(0));
    }
  }
}

template <class Append>
vtkSmartPointer<vtkPointSet> appendedBy(const std::vector<vtkPointSet*>& leaves)
{
  const auto append = vtkSmartPointer<Append>::New();
  for (vtkPointSet* leaf : leaves)
  {
    append->AddInputDataObject(leaf);
  }
  append->Update();
  return vtkPointSet::SafeDownCast(append->GetOutputDataObject(0));
}

vtkSmartPointer<vtkPointSet> appended(const std::vector<vtkPointSet*>& leaves)
{
  vtkSmartPointer<vtkPointSet> result = vtkPolyData::SafeDownCast(leaves[0])
    ? appendedBy<vtkAppendPolyData>(leaves)
    : appendedBy<vtkAppendFilter>(leaves);
  result->GetFieldData()->DeepCopy(leaves[0]->GetFieldData());
  for (std::size_t n = 1; n < leaves.size(); ++n)
  {
    addCounts(leaves[n]->GetFieldData(), result->GetFieldData());
  }
  return result;
}

} // namespace

void appendOutputs(const std::vector<vtkSmartPointer<vtkDataObject>>& parts, vtkDataObject* output)
{
  output->ShallowCopy(parts[0]);
  auto* composite = vtkCompositeDataSet::SafeDownCast(output);
  if (!composite)
  {
    std::vector<vtkPointSet*> leaves(parts.size());
    std::transform(parts.begin(), parts.end(), leaves.begin(),
      [](vtkDataObject* part) { return vtkPointSet::SafeDownCast(part); });
    output->ShallowCopy(appended(leaves));
    return;
  }
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(vtkCompositeDataSet::SafeDownCast(parts[0])->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    std::vector<vtkPointSet*> leaves(parts.size());
    std::transform(parts.begin(), parts.end(), leaves.begin(),
      [&](vtkDataObject* part) {
        return vtkPointSet::SafeDownCast(vtkCompositeDataSet::SafeDownCast(part)->GetDataSet(leaf));
      });
    composite->SetDataSet(leaf, appended(leaves));
  }
}

} // namespace hop
