#pragma once

#include "Elements/Bernstein.h"

#include <cstddef>
#include <vector>

namespace hop
{

/// Quantities of a jet in the order of Jet's members: first + a is d/du_a, second + i the i-th of
/// uu, uv, uw, vv, vw, ww.
namespace quantity
{
constexpr int value = 0;
constexpr int first = 1;
constexpr int second = 4;
} // namespace quantity

/// Jets of many points as a structure of arrays: one row of doubles, a point each, for every
/// quantity and component. To be reused: memory only grows.
class JetBatch
{
public:
  JetBatch() = default;
  JetBatch(const JetBatch&) = delete;
  JetBatch& operator=(const JetBatch&) = delete;
  JetBatch(JetBatch&&) = default;
  JetBatch& operator=(JetBatch&&) = default;

  /// Number of points.
  int size() const { return this->Size; }

  /// True if there are second derivatives.
  bool hasHessians() const { return this->Quantities == 10; }

  /// size() values of a component (0: x, 1: y, 2: z, 3: f) of a quantity, aligned to 64 bytes. Up
  /// to the next multiple of 8 the row goes on with copies of the last point's value or with
  /// leftovers, so that whole vectors can be read.
  const double* row(int quantity, int component) const
  {
    return this->Rows + (4 * quantity + component) * this->Stride;
  }

  /// Everything about one point; second derivatives are zero if there are none.
  Jet jet(int point) const;

private:
  friend void evaluateGradients(const BernsteinForm&, const ReferencePoint*, int, JetBatch&);
  friend void evaluateHessians(const BernsteinForm&, const ReferencePoint*, int, JetBatch&);

  void reset(int size, int quantities);

  std::vector<double> Memory;
  double* Rows = nullptr;
  std::ptrdiff_t Stride = 0;
  int Size = 0;
  int Quantities = 0;
};

/// Values and first derivatives at `count` points of one element, several points at a time in the
/// registers of the processor (see InstructionSet.h). What a point gets does not depend on the
/// points beside it, their number or its place among them, bit for bit; against evaluateGradient it
/// may differ by rounding. Threads may run it at once, each with a batch of its own.
void evaluateGradients(
  const BernsteinForm& form, const ReferencePoint* points, int count, JetBatch& jets);

/// Values, first and second derivatives, likewise.
void evaluateHessians(
  const BernsteinForm& form, const ReferencePoint* points, int count, JetBatch& jets);

} // namespace hop
