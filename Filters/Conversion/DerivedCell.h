#pragma once

#include "Elements/DerivedField.h"
#include "Elements/ExactField.h"
#include "Elements/JacobianTest.h"
#include "Elements/ReferencePart.h"

namespace hop
{

/// A cell, or a part of one, with a derived field, before the unit of the run is known.
struct DerivedCell
{
  JacobianSign sign = JacobianSign::NotFinite;
  /// Its coordinates are in the unit of the run. Empty where the sign is no reason to keep the cell.
  DerivedElement element;
  /// The field times 2^exponent is the quantity, or its square where that is derived.
  int exponent = 0;
  /// The part of the cell.
  ReferencePart place;
  /// Parts of the cell that can hold surface, this one among them.
  std::size_t partsOfCell = 1;
  /// The field itself, point by point, if it stands in for the element's wherever particles are; else without coefficients.
  ExactSource exact;
  /// Whether the element holds the field to rounding, or to the tolerance of an interpolation.
  bool isResolved = true;
};

} // namespace hop
