#pragma once

#include "Elements/Bernstein.h"

namespace hop
{

/// The lines of an element's lattice that run along one direction: storage indices, line after line.
class LatticeLines
{
public:
  /// \param direction one of facts(domain).edgeDirections
  LatticeLines(Domain domain, const Degrees& degrees, const LatticePoint& direction);

  /// Bisects a polynomial at the middle of the edges along the direction, by de Casteljau's algorithm
  /// on every line.
  /// \param coefficients replaced by those of the half at the start of the direction
  /// \param second receives those of the other half
  template <class Value>
  void bisect(std::vector<Value>& coefficients, std::vector<Value>& second) const;

  /// Sum of the differences of neighbouring coefficients along the direction, as absolute values.
  double variation(const std::vector<double>& coefficients) const;

private:
  std::vector<int> Begin;
  std::vector<int> Index;
};

template <class Value>
void LatticeLines::bisect(std::vector<Value>& coefficients, std::vector<Value>& second) const
{
  second.resize(coefficients.size());
  Value line[MaximumPolynomialDegree + 1];
  for (std::size_t l = 0; l + 1 < this->Begin.size(); ++l)
  {
    const int* where = &this->Index[this->Begin[l]];
    const int n = this->Begin[l + 1] - this->Begin[l];
    for (int i = 0; i < n; ++i)
    {
      line[i] = coefficients[where[i]];
    }
    for (int step = 0; step < n; ++step)
    {
      second[where[n - 1 - step]] = line[n - 1];
      for (int i = n - 1; i > step; --i)
      {
        line[i] = 0.5 * (line[i] + line[i - 1]);
      }
    }
    for (int i = 0; i < n; ++i)
    {
      coefficients[where[i]] = line[i];
    }
  }
}

/// Halving adds rounding errors of the order of eps times the values themselves.
constexpr double RoundingShare = 1e-14;

/// Bisects once along a direction; see LatticeLines for many times.
template <class Value>
void bisect(Domain domain, const Degrees& degrees, const LatticePoint& direction,
  std::vector<Value>& coefficients, std::vector<Value>& second)
{
  LatticeLines(domain, degrees, direction).bisect(coefficients, second);
}

} // namespace hop
