#include "Elements/SampledField.h"

#include "Elements/BatchEvaluator.h"
#include "Elements/CollapsedFaces.h"
#include "Elements/LostComponents.h"
#include "Elements/SamplingLattice.h"
#include "Kernel/InstructionSet.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace hop
{

namespace
{

struct Sampling
{
  /// Largest error, of the largest value of the field on the part. Smaller: more parts of higher degrees; larger:
  /// particles are off their isovalue by as much.
  static constexpr double Tolerance = 1e-9;
  /// The same where particles stand on the field itself.
  static constexpr double ToleranceOfProofs = 1e-8;
  /// Largest error of the geometry, of its extent: where cells meet it opens gaps of this width.
  static constexpr double GeometryTolerance = 1e-11;
  /// How much larger than what was seen an error may be where a part is said to hold no surface.
  static constexpr double Caution = 10.0;
  /// How much larger an error may be for a lower degree, where none holds the field. Larger: rounder surfaces that are
  /// farther off; smaller: ripples, and many particles on them.
  static constexpr double Ripples = 3.0;
  /// Degrees from the lowest to the highest that is tried, in steps. Lower: parts of straight cells with a linear field
  /// take more coefficients than they need. Higher: coefficients are ever larger than the values (2^30 times at degree
  /// 10, by NodalBasis::conversionNorm), and an evaluation costs as much as one of several parts.
  static constexpr int LowestDegree = 4;
  static constexpr int DegreeStep = 2;
  /// Steps in a row that promise too little before a proof does without higher degrees. Fewer: fields that bend much
  /// count as creased; more: creases cost more (derived_costs.py).
  static constexpr int PoorSteps = 2;
  /// The same of lambda 2, which has creases in most cells.
  static constexpr int PoorStepsOfCreases = 1;
};

/// Of a hexahedron Gauss-Lobatto-Legendre nodes allow a higher degree than equispaced ones.
int highestDegree(Domain domain)
{
  return domain == Domain::Hexahedron ? 14 : 10;
}

/// Where a part of a cube whose axes are those of the cube has the points of a line along an axis.
std::vector<double> lineInWhole(
  const ReferencePart& part, int axis, const std::vector<double>& line)
{
  std::vector<double> result;
  result.reserve(line.size());
  for (const double t : line)
  {
    result.push_back(part.origin[axis] + part.axes[axis][axis] * t);
  }
  return result;
}

bool hasAxesOfCube(const ReferencePart& part)
{
  const glm::dmat3& axes = part.axes;
  return axes[0][1] == 0.0 && axes[0][2] == 0.0 && axes[1][0] == 0.0 && axes[1][2] == 0.0 &&
    axes[2][0] == 0.0 && axes[2][1] == 0.0;
}

double lengthOfCurl2(const std::vector<glm::dvec3>& g)
{
  const glm::dvec3 curl(g[2].y - g[1].z, g[0].z - g[2].x, g[1].x - g[0].y);
  return glm::dot(curl, curl);
}

double qCriterion(const std::vector<glm::dvec3>& g)
{
  return -0.5 * (g[0].x * g[0].x + g[1].y * g[1].y + g[2].z * g[2].z) - g[0].y * g[1].x -
    g[1].z * g[2].y - g[2].x * g[0].z;
}

double lambda2(const std::vector<glm::dvec3>& g)
{
  // A map that is the identity.
  const glm::dmat3 unit(1.0);
  kernel::GradientRows rows{};
  for (int n = 0; n < 9; ++n)
  {
    rows.x[n] = &unit[n / 3][n % 3];
    rows.u[n] = &g[n / 3][n % 3];
  }
  double result = 0.0;
  kernel::current().lambdaTwo(rows, 1, &result);
  return result;
}

double sumOfSquares(const std::vector<glm::dvec3>& g)
{
  double sum = 0.0;
  for (const glm::dvec3& row : g)
  {
    sum += glm::dot(row, row);
  }
  return sum;
}

BernsteinForm formOf(Domain domain, const DerivedElement& element)
{
  return { domain, element.degrees, element.coefficients.data(), nullptr };
}

std::vector<double> fieldOf(const std::vector<Coefficient>& samples)
{
  std::vector<double> field;
  field.reserve(samples.size());
  for (const Coefficient& sample : samples)
  {
    field.push_back(sample.w);
  }
  return field;
}

/// Lambda 2 of the three components after x, y and z.
/// \param rowOf as in FieldSampler::samplesOf()
template <class RowOf>
std::vector<double> lambda2At(std::size_t count, const RowOf& rowOf)
{
  kernel::GradientRows rows{};
  for (int i = 0; i < 3; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      rows.x[3 * i + axis] = rowOf(quantity::first + axis, i);
      rows.u[3 * i + axis] = rowOf(quantity::first + axis, 3 + i);
    }
  }
  std::vector<double> lambda(count);
  kernel::current().lambdaTwo(rows, static_cast<std::ptrdiff_t>(count), lambda.data());
  return lambda;
}

bool isFinite(const glm::dvec3& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isFinite(const std::vector<double>& numbers)
{
  return std::all_of(
    numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

bool isFinite(const std::vector<Coefficient>& samples)
{
  return std::all_of(samples.begin(), samples.end(),
    [](const Coefficient& c) { return isFinite(glm::dvec3(c)) && std::isfinite(c.w); });
}

/// How far coordinates reach.
double extentOf(const std::vector<Coefficient>& samples)
{
  glm::dvec3 lower(samples[0]);
  glm::dvec3 upper = lower;
  for (const Coefficient& sample : samples)
  {
    lower = glm::min(lower, glm::dvec3(sample));
    upper = glm::max(upper, glm::dvec3(sample));
  }
  return glm::distance(lower, upper);
}

double largestField(const std::vector<Coefficient>& samples)
{
  double largest = 0.0;
  for (const Coefficient& sample : samples)
  {
    largest = std::max(largest, std::abs(sample.w));
  }
  return largest;
}

/// Of polynomials that do not hold a field the one of the lowest degree that is hardly farther from it than the best:
/// higher ones ripple beside a crease.
SampledPart simplestOf(std::vector<SampledPart> tried)
{
  const auto best = std::min_element(tried.begin(), tried.end(),
    [](const SampledPart& a, const SampledPart& b) { return a.error < b.error; });
  const double most = Sampling::Ripples * best->error;
  return std::move(*std::find_if(
    tried.begin(), tried.end(), [&](const SampledPart& one) { return one.error <= most; }));
}

/// Whether none of the last steps, if the ones that are left lower the error by the same factor, leads to the
/// tolerance: errors of smooth fields fall geometrically, those beside creases hardly.
/// \param steps that are looked at
bool isHopeless(const std::vector<SampledPart>& tried, int steps, int stepsLeft, double tolerance)
{
  const int last = static_cast<int>(tried.size()) - 1;
  if (last < steps)
  {
    return false;
  }
  for (int i = last; i > last - steps; --i)
  {
    const double ratio = tried[i].error / tried[i - 1].error;
    if (tried[i].error * std::pow(ratio, stepsLeft + last - i) <= tolerance)
    {
      return false;
    }
  }
  return true;
}

/// Whether a field differs from an isovalue by more than its rounding anywhere. Components of rounding are none to lose.
bool isBeyondNoise(const std::vector<double>& field, double isovalue, double noise)
{
  return std::any_of(
    field.begin(), field.end(), [&](double value) { return std::abs(value - isovalue) > noise; });
}

} // namespace

FieldFunction functionOf(Quantity quantity)
{
  switch (quantity)
  {
    case Quantity::Value:
    case Quantity::Expression:
      break;
    case Quantity::GradientMagnitude:
      return [](const FieldPoint& at) { return sumOfSquares(at.gradients); };
    case Quantity::Divergence:
      return [](const FieldPoint& at)
      { return at.gradients[0].x + at.gradients[1].y + at.gradients[2].z; };
    case Quantity::VorticityMagnitude:
      return [](const FieldPoint& at) { return lengthOfCurl2(at.gradients); };
    case Quantity::QCriterion:
      return [](const FieldPoint& at) { return qCriterion(at.gradients); };
    case Quantity::Lambda2:
      return [](const FieldPoint& at) { return lambda2(at.gradients); };
  }
  return {};
}

FieldSampler::FieldSampler(const SourceElement& source, Quantity quantity,
  const FieldFunction& function, double noise, StandIn standIn)
  : Source(source)
  , ItsQuantity(quantity)
  , Function(function)
  , Noise(noise)
  , ItsStandIn(standIn)
  , FirstDegree(Sampling::LowestDegree)
{
  const std::size_t rows = source.control.size() / source.width;
  for (int first = 0; first < source.width; first += 4)
  {
    std::vector<Coefficient>& group = this->Groups.emplace_back(rows, Coefficient(0.0));
    for (std::size_t i = 0; i < rows; ++i)
    {
      for (int c = first; c < std::min(first + 4, source.width); ++c)
      {
        group[i][c - first] = source.control[i * source.width + c];
      }
    }
  }
  for (int c = 0; c < source.width; ++c)
  {
    for (std::size_t i = 0; i < rows; ++i)
    {
      this->Components.push_back(source.control[i * source.width + c]);
    }
  }
  if (hasCollapsedEdge(source))
  {
    this->Homogeneous = exactSource(source, quantity);
  }
}

/// x, y, z and the field at points of a part.
FieldSampler::Samples FieldSampler::valuesAt(
  const ReferencePart& part, const std::vector<ReferencePoint>& points)
{
  std::vector<ReferencePoint> inWhole;
  inWhole.reserve(points.size());
  for (const ReferencePoint& point : points)
  {
    inWhole.push_back(part.inWhole(point));
  }
  const int count = static_cast<int>(points.size());
  std::vector<JetBatch> jets(this->Groups.size());
  for (std::size_t g = 0; g < jets.size(); ++g)
  {
    evaluateGradients({ this->Source.domain, this->Source.degrees, this->Groups[g].data(),
                        this->Source.isRational ? this->Source.weights.data() : nullptr },
      inWhole.data(), count, jets[g]);
  }
  if (!this->Homogeneous)
  {
    return this->samplesOf(
      points.size(), [&](int quantity, int c) { return jets[c / 4].row(quantity, c % 4); });
  }
  const std::vector<JetBatch> derivatives = this->homogeneousAt(inWhole);
  return this->samplesOf(points.size(),
    [&](int quantity, int c)
    {
      if (quantity == quantity::value)
      {
        return jets[c / 4].row(quantity, c % 4);
      }
      const std::size_t k = quantity - quantity::first;
      return derivatives[k * jets.size() + c / 4].row(quantity::value, c % 4);
    });
}

/// Derivatives of the components along the cell's coordinates, group by group, but for factors that cancel in gradients.
std::vector<JetBatch> FieldSampler::homogeneousAt(const std::vector<ReferencePoint>& points) const
{
  const ExactField& field = this->Homogeneous->field;
  const Domain domain = this->Source.domain;
  const Coefficient* coefficients =
    this->Homogeneous->coefficients.data() + coefficientCount(domain, field.degrees);
  std::vector<JetBatch> values;
  for (const Degrees& degrees : field.ofDerivatives)
  {
    for (std::size_t g = 0; g < this->Groups.size(); ++g)
    {
      evaluateGradients({ domain, degrees, coefficients, nullptr }, points.data(),
        static_cast<int>(points.size()), values.emplace_back());
      coefficients += coefficientCount(domain, degrees);
    }
  }
  return values;
}

/// The same at the nodes of a lattice: axis by axis where it has the axes of the whole.
FieldSampler::Samples FieldSampler::valuesAt(
  const ReferencePart& part, const SamplingLattice& lattice)
{
  if (!lattice.ofCube || this->Homogeneous || !hasAxesOfCube(part))
  {
    return this->valuesAt(part, lattice.nodes);
  }
  std::array<LineMatrix, 3> values;
  std::array<LineMatrix, 3> slopes;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<double> line = lineInWhole(part, axis, lattice.ofCube->line());
    values[axis] = bernsteinValues(this->Source.degrees[axis], line);
    slopes[axis] = bernsteinSlopes(this->Source.degrees[axis], line);
  }
  const std::array<std::vector<double>, quantity::countOfGradients> rows =
    gradientsAlongAxes(values, slopes, this->Components);
  const std::size_t count = lattice.nodes.size();
  return this->samplesOf(count, [&](int quantity, int c) { return &rows[quantity][c * count]; });
}

/// \param rowOf a quantity of a jet and a component of the source: a number a point
template <class RowOf>
FieldSampler::Samples FieldSampler::samplesOf(std::size_t count, const RowOf& rowOf)
{
  std::vector<double> field;
  if (this->ItsQuantity == Quantity::Lambda2)
  {
    field = lambda2At(count, rowOf);
  }
  if (field.empty() || !isFinite(field))
  {
    field = this->fieldAt(count, rowOf);
  }
  Samples samples;
  samples.reserve(count);
  for (std::size_t n = 0; n < count; ++n)
  {
    const auto valueOf = [&](int c) { return rowOf(quantity::value, c)[n]; };
    samples.emplace_back(valueOf(0), valueOf(1), valueOf(2), field[n]);
  }
  return samples;
}

/// Point by point.
/// \param rowOf as in samplesOf()
template <class RowOf>
std::vector<double> FieldSampler::fieldAt(std::size_t count, const RowOf& rowOf)
{
  const int components = this->Source.width - 3;
  FieldPoint at;
  at.values.resize(components);
  at.gradients.resize(components);
  std::vector<double> field;
  field.reserve(count);
  for (std::size_t n = 0; n < count; ++n)
  {
    const auto threeOf = [&](int c)
    {
      return glm::dvec3(rowOf(quantity::first, c)[n], rowOf(quantity::first + 1, c)[n],
        rowOf(quantity::first + 2, c)[n]);
    };
    const auto valueOf = [&](int c) { return rowOf(quantity::value, c)[n]; };
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(threeOf(0), threeOf(1), threeOf(2)));
    at.x = { valueOf(0), valueOf(1), valueOf(2) };
    for (int c = 0; c < components; ++c)
    {
      at.values[c] = valueOf(3 + c);
      at.gradients[c] = inverse * threeOf(3 + c); // J^-T, as columns here are rows of J
      this->AreDerivativesFinite = this->AreDerivativesFinite && isFinite(at.gradients[c]);
    }
    field.push_back(this->Function(at));
  }
  return field;
}

/// \param checks the field at checkPoints()
SampledPart FieldSampler::interpolated(const ReferencePart& part, int degree, const Samples& checks)
{
  const SamplingLattice& lattice = samplingLattice(this->Source.domain, degree);
  const Samples nodal = this->valuesAt(part, lattice);
  SampledPart result;
  if (!isFinite(nodal) || !isFinite(checks))
  {
    result.element.state = this->AreDerivativesFinite ? DerivedElement::State::NotFinite
                                                      : DerivedElement::State::Singular;
    return result;
  }
  DerivedElement& element = result.element;
  element.state = DerivedElement::State::Sound;
  element.degrees = lattice.degrees;
  element.coefficients = coefficientsFrom(lattice, nodal);
  this->judge(result, checks);
  return result;
}

/// Compares the polynomial with the field at checkPoints().
void FieldSampler::judge(SampledPart& sampled, const Samples& checks) const
{
  const BernsteinForm form = formOf(this->Source.domain, sampled.element);
  const std::vector<ReferencePoint>& points = checkPoints(this->Source.domain);
  JetBatch jets;
  evaluateGradients(form, points.data(), static_cast<int>(points.size()), jets);
  double ofGeometry = 0.0;
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    const Coefficient value = jets.jet(static_cast<int>(n)).value;
    sampled.error = std::max(sampled.error, std::abs(value.w - checks[n].w));
    ofGeometry = std::max(ofGeometry, glm::distance(glm::dvec3(value), glm::dvec3(checks[n])));
  }
  sampled.isResolved = sampled.error <= this->toleranceOf(checks) &&
    ofGeometry <= Sampling::GeometryTolerance * extentOf(checks) + this->Source.coordinateError;
}

/// Of the field, in its unit.
double FieldSampler::toleranceOf(const Samples& checks) const
{
  const double share =
    this->ItsStandIn == StandIn::Proof ? Sampling::ToleranceOfProofs : Sampling::Tolerance;
  return std::max(share * largestField(checks), Sampling::Caution * this->Noise);
}

SampledPart FieldSampler::sample(const ReferencePart& part,
  const std::function<bool(const Range&)>& canHoldSurface, const std::vector<double>& isovalues)
{
  const Samples checks = this->valuesAt(part, checkPoints(this->Source.domain));
  const int highest = highestDegree(this->Source.domain);
  const bool isCreased = this->ItsQuantity == Quantity::Lambda2;
  const int poorSteps = isCreased ? Sampling::PoorStepsOfCreases : Sampling::PoorSteps;
  std::vector<SampledPart> tried;
  for (int degree = this->FirstDegree;; degree += Sampling::DegreeStep)
  {
    SampledPart result = this->interpolated(part, degree, checks);
    if (result.element.state != DerivedElement::State::Sound)
    {
      return result;
    }
    const Range range = fieldRange(formOf(this->Source.domain, result.element));
    const double slack = Sampling::Caution * result.error + this->Noise;
    result.canHoldSurface = canHoldSurface({ range.lower - slack, range.upper + slack });
    if (result.isResolved || !result.canHoldSurface)
    {
      this->FirstDegree = std::max(Sampling::LowestDegree, degree - Sampling::DegreeStep);
      return result;
    }
    tried.push_back(std::move(result));
    const int stepsLeft = (highest - degree) / Sampling::DegreeStep;
    if (stepsLeft == 0 ||
      (this->ItsStandIn == StandIn::Proof &&
        isHopeless(tried, poorSteps, stepsLeft, this->toleranceOf(checks))))
    {
      this->FirstDegree = Sampling::LowestDegree;
      SampledPart simplest = simplestOf(std::move(tried));
      const int finer = std::min(degree + Sampling::DegreeStep, highest);
      simplest.losesComponents = this->losesComponents(
        simplest, part, samplingLattice(this->Source.domain, finer), isovalues);
      return simplest;
    }
  }
}

/// \param lattice whose nodes are compared
bool FieldSampler::losesComponents(const SampledPart& sampled, const ReferencePart& part,
  const SamplingLattice& lattice, const std::vector<double>& isovalues)
{
  if (isovalues.empty())
  {
    return false;
  }
  const std::vector<double> atNodes = fieldOf(this->valuesAt(part, lattice));
  std::vector<double> reached;
  std::copy_if(isovalues.begin(), isovalues.end(), std::back_inserter(reached),
    [&](double isovalue) { return isBeyondNoise(atNodes, isovalue, this->Noise); });
  const BernsteinForm polynomial = formOf(this->Source.domain, sampled.element);
  const auto at = [&](const std::vector<ReferencePoint>& points)
  { return fieldOf(this->valuesAt(part, points)); };
  return hop::losesComponents({ this->Source.domain, lattice, atNodes, polynomial, at }, reached);
}

} // namespace hop
