#include "Elements/KernelAccess.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace hop::testing
{
namespace
{

TEST(KernelAccess, EveryDomainHasKernelsOfItsOwn)
{
  const kernel::Kernels& kernels = kernel::current();
  EXPECT_EQ(&kernelsOf(Domain::Hexahedron), &kernels.hexahedron);
  EXPECT_EQ(&kernelsOf(Domain::Tetrahedron), &kernels.tetrahedron);
  EXPECT_EQ(&kernelsOf(Domain::Wedge), &kernels.wedge);
}

TEST(KernelAccess, ANumberThatStandsForNoDomainHasNone)
{
  EXPECT_THROW(kernelsOf(static_cast<Domain>(allDomains.size())), std::logic_error);
}

TEST(KernelAccess, KernelsSumTheBasisOfTheirDomain)
{
  Random random(1);
  for (const Domain domain : allDomains)
  {
    SCOPED_TRACE(::testing::PrintToString(domain));
    for (const bool rational : { false, true })
    {
      const ElementCase which{ domain, { 3, 3, 3 } };
      const std::vector<Coefficient> coefficients = randomCoefficients(which, random);
      const std::vector<double> weights(coefficients.size(), 2.0);
      BernsteinForm form = formOf(which, coefficients);
      form.weights = rational ? weights.data() : nullptr;
      const ReferencePoint u = randomPoint(domain, random);
      Jet jet;
      kernelsOf(domain).gradient(plainElement(form), &u.xyz.x, &jet.value.x);

      std::vector<double> basis(coefficients.size());
      evaluateBasis(domain, which.degrees, u, basis.data());
      Coefficient sum(0.0);
      for (std::size_t i = 0; i < basis.size(); ++i)
      {
        sum += basis[i] * coefficients[i];
      }
      // All weights are 2, and the basis functions add up to one.
      EXPECT_LE(glm::distance(jet.value, rational ? 0.5 * sum : sum), 1e-14);
    }
  }
}

TEST(KernelAccess, ThePlainElementIsAView)
{
  const std::vector<Coefficient> coefficients(60, Coefficient(1.0));
  const std::vector<double> weights(60, 1.0);
  const BernsteinForm form{ Domain::Hexahedron, { 4, 2, 3 }, coefficients.data(), weights.data() };
  const kernel::Element element = plainElement(form);
  EXPECT_EQ(element.degrees[0], 4);
  EXPECT_EQ(element.degrees[1], 2);
  EXPECT_EQ(element.degrees[2], 3);
  EXPECT_EQ(element.coefficients, &coefficients[0].x);
  EXPECT_EQ(element.weights, weights.data());
  EXPECT_EQ(plainElement({ Domain::Wedge, { 1, 1, 1 }, coefficients.data() }).weights, nullptr);
}

} // namespace
} // namespace hop::testing
