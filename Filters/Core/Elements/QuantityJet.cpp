#include "Elements/QuantityJet.h"

#include "Elements/SymmetricEigenvalues.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{

namespace
{

double trace(const glm::dmat3& a)
{
  return a[0][0] + a[1][1] + a[2][2];
}

/// The sum of a_ij b_ij.
double sumOfProducts(const glm::dmat3& a, const glm::dmat3& b)
{
  return glm::dot(a[0], b[0]) + glm::dot(a[1], b[1]) + glm::dot(a[2], b[2]);
}

glm::dvec3 curlOf(const glm::dmat3& g)
{
  return { g[1][2] - g[2][1], g[2][0] - g[0][2], g[0][1] - g[1][0] };
}

/// f(G), f linear.
template <class Linear>
ScalarJet linearJet(const GradientJet& g, const Linear& f)
{
  ScalarJet result;
  result.value = f(g.value);
  for (int k = 0; k < 3; ++k)
  {
    result.gradient[k] = f(g.first[k]);
  }
  for (int i = 0; i < 6; ++i)
  {
    const auto [k, l] = SecondDerivatives[i];
    result.hessian[k][l] = result.hessian[l][k] = f(g.second[i]);
  }
  return result;
}

/// f(G, G), f bilinear and symmetric.
template <class Bilinear>
ScalarJet quadraticJet(const GradientJet& g, const Bilinear& f)
{
  ScalarJet result;
  result.value = f(g.value, g.value);
  for (int k = 0; k < 3; ++k)
  {
    result.gradient[k] = 2.0 * f(g.value, g.first[k]);
  }
  for (int i = 0; i < 6; ++i)
  {
    const auto [k, l] = SecondDerivatives[i];
    result.hessian[k][l] = 2.0 * (f(g.value, g.second[i]) + f(g.first[k], g.first[l]));
    result.hessian[l][k] = result.hessian[k][l];
  }
  return result;
}

/// The middle eigenvalue of A = (G G + (G G)^T) / 2 by perturbation: l' = v A' v and
/// l'' = v A'' v + 2 sum (v A' v_m)^2 / (l - l_m) over the other eigenvectors.
ScalarJet lambdaTwoJet(const GradientJet& g)
{
  // Gaps of eigenvalues that are rounding errors, as a share of the largest one. The curvature of the crease itself is
  // left out there.
  constexpr double noGap = 64.0 * std::numeric_limits<double>::epsilon();
  const glm::dmat3 square = g.value * g.value;
  const Eigensystem system = eigensystemOf(0.5 * (square + glm::transpose(square)));
  const glm::dvec3& v = system.vectors[1];
  const glm::dvec3 right = g.value * v;
  const glm::dvec3 left = v * g.value;
  ScalarJet result;
  result.value = system.values[1];
  std::array<glm::dvec3, 3> rights;
  std::array<glm::dvec3, 3> lefts;
  std::array<glm::dvec3, 3> pulls;
  for (int k = 0; k < 3; ++k)
  {
    rights[k] = g.first[k] * v;
    lefts[k] = v * g.first[k];
    const glm::dvec3 twiceChange =
      g.first[k] * right + g.value * rights[k] + left * g.first[k] + lefts[k] * g.value;
    pulls[k] = 0.5 * (twiceChange * system.vectors);
    result.gradient[k] = pulls[k][1];
  }
  const double largest = std::max(std::abs(system.values[0]), std::abs(system.values[2]));
  for (int i = 0; i < 6; ++i)
  {
    const auto [k, l] = SecondDerivatives[i];
    double second = glm::dot(v * g.second[i], right) + glm::dot(left, g.second[i] * v) +
      glm::dot(lefts[k], rights[l]) + glm::dot(lefts[l], rights[k]);
    for (const int m : { 0, 2 })
    {
      const double gap = system.values[1] - system.values[m];
      second += std::abs(gap) > noGap * largest ? 2.0 * pulls[k][m] * pulls[l][m] / gap : 0.0;
    }
    result.hessian[k][l] = result.hessian[l][k] = second;
  }
  return result;
}

} // namespace

ScalarJet quantityJet(Quantity quantity, const GradientJet& gradient)
{
  switch (quantity)
  {
    case Quantity::Value:
    case Quantity::Expression:
      break;
    case Quantity::GradientMagnitude:
      return quadraticJet(gradient, sumOfProducts);
    case Quantity::Divergence:
      return linearJet(gradient, trace);
    case Quantity::VorticityMagnitude:
      return quadraticJet(gradient,
        [](const glm::dmat3& a, const glm::dmat3& b) { return glm::dot(curlOf(a), curlOf(b)); });
    case Quantity::QCriterion:
      return quadraticJet(gradient,
        [](const glm::dmat3& a, const glm::dmat3& b)
        { return -0.5 * sumOfProducts(a, glm::transpose(b)); });
    case Quantity::Lambda2:
      return lambdaTwoJet(gradient);
  }
  return {};
}

} // namespace hop
