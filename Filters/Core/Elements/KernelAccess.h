#pragma once

#include "Elements/Bernstein.h"
#include "Kernel/InstructionSet.h"

namespace hop
{

static_assert(MaximumDegree == kernel::MaximumDegree);
static_assert(sizeof(Coefficient) == 4 * sizeof(double), "the kernels read plain x, y, z, f");

/// Kernels for a domain, of the instruction set in use.
inline const kernel::DomainKernels& kernelsOf(Domain domain)
{
  switch (domain)
  {
    case Domain::Tetrahedron:
      return kernel::current().tetrahedron;
    case Domain::Wedge:
      return kernel::current().wedge;
    default:
      return kernel::current().hexahedron;
  }
}

/// An element as the kernels see it.
inline kernel::Element plainElement(const BernsteinForm& form)
{
  const auto [p, q, r] = form.degrees;
  return { { p, q, r }, &form.coefficients->x, form.weights };
}

} // namespace hop
