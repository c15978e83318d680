#include "ElementCases.h"

#include "TestMeshes.h"

#include <ostream>

namespace hop
{

std::ostream& operator<<(std::ostream& out, Domain domain)
{
  switch (domain)
  {
    case Domain::Hexahedron:
      return out << "Hexahedron";
    case Domain::Tetrahedron:
      return out << "Tetrahedron";
    case Domain::Wedge:
      return out << "Wedge";
  }
  unknownDomain();
}

} // namespace hop

namespace hop::testing
{

std::ostream& operator<<(std::ostream& out, const ElementCase& which)
{
  const auto [p, q, r] = which.degrees;
  return out << which.domain << " of degrees " << p << ", " << q << ", " << r;
}

const std::vector<ElementCase>& allElementCases()
{
  static const std::vector<ElementCase> all = []
  {
    std::vector<ElementCase> cases;
    for (const Domain domain : allDomains)
    {
      for (int p = 1; p <= maximumInputDegree(Domain::Tetrahedron); ++p)
      {
        cases.push_back({ domain, { p, p, p } });
      }
    }
    for (const Degrees& degrees : { Degrees{ 4, 2, 3 }, { 1, 5, 2 }, { 2, 1, 10 }, { 15, 1, 12 } })
    {
      cases.push_back({ Domain::Hexahedron, degrees });
    }
    for (const Degrees& degrees : { Degrees{ 4, 4, 1 }, { 1, 1, 5 }, { 2, 2, 3 }, { 10, 10, 2 } })
    {
      cases.push_back({ Domain::Wedge, degrees });
    }
    return cases;
  }();
  return all;
}

double randomNumber(Random& random)
{
  return 2.0 * random.uniform() - 1.0;
}

glm::dvec3 randomVector(Random& random)
{
  const double x = randomNumber(random);
  const double y = randomNumber(random);
  return { x, y, randomNumber(random) };
}

std::vector<Coefficient> randomCoefficients(const ElementCase& which, Random& random)
{
  std::vector<Coefficient> coefficients(coefficientCount(which.domain, which.degrees));
  for (Coefficient& c : coefficients)
  {
    c = Coefficient(randomVector(random), 0.0);
    c.w = randomNumber(random);
  }
  return coefficients;
}

ReferencePoint randomPoint(Domain domain, Random& random)
{
  return insidePoint(domain, 0.5 * (randomVector(random) + 1.0));
}

BernsteinForm formOf(const ElementCase& which, const std::vector<Coefficient>& coefficients)
{
  return { which.domain, which.degrees, coefficients.data() };
}

} // namespace hop::testing
