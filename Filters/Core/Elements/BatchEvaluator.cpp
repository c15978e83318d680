#include "Elements/BatchEvaluator.h"

#include "Elements/KernelAccess.h"

#include <memory>

namespace hop
{
namespace
{

static_assert(sizeof(ReferencePoint) == 3 * sizeof(double), "the kernels read plain coordinates");

/// Bytes: the longest vector of the kernels.
constexpr std::size_t alignment = kernel::MaximumLanes * sizeof(double);

} // namespace

void JetBatch::reset(int size, int quantities)
{
  this->Size = size;
  this->Quantities = quantities;
  this->Stride = (size + kernel::MaximumLanes - 1) / kernel::MaximumLanes *
    std::ptrdiff_t{ kernel::MaximumLanes };
  const std::size_t needed = 4 * quantities * this->Stride + kernel::MaximumLanes;
  if (this->Memory.size() < needed)
  {
    this->Memory.resize(needed);
  }
  void* start = this->Memory.data();
  std::size_t space = this->Memory.size() * sizeof(double);
  this->Rows = static_cast<double*>(std::align(alignment, alignment, start, space));
}

Jet JetBatch::jet(int point) const
{
  const auto gather = [&](int quantity)
  {
    return Coefficient(this->row(quantity, 0)[point], this->row(quantity, 1)[point],
      this->row(quantity, 2)[point], this->row(quantity, 3)[point]);
  };
  Jet result;
  result.value = gather(quantity::value);
  for (int a = 0; a < 3; ++a)
  {
    result.first[a] = gather(quantity::first + a);
  }
  for (int i = 0; i < 6 && this->hasHessians(); ++i)
  {
    result.second[i] = gather(quantity::second + i);
  }
  return result;
}

void evaluateGradients(
  const BernsteinForm& form, const ReferencePoint* points, int count, JetBatch& jets)
{
  jets.reset(count, quantity::countOfGradients);
  if (count > 0)
  {
    kernelsOf(form.domain)
      .gradients(plainElement(form), &points->xyz.x, count, jets.Rows, jets.Stride);
  }
}

void evaluateHessians(
  const BernsteinForm& form, const ReferencePoint* points, int count, JetBatch& jets)
{
  jets.reset(count, quantity::countOfHessians);
  if (count > 0)
  {
    kernelsOf(form.domain)
      .hessians(plainElement(form), &points->xyz.x, count, jets.Rows, jets.Stride);
  }
}

} // namespace hop
