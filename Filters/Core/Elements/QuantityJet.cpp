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

glm::dvec3 curlOf(const glm::dmat3& g)
{
  return { g[1][2] - g[2][1], g[2][0] - g[0][2], g[0][1] - g[1][0] };
}

/// A symmetric matrix of f(k, l).
template <class Entry>
glm::dmat3 symmetric(const Entry& f)
{
  glm::dmat3 result;
  for (const auto& [k, l] : SecondDerivatives)
  {
    result[k][l] = result[l][k] = f(k, l);
  }
  return result;
}

/// The middle eigenvalue of A = (G G + (G G)^T) / 2 by perturbation: l' = v A' v and
/// l'' = v A'' v + 2 sum (v A' v_m)^2 / (l - l_m) over the other eigenvectors.
QuantityJet lambdaTwoJet(const glm::dmat3& g, const std::array<glm::dmat3, 3>& changes)
{
  // Gaps of eigenvalues that are rounding errors, as a share of the largest one. The curvature of the crease itself is
  // left out there.
  constexpr double noGap = 64.0 * std::numeric_limits<double>::epsilon();
  const glm::dmat3 square = g * g;
  const Eigensystem system = eigensystemOf(0.5 * (square + glm::transpose(square)));
  const glm::dvec3& v = system.vectors[1];
  const glm::dvec3 right = g * v;
  const glm::dvec3 left = v * g;
  QuantityJet result;
  result.value = system.values[1];
  result.slope = glm::outerProduct(v, right) + glm::outerProduct(left, v);
  std::array<glm::dvec3, 3> rights;
  std::array<glm::dvec3, 3> lefts;
  std::array<glm::dvec3, 3> pulls;
  for (int k = 0; k < 3; ++k)
  {
    rights[k] = changes[k] * v;
    lefts[k] = v * changes[k];
    const glm::dvec3 twiceChange =
      changes[k] * right + g * rights[k] + left * changes[k] + lefts[k] * g;
    pulls[k] = 0.5 * (twiceChange * system.vectors);
  }
  const double largest = std::max(std::abs(system.values[0]), std::abs(system.values[2]));
  glm::dvec3 twiceInverse(0.0);
  for (const int m : { 0, 2 })
  {
    const double gap = system.values[1] - system.values[m];
    twiceInverse[m] = std::abs(gap) > noGap * largest ? 2.0 / gap : 0.0;
  }
  result.bend = symmetric(
    [&](int k, int l)
    {
      return glm::dot(lefts[k], rights[l]) + glm::dot(lefts[l], rights[k]) +
        glm::dot(twiceInverse, pulls[k] * pulls[l]);
    });
  return result;
}

} // namespace

QuantityJet quantityJet(
  Quantity quantity, const glm::dmat3& gradient, const std::array<glm::dmat3, 3>& changes)
{
  const glm::dmat3& g = gradient;
  switch (quantity)
  {
    case Quantity::Value:
    case Quantity::Expression:
      break;
    case Quantity::GradientMagnitude:
      return { sumOfProducts(g, g), 2.0 * g,
        symmetric([&](int k, int l) { return 2.0 * sumOfProducts(changes[k], changes[l]); }) };
    case Quantity::Divergence:
      return { trace(g), glm::dmat3(1.0), glm::dmat3(0.0) };
    case Quantity::VorticityMagnitude:
      return { glm::dot(curlOf(g), curlOf(g)), 2.0 * (g - glm::transpose(g)),
        symmetric(
          [&](int k, int l) { return 2.0 * glm::dot(curlOf(changes[k]), curlOf(changes[l])); }) };
    case Quantity::QCriterion:
      return { -0.5 * sumOfProducts(g, glm::transpose(g)), -glm::transpose(g),
        symmetric(
          [&](int k, int l) { return -sumOfProducts(changes[k], glm::transpose(changes[l])); }) };
    case Quantity::Lambda2:
      return lambdaTwoJet(g, changes);
  }
  return {};
}

} // namespace hop
