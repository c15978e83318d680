#include "BernsteinProduct.h"

namespace hop
{
namespace
{

double binomial(int n, int k)
{
  double result = 1.0;
  for (int i = 1; i <= k; ++i)
  {
    result *= static_cast<double>(n - k + i) / i;
  }
  return result;
}

/// Multiplicity of a basis function: the binomial or multinomial factor in front of its powers.
double multiplicity(Domain domain, const Degrees& degrees, const LatticePoint& point)
{
  const auto [i, j, k] = point;
  const auto [p, q, r] = degrees;
  switch (domain)
  {
    case Domain::Tetrahedron:
      return binomial(p, i) * binomial(p - i, j) * binomial(p - i - j, k);
    case Domain::Wedge:
      return binomial(p, i) * binomial(p - i, j) * binomial(r, k);
    default:
      return binomial(p, i) * binomial(q, j) * binomial(r, k);
  }
}

} // namespace

std::vector<double> squareField(Domain domain, const Degrees& degrees, int width,
  const std::vector<double>& control, const std::vector<double>& weights, Coefficient* result)
{
  const Degrees doubled{ 2 * degrees[0], 2 * degrees[1], 2 * degrees[2] };
  const std::vector<LatticePoint> lattice = latticePoints(domain, degrees);
  const std::vector<LatticePoint> fine = latticePoints(domain, doubled);
  std::fill_n(result, fine.size(), Coefficient(0.0));
  std::vector<double> squaredWeights(fine.size(), 0.0);

  // B_a B_b = m_a m_b / m_(a+b) B_(a+b) with the multiplicities m of the two bases.
  for (std::size_t a = 0; a < lattice.size(); ++a)
  {
    const double* left = &control[a * width];
    const double multiplicityA = multiplicity(domain, degrees, lattice[a]);
    for (std::size_t b = 0; b < lattice.size(); ++b)
    {
      const double* right = &control[b * width];
      const LatticePoint sum{ lattice[a].i + lattice[b].i, lattice[a].j + lattice[b].j,
        lattice[a].k + lattice[b].k };
      const double share = multiplicityA * multiplicity(domain, degrees, lattice[b]);
      double product = 0.0;
      for (int c = 3; c < width; ++c)
      {
        product += left[c] * right[c];
      }
      const int index = coefficientIndex(domain, doubled, sum);
      result[index] += share *
        Coefficient(weights[b] * left[0], weights[b] * left[1], weights[b] * left[2], product);
      squaredWeights[index] += share * weights[a] * weights[b];
    }
  }
  for (std::size_t i = 0; i < fine.size(); ++i)
  {
    const double m = multiplicity(domain, doubled, fine[i]);
    result[i] /= m;
    squaredWeights[i] /= m;
  }
  return squaredWeights;
}

} // namespace hop
