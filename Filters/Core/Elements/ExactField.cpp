#include "Elements/ExactField.h"

#include "Elements/QuantityJet.h"

#include <glm/glm.hpp>

#include <algorithm>

namespace hop
{

namespace
{

/// Coefficients hold four components: of (x, y, z, u_0, u_1, ...) so many groups.
int groupCount(const ExactField& field)
{
  return (3 + field.components + 3) / 4;
}

/// Whether second derivatives are wanted.
enum class Order
{
  First,
  Second
};

Jet evaluate(const BernsteinForm& form, const ReferencePoint& u, Order order)
{
  return order == Order::First ? evaluateGradient(form, u) : evaluateHessian(form, u);
}

/// A matrix, a column a coordinate of the cell, with its derivatives.
using ColumnsJet = GradientJet;

/// Takes a component of the derivatives along coordinate k into row c of the columns.
void takeComponent(const Jet& jet, int component, int k, int c, ColumnsJet& columns)
{
  columns.value[k][c] = jet.value[component];
  for (int a = 0; a < 3; ++a)
  {
    columns.first[a][k][c] = jet.first[a][component];
  }
  for (int i = 0; i < 6; ++i)
  {
    columns.second[i][k][c] = jet.second[i][component];
  }
}

/// X' and U'; of components that there are not the rows are zero.
struct CellJets
{
  ColumnsJet map;
  ColumnsJet field;
};

CellJets jetsAt(Domain domain, const ExactField& field, const Coefficient* coefficients,
  const ReferencePoint& v, Order order)
{
  CellJets jets;
  coefficients += coefficientCount(domain, field.degrees);
  for (int k = 0; k < 3; ++k)
  {
    const Degrees& degrees = field.ofDerivatives[k];
    for (int group = 0; group < groupCount(field); ++group)
    {
      const Jet jet = evaluate({ domain, degrees, coefficients, nullptr }, v, order);
      coefficients += coefficientCount(domain, degrees);
      for (int c = 4 * group; c < std::min(4 * group + 4, 3 + field.components); ++c)
      {
        takeComponent(jet, c % 4, k, c % 3, c < 3 ? jets.map : jets.field);
      }
    }
  }
  return jets;
}

/// G = U' X'^-1. As U' = G X', G_k = (U'_k - G X'_k) X'^-1 and so on.
GradientJet gradientJet(const ColumnsJet& map, const ColumnsJet& field, Order order)
{
  const glm::dmat3 inverse = glm::inverse(map.value);
  GradientJet g;
  g.value = field.value * inverse;
  for (int k = 0; k < 3; ++k)
  {
    g.first[k] = (field.first[k] - g.value * map.first[k]) * inverse;
  }
  for (int i = 0; i < 6 && order == Order::Second; ++i)
  {
    const auto [k, l] = SecondDerivatives[i];
    g.second[i] = (field.second[i] - g.value * map.second[i] - g.first[k] * map.first[l] -
                    g.first[l] * map.first[k]) *
      inverse;
  }
  return g;
}

/// The place in the cell, by the quotient rule where the cell is rational, with a quantity in the place of the field.
Jet jetOf(const Jet& homogeneous, const ScalarJet& quantity, double scale)
{
  const double inverse = 1.0 / homogeneous.value.w;
  Jet result;
  result.value = inverse * homogeneous.value;
  for (int a = 0; a < 3; ++a)
  {
    result.first[a] = inverse * (homogeneous.first[a] - homogeneous.first[a].w * result.value);
  }
  for (int i = 0; i < 6; ++i)
  {
    const auto [a, b] = SecondDerivatives[i];
    result.second[i] = inverse *
      (homogeneous.second[i] - homogeneous.first[a].w * result.first[b] -
        homogeneous.first[b].w * result.first[a] - homogeneous.second[i].w * result.value);
    result.second[i].w = scale * quantity.hessian[a][b];
  }
  result.value.w = scale * quantity.value;
  for (int a = 0; a < 3; ++a)
  {
    result.first[a].w = scale * quantity.gradient[a];
  }
  return result;
}

/// A jet along the coordinates of the cell becomes one along those of a part.
Jet alongAxes(const Jet& inCell, const glm::dmat3& axes)
{
  Jet result;
  result.value = inCell.value;
  for (int c = 0; c < 4; ++c)
  {
    const glm::dvec3 first =
      glm::dvec3(inCell.first[0][c], inCell.first[1][c], inCell.first[2][c]) * axes;
    const glm::dmat3 second = glm::transpose(axes) * hessianOf(inCell.second, c) * axes;
    for (int a = 0; a < 3; ++a)
    {
      result.first[a][c] = first[a];
    }
    for (int i = 0; i < 6; ++i)
    {
      result.second[i][c] = second[SecondDerivatives[i][0]][SecondDerivatives[i][1]];
    }
  }
  return result;
}

Jet evaluate(Domain domain, const ExactField& field, const Coefficient* coefficients,
  const ReferencePoint& u, Order order)
{
  const ReferencePoint v = field.part.inWhole(u);
  const Jet place = evaluate({ domain, field.degrees, coefficients, nullptr }, v, order);
  const CellJets jets = jetsAt(domain, field, coefficients, v, order);
  const GradientJet gradient = gradientJet(jets.map, jets.field, order);
  return alongAxes(
    jetOf(place, quantityJet(field.quantity, gradient), field.scale), field.part.axes);
}

/// One at least, as elements have. The same along all axes of cubes: kernels know such degrees at compile time.
Degrees highestOf(const std::vector<ScaledPolynomial>& polynomials)
{
  Degrees degrees{ 1, 1, 1 };
  for (const ScaledPolynomial& one : polynomials)
  {
    for (int a = 0; a < 3; ++a)
    {
      degrees[a] = std::max(degrees[a], one.degrees[a]);
    }
  }
  if (polynomials[0].domain == Domain::Hexahedron)
  {
    degrees.fill(*std::max_element(degrees.begin(), degrees.end()));
  }
  return degrees;
}

/// Appends coefficients of polynomials, four in a group.
void append(const std::vector<ScaledPolynomial>& polynomials, const Degrees& degrees,
  std::vector<Coefficient>& coefficients)
{
  const std::size_t count = coefficientCount(polynomials[0].domain, degrees);
  for (std::size_t c = 0; c < polynomials.size(); ++c)
  {
    if (c % 4 == 0)
    {
      coefficients.resize(coefficients.size() + count, Coefficient(0.0));
    }
    const std::vector<double> values = unscaled(elevated(polynomials[c], degrees));
    Coefficient* group = coefficients.data() + coefficients.size() - count;
    for (std::size_t i = 0; i < count; ++i)
    {
      group[i][static_cast<int>(c % 4)] = values[i];
    }
  }
}

} // namespace

std::size_t coefficientCount(Domain domain, const ExactField& field)
{
  std::size_t count = coefficientCount(domain, field.degrees);
  for (const Degrees& degrees : field.ofDerivatives)
  {
    count += static_cast<std::size_t>(groupCount(field)) * coefficientCount(domain, degrees);
  }
  return count;
}

ExactSource exactSource(const SourceElement& source, Quantity quantity)
{
  ExactSource result;
  result.field.quantity = quantity;
  result.field.components = source.width - 3;
  result.field.degrees = source.degrees;
  std::vector<ScaledPolynomial> place = componentsOf(source);
  place.resize(3);
  place.push_back(weightOf(source));
  append(place, source.degrees, result.coefficients);
  const std::array<std::vector<ScaledPolynomial>, 3> columns = homogeneousDerivatives(source);
  for (int k = 0; k < 3; ++k)
  {
    Degrees& degrees = result.field.ofDerivatives[k];
    degrees = highestOf(columns[k]);
    append(columns[k], degrees, result.coefficients);
  }
  return result;
}

Jet exactGradient(
  Domain domain, const ExactField& field, const Coefficient* coefficients, const ReferencePoint& u)
{
  return evaluate(domain, field, coefficients, u, Order::First);
}

Jet exactHessian(
  Domain domain, const ExactField& field, const Coefficient* coefficients, const ReferencePoint& u)
{
  return evaluate(domain, field, coefficients, u, Order::Second);
}

} // namespace hop
