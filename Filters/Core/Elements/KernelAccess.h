#pragma once

#include "Elements/Bernstein.h"
#include "Kernel/InstructionSet.h"

namespace hop
{

static_assert(MaximumDegree == kernel::MaximumDegree);
static_assert(sizeof(Coefficient) == 4 * sizeof(double), "the kernels read plain x, y, z, f");

/// The evaluation kernels of a domain, compiled for the instruction set in use.
inline const kernel::DomainKernels& kernelsOf(Domain domain)
{
  switch (domain)
  {
    case Domain::Hexahedron:
      return kernel::current().hexahedron;
    case Domain::Tetrahedron:
      return kernel::current().tetrahedron;
    case Domain::Wedge:
      return kernel::current().wedge;
  }
  unknownDomain();
}

/// An element as the kernels see it.
inline kernel::Element plainElement(const BernsteinForm& form)
{
  const auto [p, q, r] = form.degrees;
  return { { p, q, r }, &form.coefficients->x, form.weights };
}

} // namespace hop
