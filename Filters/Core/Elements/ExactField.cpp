#include "Elements/ExactField.h"

#include "Elements/KernelAccess.h"
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

/// Writes into a jet: copies of jets would cost a third of the whole.
void evaluate(const BernsteinForm& form, const ReferencePoint& u, Order order, Jet& jet)
{
  const kernel::DomainKernels& kernels = kernelsOf(form.domain);
  const kernel::PointFunction function = order == Order::First ? kernels.gradient : kernels.hessian;
  function(plainElement(form), &u.xyz.x, &jet.value.x);
}

/// The derivatives of (x, y, z, u_0) and of (u_1, u_2, 0, 0) along each coordinate of the cell, with their own derivatives.
using DerivativeJets = std::array<std::array<Jet, 2>, 3>;

DerivativeJets derivativesAt(Domain domain, const ExactField& field,
  const Coefficient* coefficients, const ReferencePoint& v, Order order)
{
  DerivativeJets jets;
  coefficients += coefficientCount(domain, field.degrees);
  for (int k = 0; k < 3; ++k)
  {
    const Degrees& degrees = field.ofDerivatives[k];
    for (int group = 0; group < groupCount(field); ++group)
    {
      evaluate({ domain, degrees, coefficients, nullptr }, v, order, jets[k][group]);
      coefficients += coefficientCount(domain, degrees);
    }
  }
  return jets;
}

/// X' and U', or the derivatives of these along a coordinate: a column a coordinate of the cell.
struct Columns
{
  glm::dmat3 map;
  glm::dmat3 field;
};

/// \param numberOf the value of a jet, or one of its derivatives
template <class NumberOf>
Columns columnsOf(const DerivativeJets& jets, const NumberOf& numberOf)
{
  Columns result;
  for (int k = 0; k < 3; ++k)
  {
    const Coefficient& first = numberOf(jets[k][0]);
    const Coefficient& second = numberOf(jets[k][1]);
    result.map[k] = glm::dvec3(first);
    result.field[k] = { first.w, second.x, second.y };
  }
  return result;
}

/// The quantity along the coordinates of the cell. With G = U' X'^-1 and T = q' X'^-T, a change of the cell's columns
/// changes q by T : (dU' - G dX'). Along two coordinates k and l that is T : (U'_kl - G X'_kl - G_k X'_l - G_l X'_k) and
/// the bend of q, so that no second derivative of G is needed.
ScalarJet quantityAt(Quantity quantity, const DerivativeJets& jets, Order order)
{
  const Columns columns = columnsOf(jets, [](const Jet& jet) { return jet.value; });
  const glm::dmat3 inverse = glm::inverse(columns.map);
  const glm::dmat3 gradient = columns.field * inverse;
  std::array<Columns, 3> changes;
  std::array<glm::dmat3, 3> ofGradient{ glm::dmat3(0.0), glm::dmat3(0.0), glm::dmat3(0.0) };
  for (int k = 0; k < 3 && order == Order::Second; ++k)
  {
    changes[k] = columnsOf(jets, [k](const Jet& jet) { return jet.first[k]; });
    ofGradient[k] = (changes[k].field - gradient * changes[k].map) * inverse;
  }
  const QuantityJet q = quantityJet(quantity, gradient, ofGradient);
  const glm::dmat3 slope = q.slope * glm::transpose(inverse);
  const glm::dmat3 ofMap = glm::transpose(gradient) * slope;
  const auto changeBy = [&](const auto& numberOf)
  {
    double sum = 0.0;
    for (int m = 0; m < 3; ++m)
    {
      sum += glm::dot(Coefficient(-ofMap[m], slope[m].x), numberOf(jets[m][0])) +
        glm::dot(Coefficient(slope[m].y, slope[m].z, 0.0, 0.0), numberOf(jets[m][1]));
    }
    return sum;
  };
  ScalarJet result;
  result.value = q.value;
  std::array<glm::dmat3, 3> pulls;
  for (int k = 0; k < 3; ++k)
  {
    result.gradient[k] = changeBy([k](const Jet& jet) { return jet.first[k]; });
    pulls[k] = glm::transpose(ofGradient[k]) * slope;
  }
  for (int i = 0; i < 6 && order == Order::Second; ++i)
  {
    const auto [k, l] = SecondDerivatives[i];
    result.hessian[k][l] = changeBy([i](const Jet& jet) { return jet.second[i]; }) -
      sumOfProducts(pulls[k], changes[l].map) - sumOfProducts(pulls[l], changes[k].map) +
      q.bend[k][l];
    result.hessian[l][k] = result.hessian[k][l];
  }
  return result;
}

/// A homogeneous place becomes that in the cell, by the quotient rule.
void divideByWeight(Jet& place)
{
  const double inverse = 1.0 / place.value.w;
  const glm::dvec3 weight = gradientOf(place);
  place.value *= inverse;
  for (int a = 0; a < 3; ++a)
  {
    place.first[a] = inverse * (place.first[a] - weight[a] * place.value);
  }
  for (int i = 0; i < 6; ++i)
  {
    const auto [a, b] = SecondDerivatives[i];
    place.second[i] = inverse *
      (place.second[i] - weight[a] * place.first[b] - weight[b] * place.first[a] -
        place.second[i].w * place.value);
  }
}

void setField(const ScalarJet& field, double scale, Jet& jet)
{
  jet.value.w = scale * field.value;
  for (int a = 0; a < 3; ++a)
  {
    jet.first[a].w = scale * field.gradient[a];
  }
  for (int i = 0; i < 6; ++i)
  {
    const auto [a, b] = SecondDerivatives[i];
    jet.second[i].w = scale * field.hessian[a][b];
  }
}

/// A jet along the coordinates of the cell becomes one along those of a part.
Jet alongAxes(const Jet& inCell, const glm::dmat3& axes)
{
  const auto along = [&](int a, const Coefficient& u, const Coefficient& v, const Coefficient& w)
  { return u * axes[a][0] + v * axes[a][1] + w * axes[a][2]; };
  const auto& [uu, uv, uw, vv, vw, ww] = inCell.second;
  Jet result;
  result.value = inCell.value;
  for (int a = 0; a < 3; ++a)
  {
    result.first[a] = along(a, inCell.first[0], inCell.first[1], inCell.first[2]);
  }
  for (int i = 0; i < 6; ++i)
  {
    const auto [a, b] = SecondDerivatives[i];
    result.second[i] = along(b, along(a, uu, uv, uw), along(a, uv, vv, vw), along(a, uw, vw, ww));
  }
  return result;
}

Jet evaluate(Domain domain, const ExactField& field, const Coefficient* coefficients,
  const ReferencePoint& u, Order order)
{
  const ReferencePoint v = field.part.inWhole(u);
  Jet jet;
  evaluate({ domain, field.degrees, coefficients, nullptr }, v, order, jet);
  divideByWeight(jet);
  const DerivativeJets derivatives = derivativesAt(domain, field, coefficients, v, order);
  setField(quantityAt(field.quantity, derivatives, order), field.scale, jet);
  return alongAxes(jet, field.part.axes);
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
