#include "Elements/LambdaTwoField.h"

#include "Elements/SymmetricEigenvalues.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{

namespace
{

/// A number that depends on the place: its value and derivatives to second order.
struct Local
{
  double value = 0.0;
  glm::dvec3 gradient{ 0.0 };
  glm::dmat3 hessian{ 0.0 };
};

Local operator+(const Local& a, const Local& b)
{
  return { a.value + b.value, a.gradient + b.gradient, a.hessian + b.hessian };
}

Local operator-(const Local& a, const Local& b)
{
  return { a.value - b.value, a.gradient - b.gradient, a.hessian - b.hessian };
}

Local operator*(const Local& a, const Local& b)
{
  const glm::dmat3 mixed = glm::outerProduct(a.gradient, b.gradient);
  return { a.value * b.value, a.value * b.gradient + b.value * a.gradient,
    a.value * b.hessian + b.value * a.hessian + mixed + glm::transpose(mixed) };
}

Local inverseOf(const Local& a)
{
  const double inverse = 1.0 / a.value;
  const glm::dmat3 squares = glm::outerProduct(a.gradient, a.gradient);
  return { inverse, -inverse * inverse * a.gradient,
    inverse * inverse * (2.0 * inverse * squares - a.hessian) };
}

using LocalVector = std::array<Local, 3>;

Local dot(const LocalVector& a, const LocalVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

LocalVector cross(const LocalVector& a, const LocalVector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// X' and U', a vector a coordinate.
struct Columns
{
  std::array<LocalVector, 3> map;
  std::array<LocalVector, 3> field;
};

Local component(const Jet& jet, int c)
{
  return { jet.value[c], { jet.first[0][c], jet.first[1][c], jet.first[2][c] },
    hessianOf(jet.second, c) };
}

Columns columnsAt(Domain domain, const LambdaTwoField& field, const Coefficient* derivatives,
  const ReferencePoint& v)
{
  Columns columns;
  for (int k = 0; k < 3; ++k)
  {
    const Degrees& degrees = field.degrees[k];
    const Jet first = evaluateHessian({ domain, degrees, derivatives, nullptr }, v);
    derivatives += coefficientCount(domain, degrees);
    const Jet rest = evaluateHessian({ domain, degrees, derivatives, nullptr }, v);
    derivatives += coefficientCount(domain, degrees);
    columns.map[k] = { component(first, 0), component(first, 1), component(first, 2) };
    columns.field[k] = { component(first, 3), component(rest, 0), component(rest, 1) };
  }
  return columns;
}

/// A symmetric matrix that depends on the place.
struct LocalMatrix
{
  std::array<LocalVector, 3> entries;

  glm::dmat3 value() const
  {
    return this->matrixOf([](const Local& entry) { return entry.value; });
  }
  glm::dmat3 first(int k) const
  {
    return this->matrixOf([k](const Local& entry) { return entry.gradient[k]; });
  }
  glm::dmat3 second(int k, int l) const
  {
    return this->matrixOf([k, l](const Local& entry) { return entry.hessian[k][l]; });
  }

private:
  template <class Use>
  glm::dmat3 matrixOf(const Use& use) const
  {
    glm::dmat3 result;
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        result[i][j] = use(this->entries[i][j]);
      }
    }
    return result;
  }
};

/// S^2 + W^2 = (G G + (G G)^T) / 2 with G = U' adj(X') / det X'.
LocalMatrix squaresAt(const Columns& columns)
{
  const auto& [a, b, c] = columns.map;
  const std::array<LocalVector, 3> adjugate{ cross(b, c), cross(c, a), cross(a, b) };
  const Local inverse = inverseOf(dot(a, adjugate[0]));
  std::array<LocalVector, 3> g;
  for (int i = 0; i < 3; ++i)
  {
    const LocalVector along{ columns.field[0][i] * inverse, columns.field[1][i] * inverse,
      columns.field[2][i] * inverse };
    for (int j = 0; j < 3; ++j)
    {
      g[i][j] = dot(along, { adjugate[0][j], adjugate[1][j], adjugate[2][j] });
    }
  }
  const Local half{ 0.5 };
  LocalMatrix result;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      const Local there = dot(g[i], { g[0][j], g[1][j], g[2][j] });
      const Local back = dot(g[j], { g[0][i], g[1][i], g[2][i] });
      result.entries[i][j] = half * (there + back);
      result.entries[j][i] = result.entries[i][j];
    }
  }
  return result;
}

/// By perturbation: l' = v A' v and l'' = v A'' v + 2 sum (v A' v_m)^2 / (l - l_m) over the other eigenvectors.
Local middleEigenvalue(const LocalMatrix& matrix)
{
  // Gaps of eigenvalues that are rounding errors, as a share of the largest one. The curvature of the crease itself is
  // left out there.
  constexpr double noGap = 64.0 * std::numeric_limits<double>::epsilon();
  const Eigensystem system = eigensystemOf(matrix.value());
  const glm::dvec3& v = system.vectors[1];
  Local result;
  result.value = system.values[1];
  std::array<glm::dvec3, 3> pulls;
  for (int k = 0; k < 3; ++k)
  {
    pulls[k] = glm::transpose(system.vectors) * (matrix.first(k) * v);
    result.gradient[k] = pulls[k][1];
  }
  const double largest = std::max(std::abs(system.values[0]), std::abs(system.values[2]));
  for (int k = 0; k < 3; ++k)
  {
    for (int l = 0; l < 3; ++l)
    {
      result.hessian[k][l] = glm::dot(v, matrix.second(k, l) * v);
      for (const int m : { 0, 2 })
      {
        const double gap = system.values[1] - system.values[m];
        result.hessian[k][l] +=
          std::abs(gap) > noGap * largest ? 2.0 * pulls[k][m] * pulls[l][m] / gap : 0.0;
      }
    }
  }
  return result;
}

} // namespace

std::size_t derivativeCount(Domain domain, const LambdaTwoField& field)
{
  std::size_t count = 0;
  for (const Degrees& degrees : field.degrees)
  {
    count += 2 * static_cast<std::size_t>(coefficientCount(domain, degrees));
  }
  return count;
}

LambdaTwoSource lambdaTwoSource(const SourceElement& source, const ReferencePart& part)
{
  LambdaTwoSource result;
  result.field.part = part;
  const std::array<std::vector<ScaledPolynomial>, 3> columns = homogeneousDerivatives(source);
  for (int k = 0; k < 3; ++k)
  {
    Degrees& degrees = result.field.degrees[k];
    degrees = { 0, 0, 0 };
    for (const ScaledPolynomial& one : columns[k])
    {
      for (int a = 0; a < 3; ++a)
      {
        degrees[a] = std::max(degrees[a], one.degrees[a]);
      }
    }
    const std::size_t count = coefficientCount(source.domain, degrees);
    const std::size_t first = result.derivatives.size();
    result.derivatives.resize(first + 2 * count, Coefficient(0.0));
    for (int c = 0; c < 6; ++c)
    {
      const std::vector<double> coefficients = unscaled(elevated(columns[k][c], degrees));
      for (std::size_t i = 0; i < count; ++i)
      {
        result.derivatives[first + c / 4 * count + i][c % 4] = coefficients[i];
      }
    }
  }
  return result;
}

void evaluateLambdaTwo(Domain domain, const LambdaTwoField& field, const Coefficient* derivatives,
  const ReferencePoint& u, Jet& jet)
{
  const Local inCell =
    middleEigenvalue(squaresAt(columnsAt(domain, field, derivatives, field.part.inWhole(u))));
  const glm::dmat3& axes = field.part.axes;
  const glm::dvec3 gradient = field.scale * (inCell.gradient * axes);
  const glm::dmat3 hessian = field.scale * (glm::transpose(axes) * inCell.hessian * axes);
  jet.value.w = field.scale * inCell.value;
  for (int a = 0; a < 3; ++a)
  {
    jet.first[a].w = gradient[a];
  }
  constexpr std::array<std::array<int, 2>, 6> pairs{ { { 0, 0 }, { 0, 1 }, { 0, 2 }, { 1, 1 },
    { 1, 2 }, { 2, 2 } } };
  for (int i = 0; i < 6; ++i)
  {
    jet.second[i].w = hessian[pairs[i][0]][pairs[i][1]];
  }
}

} // namespace hop
