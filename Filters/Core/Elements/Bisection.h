#pragma once

#include "Elements/Bernstein.h"
#include "Kernel/Kernels.h"
#include "Support/Buffer.h"

namespace hop
{

/// The lines of an element's lattice that run along one direction. Bisection works on each line alone, by de
/// Casteljau's algorithm (Documentation/algorithm.md, section Elements).
class LatticeLines
{
public:
  /// \param direction one of facts(domain).edgeDirections
  LatticeLines(Domain domain, const Degrees& degrees, const LatticePoint& direction);

  /// Bisects a polynomial at the middle of the edges along the direction.
  /// \param coefficients replaced by those of the half at the start of the direction
  /// \param second receives the coefficients of the other half
  template <class Value>
  void bisect(std::vector<Value>& coefficients, std::vector<Value>& second) const;

  /// The same for coefficients of elements, and for numbers, by kernels.
  void bisect(Buffer<Coefficient>& coefficients, Buffer<Coefficient>& second) const;
  void bisect(std::vector<double>& numbers, std::vector<double>& second) const;

  /// Sum of the absolute differences of neighbouring coefficients along the direction.
  double variation(const std::vector<double>& coefficients) const;

private:
  kernel::Lines lines() const;

  /// Where each line begins in Index; last, its length.
  std::vector<int> Begin;
  /// Storage indices of the points, line after line.
  std::vector<int> Index;
};

template <class Value>
void LatticeLines::bisect(std::vector<Value>& coefficients, std::vector<Value>& second) const
{
  second.resize(coefficients.size());
  Value line[MaximumPolynomialDegree + 1] = {};
  for (std::size_t l = 0; l + 1 < this->Begin.size(); ++l)
  {
    const int* where = &this->Index[this->Begin[l]];
    const int n = this->Begin[l + 1] - this->Begin[l];
    for (int i = 0; i < n; ++i)
    {
      line[i] = coefficients[where[i]];
    }
    for (int left = n - 1; left >= 0; --left)
    {
      coefficients[where[n - 1 - left]] = line[0];
      for (int k = 0; k < left; ++k)
      {
        line[k] = 0.5 * (line[k] + line[k + 1]);
      }
    }
    for (int i = 0; i < n; ++i)
    {
      second[where[i]] = line[i];
    }
  }
}

/// Rounding errors of repeated bisection, relative to the largest coefficient. Each step of de Casteljau's algorithm
/// rounds by half an epsilon of doubles at most: this covers ninety steps in a row that all err one way. It is an
/// estimate, not a bound: 36 halvings of degree p are up to 36 p steps, whose errors cancel as a rule.
/// Larger: pieces whose coefficients nearly reach the isovalue are split in vain; smaller: a piece that holds surface
/// might be dropped.
constexpr double BisectionRounding = 1e-14;

/// Bisects once along a direction. Where the same is done many times, keep the LatticeLines.
template <class Value>
void bisect(Domain domain, const Degrees& degrees, const LatticePoint& direction,
  std::vector<Value>& coefficients, std::vector<Value>& second)
{
  LatticeLines(domain, degrees, direction).bisect(coefficients, second);
}

} // namespace hop
