#pragma once

#include "Elements/BatchEvaluator.h"
#include "Elements/DerivedField.h"
#include "Elements/ExactField.h"
#include "Elements/ReferencePart.h"

#include <functional>
#include <optional>
#include <vector>

namespace hop
{

/// What a field's function is told of one point: x, and one value and one gradient in world space a component.
struct FieldPoint
{
  glm::dvec3 x{ 0.0 };
  std::vector<double> values;
  /// du_i/dx_j: a vector a component.
  std::vector<glm::dvec3> gradients;
};

/// A field made of another field, point by point.
using FieldFunction = std::function<double(const FieldPoint&)>;

/// The function of a quantity, or of its square where that is derived.
/// \param quantity neither Value nor Expression
FieldFunction functionOf(Quantity quantity);

/// A part of an element with a polynomial in the place of a field.
struct SampledPart
{
  /// Its coordinates are those of the part.
  DerivedElement element;
  /// Largest difference of polynomial and field that was seen, in the unit of the field.
  double error = 0.0;
  /// Whether the error is within the tolerance.
  bool isResolved = false;
  /// Whether the field may have an isovalue on the part.
  bool canHoldSurface = true;
  /// Whether the field is on one side of an isovalue at nodes of a lattice that hang together, and the polynomial at none
  /// of them. Never true of what is resolved.
  bool losesComponents = false;
};

struct SamplingLattice;

/// Fields of elements by interpolation, for what is no polynomial of low degree: on a part of the element the polynomial
/// is taken that has the field's values at the nodes of a lattice, of the lowest degree that holds the field. The error is seen
/// at points between the nodes, but not proven: a field that bends much faster between two of these points would be
/// missed. Derivation: Documentation/algorithm.md, section Derived fields.
class FieldSampler
{
public:
  /// \param function of the quantity
  /// \param noise values of the field that differ less cannot be told apart
  /// \pre all arguments outlive the sampler
  FieldSampler(const SourceElement& source, Quantity quantity, const FieldFunction& function,
    double noise, StandIn standIn = StandIn::Surface);

  /// Parts that cannot hold surface are left as they are at a low degree.
  /// \param canHoldSurface whether the field has an isovalue in a range
  /// \param isovalues of the field; what is not resolved is searched for components of these that are lost
  SampledPart sample(const ReferencePart& part,
    const std::function<bool(const Range&)>& canHoldSurface,
    const std::vector<double>& isovalues = {});

private:
  using Samples = std::vector<Coefficient>;

  Samples valuesAt(const ReferencePart& part, const std::vector<ReferencePoint>& points);
  Samples valuesAt(const ReferencePart& part, const SamplingLattice& lattice);
  std::vector<JetBatch> homogeneousAt(const std::vector<ReferencePoint>& points) const;
  template <class RowOf>
  Samples samplesOf(std::size_t count, const RowOf& rowOf);
  template <class RowOf>
  std::vector<double> fieldAt(std::size_t count, const RowOf& rowOf);
  SampledPart interpolated(const ReferencePart& part, int degree, const Samples& checks);
  bool losesComponents(const SampledPart& sampled, const ReferencePart& part,
    const SamplingLattice& lattice, const std::vector<double>& isovalues);
  void judge(SampledPart& sampled, const Samples& checks) const;
  double toleranceOf(const Samples& checks) const;

  const SourceElement& Source;
  Quantity ItsQuantity;
  const FieldFunction& Function;
  double Noise;
  StandIn ItsStandIn;
  /// Four components of the source each: x, y, z, u_0; u_1, ...
  std::vector<std::vector<Coefficient>> Groups;
  /// The control values of one component after the other.
  std::vector<double> Components;
  /// Of a source with a collapsed edge: its derivatives as homogeneousDerivatives() gives them.
  std::optional<ExactSource> Homogeneous;
  /// Whether derivatives are finite wherever valuesAt() has been asked.
  bool AreDerivativesFinite = true;
  /// Where to begin: the next part is about as smooth as the last one.
  int FirstDegree = 0;
};

} // namespace hop
