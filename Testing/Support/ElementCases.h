#pragma once

#include "Elements/Bernstein.h"
#include "Support/Random.h"

#include <iosfwd>

namespace hop
{

/// Names of domains in messages and names of tests.
std::ostream& operator<<(std::ostream& out, Domain domain);

} // namespace hop

namespace hop::testing
{

/// A kind of element, over which tests of the numerics run.
struct ElementCase
{
  Domain domain = Domain::Hexahedron;
  Degrees degrees{ 1, 1, 1 };
};

std::ostream& operator<<(std::ostream& out, const ElementCase& which);

/// Every domain with degrees 1 to 10, and hexahedra and wedges whose degrees differ from
/// axis to axis.
const std::vector<ElementCase>& allElementCases();

/// Uniform in [-1,1).
double randomNumber(Random& random);
glm::dvec3 randomVector(Random& random);

/// Coefficients of a polynomial without any symmetry, in [-1,1).
std::vector<Coefficient> randomCoefficients(const ElementCase& which, Random& random);

/// A point inside the domain.
ReferencePoint randomPoint(Domain domain, Random& random);

BernsteinForm formOf(const ElementCase& which, const std::vector<Coefficient>& coefficients);

} // namespace hop::testing
