#include "Conversion/GatherValues.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArrayAccessor.h"

namespace hop
{

namespace
{

struct Gather
{
  const vtkIdType* ids;
  vtkIdType count;
  int component;
  double* result;
  int stride;

  template <class Array>
  void operator()(Array* array) const
  {
    const vtkDataArrayAccessor<Array> values(array);
    for (vtkIdType i = 0; i < this->count; ++i)
    {
      this->result[i * this->stride] =
        static_cast<double>(values.Get(this->ids[i], this->component));
    }
  }
};

} // namespace

void gatherComponent(vtkDataArray* array, const vtkIdType* ids, vtkIdType count, int component,
  double* result, int stride)
{
  const Gather gather{ ids, count, component, result, stride };
  if (!vtkArrayDispatch::Dispatch::Execute(array, gather))
  {
    gather(array); // not one of VTK's own kinds of arrays
  }
}

} // namespace hop
