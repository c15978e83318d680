#pragma once

#include "Elements/Bernstein.h"

#include <cstddef>
#include <vector>

namespace hop
{

/// Quantities of a jet in the order of Jet's members: first + a is d/du_a, second + i the i-th of
/// uu, uv, uw, vv, vw, ww. Then how many there are without and with second derivatives.
namespace quantity
{
constexpr int value = 0;
constexpr int first = 1;
constexpr int second = 4;
constexpr int countOfGradients = 4;
constexpr int countOfHessians = 10;
} // namespace quantity

/// Jets of many points as a structure of arrays: for every quantity and component one row of doubles, one a point.
/// Worth reusing: its memory only grows.
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
  bool hasHessians() const { return this->Quantities == quantity::countOfHessians; }

  /// size() values of a component (0: x, 1: y, 2: z, 3: f) of a quantity, aligned to the longest vector. Up
  /// to the next multiple of kernel::MaximumLanes the row goes on with copies of the last point's value or with
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
/// registers of the processor (Kernel/InstructionSet.h). A point's jet does not depend on the other points, their
/// number or its place among them, bit for bit; it may differ from that of evaluateGradient() by rounding. Threads may
/// run this at once, each with a batch of its own.
void evaluateGradients(
  const BernsteinForm& form, const ReferencePoint* points, int count, JetBatch& jets);

/// The same with second derivatives.
void evaluateHessians(
  const BernsteinForm& form, const ReferencePoint* points, int count, JetBatch& jets);

} // namespace hop
