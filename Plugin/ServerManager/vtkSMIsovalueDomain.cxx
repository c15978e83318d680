#include "vtkSMIsovalueDomain.h"

#include "vtkHighOrderParticleIsosurface.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVCrossedCellsInformation.h"
#include "vtkPVQuantileInformation.h"
#include "vtkProcessModule.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

/// The number nearest to a value that has no digits below the third one of a range: 0.293 for 0.2932038 and a range
/// of 0.9. Division by a power of ten leaves the decimal that a user reads; multiplication by 0.001 would not.
double roundedToRange(double value, double range)
{
  // Digits of the range, without unit. More would show rounding errors of the quantiles as if they meant something,
  // fewer would move the value by more than a hundredth of the range. Chosen for how it reads.
  constexpr int digits = 3;
  const double exponent = digits - 1 - std::floor(std::log10(range));
  const double scale = std::pow(10.0, std::abs(exponent));
  const double rounded =
    exponent >= 0.0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
  // Ranges next to the ends of what doubles hold have no such powers.
  return std::isfinite(rounded) ? rounded + 0.0 : value;
}

/// Whether values lie alike on both sides of their middle, and most of them near it, as around a saddle (xy), where
/// planes cross (xyz) or where a field is flat (x^3). There sheets of the isosurface of the middle cross, or it is
/// singular otherwise.
bool isCrowdedInItsMiddle(vtkPVQuantileInformation* values, double middle, double range)
{
  // Largest difference between the two halves, share of the range. Smaller: what nodes happen to sample counts as a
  // difference; larger: skewed fields count as symmetric. Chosen by experiment.
  constexpr double likeness = 0.06;
  // Largest share of the range in which the middle half of the values lies. It is 0.5 where a field rises evenly, 0.43
  // for a distance across a torus, 0.3 and less for the fields above. Larger: even fields are moved off their middle.
  constexpr double crowded = 0.36;
  const auto isBalanced = [&](double share)
  {
    const double sum = values->GetQuantile(share) + values->GetQuantile(1.0 - share);
    return std::abs(sum - 2.0 * middle) <= likeness * range;
  };
  return isBalanced(0.25) && isBalanced(0.4) &&
    values->GetQuantile(0.75) - values->GetQuantile(0.25) < crowded * range;
}

/// A value that shows the field: the middle between the quantiles next to the ends of the values. Fields that are
/// symmetric about 0, or crowded in their middle, often have a saddle there, where sheets of the isosurface cross: a
/// twentieth of the range beside it there is none.
double isovalueBetween(double low, double high, vtkPVQuantileInformation* values)
{
  // Share of the range, without unit. Smaller: near the saddle of xyz the surface still bends too fast for the default
  // spacing; larger: the value may leave the range in which most of a skewed field lies. Chosen by experiment.
  constexpr double aside = 0.05;
  const double range = high - low;
  const double middle = 0.5 * (low + high);
  if (!(range > 0.0) || !std::isfinite(range))
  {
    return middle;
  }
  const double isovalue = roundedToRange(middle, range);
  const bool isSingular =
    (isovalue == 0.0 && low < 0.0) || isCrowdedInItsMiddle(values, middle, range);
  return isSingular ? roundedToRange(isovalue + aside * range, range) : isovalue;
}

/// 0 for values beyond what doubles hold, as derivatives of large values may be; never -0, which panels show.
double finiteOrZero(double value)
{
  return std::isfinite(value) ? value + 0.0 : 0.0;
}

} // namespace

vtkStandardNewMacro(vtkSMIsovalueDomain);

vtkSMIsovalueDomain::vtkSMIsovalueDomain() = default;
vtkSMIsovalueDomain::~vtkSMIsovalueDomain() = default;

int vtkSMIsovalueDomain::SetDefaultValues(vtkSMProperty* property, bool useUnchecked)
{
  // Share of the values that is left out at either end. Larger shares hide small regions of extreme values, smaller
  // ones let a few wrong values decide. Chosen by experiment.
  constexpr double leftOut = 0.01;
  // Share of the cells in which the Q criterion is above its default, and Lambda 2 below its own. Larger shares show the
  // shear layers between vortices, too, smaller ones the cores of the strongest vortices alone. Chosen by experiment.
  constexpr double inVortices = 0.05;
  const int quantity = this->GetQuantity(true);
  vtkNew<vtkPVQuantileInformation> values;
  values->SetQuantity(quantity);
  values->SetExpression(this->GetExpression(true));
  this->Gather(values.Get());
  if (!values->HasValues())
  {
    // The array may lack the quantity, as a scalar lacks a divergence, or the formula may not be complete: what stands here
    // serves the next choice.
    return quantity == vtkHighOrderParticleIsosurface::VALUE
      ? this->SetMiddleOfRange(property, useUnchecked)
      : 1;
  }
  const double low = values->GetQuantile(leftOut);
  const double high = values->GetQuantile(1.0 - leftOut);
  double isovalue = isovalueBetween(low, high, values);
  const double largeQ = values->GetQuantile(1.0 - inVortices);
  const double smallLambda2 = values->GetQuantile(inVortices);
  if (quantity == vtkHighOrderParticleIsosurface::Q_CRITERION && largeQ > 0.0 && largeQ < high)
  {
    isovalue = roundedToRange(largeQ, largeQ);
  }
  if (quantity == vtkHighOrderParticleIsosurface::LAMBDA_2 && smallLambda2 < 0.0 &&
    smallLambda2 > low)
  {
    isovalue = roundedToRange(smallLambda2, -smallLambda2);
  }
  if (quantity == vtkHighOrderParticleIsosurface::VALUE)
  {
    isovalue = this->ValueOfLargeSurface(low, high, isovalue);
  }
  else if (low == high && low != 0.0) // of one cell, there is one sample
  {
    isovalue = roundedToRange(low, std::abs(low));
  }
  vtkSMPropertyHelper isovalues(property);
  isovalues.SetUseUnchecked(useUnchecked);
  isovalues.SetNumberOfElements(1);
  isovalues.Set(0, finiteOrZero(isovalue));
  this->Unchecked = { this->GetChoice(true), { finiteOrZero(isovalue) } };
  this->Checked = useUnchecked ? this->Checked : this->Unchecked;
  return 1;
}

/// ParaView's default; 0 where that is not finite, as of arrays that have NaN only: the filter then says what they are.
int vtkSMIsovalueDomain::SetMiddleOfRange(vtkSMProperty* property, bool useUnchecked)
{
  const int isSet = this->Superclass::SetDefaultValues(property, useUnchecked);
  vtkSMPropertyHelper isovalues(property);
  isovalues.SetUseUnchecked(useUnchecked);
  for (unsigned int i = 0; i < isovalues.GetNumberOfElements(); ++i)
  {
    isovalues.Set(i, finiteOrZero(isovalues.GetAsDouble(i)));
  }
  return isSet;
}

void vtkSMIsovalueDomain::Update(vtkSMProperty* changed)
{
  this->Superclass::Update(changed);
  this->FollowChoice(false);
  this->FollowChoice(true);
}

/// Sets the default of the array that is chosen, if the default for another array still stands. A value that the user
/// typed but has not applied yet counts as touched.
void vtkSMIsovalueDomain::FollowChoice(bool useUnchecked)
{
  vtkSMProperty* property = this->GetProperty();
  const std::string choice = this->GetChoice(useUnchecked);
  const std::vector<double> applied = vtkSMPropertyHelper(property).GetDoubleArray();
  const std::vector<double> typed = vtkSMUncheckedPropertyHelper(property).GetDoubleArray();
  if (useUnchecked && choice == this->GetChoice(false) && typed == applied)
  {
    this->Unchecked = this->Checked; // so it is where unchecked values were given up
  }
  const Default& last = useUnchecked ? this->Unchecked : this->Checked;
  const bool isUntouched =
    typed == this->Unchecked.Isovalue && (useUnchecked || applied == last.Isovalue);
  if (!last.Isovalue.empty() && choice != last.Choice && isUntouched)
  {
    this->SetDefaultValues(property, useUnchecked);
  }
}

std::string vtkSMIsovalueDomain::GetChoice(bool useUnchecked)
{
  vtkSMPropertyHelper array(this->GetRequiredProperty("ArraySelection"));
  vtkSMPropertyHelper component(this->GetRequiredProperty("ComponentSelection"));
  array.SetUseUnchecked(useUnchecked);
  component.SetUseUnchecked(useUnchecked);
  const char* name = array.GetInputArrayNameToProcess();
  const int quantity = this->GetQuantity(useUnchecked);
  return std::to_string(quantity) + " " + std::to_string(component.GetAsInt()) + " " +
    (quantity == vtkHighOrderParticleIsosurface::EXPRESSION ? this->GetExpression(useUnchecked)
                                                            : std::string(name ? name : ""));
}

std::string vtkSMIsovalueDomain::GetExpression(bool useUnchecked)
{
  vtkSMPropertyHelper expression(this->GetRequiredProperty("ExpressionSelection"));
  expression.SetUseUnchecked(useUnchecked);
  const char* text = expression.GetAsString();
  return text ? text : "";
}

int vtkSMIsovalueDomain::GetQuantity(bool useUnchecked)
{
  vtkSMPropertyHelper quantity(this->GetRequiredProperty("QuantitySelection"));
  quantity.SetUseUnchecked(useUnchecked);
  return quantity.GetAsInt();
}

/// Gathers what is to be known of the chosen array; false where nothing is gathered. Where every MPI rank runs the same
/// script nothing is: each rank would see only its own values and choose another isovalue.
template <class Information>
bool vtkSMIsovalueDomain::Gather(Information* information)
{
  vtkSMUncheckedPropertyHelper input(this->GetRequiredProperty("Input"));
  vtkSMUncheckedPropertyHelper choice(this->GetRequiredProperty("ArraySelection"));
  vtkSMUncheckedPropertyHelper component(this->GetRequiredProperty("ComponentSelection"));
  vtkSMSourceProxy* source =
    input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy(0)) : nullptr;
  const char* array = choice.GetInputArrayNameToProcess();
  if (!source || !array || vtkProcessModule::GetProcessModule()->GetSymmetricMPIMode())
  {
    return false;
  }
  information->SetPort(static_cast<int>(input.GetOutputPort(0)));
  information->SetArrayName(array);
  information->SetComponent(component.GetAsInt());
  return source->GatherInformation(information);
}

/// The isovalue, unless its surface is tiny beside those of other values: then the value nearest to the middle of the range
/// whose surface is large.
double vtkSMIsovalueDomain::ValueOfLargeSurface(double low, double high, double isovalue)
{
  // What is compared; without unit, chosen by experiment.
  constexpr double tiny =
    0.25; // share of the largest surface; a larger one leaves the middle where that shows enough
  constexpr double large = 0.5; // share of it that is enough
  const double range = high - low;
  if (!(range > 0.0) || !std::isfinite(range))
  {
    return isovalue;
  }
  std::vector<double> candidates{ isovalue };
  for (const double share :
    { 0.35, 0.65, 0.2, 0.8 }) // farther out surfaces are often small corners
  {
    candidates.push_back(roundedToRange(low + share * range, range));
  }
  vtkNew<vtkPVCrossedCellsInformation> crossed;
  crossed->SetIsovalues(candidates);
  if (!this->Gather(crossed.Get()) || crossed->GetSizes().size() != candidates.size())
  {
    return isovalue;
  }
  const std::vector<double>& sizes = crossed->GetSizes();
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  const auto enough =
    std::find_if(sizes.begin(), sizes.end(), [=](double size) { return size >= large * largest; });
  return sizes.front() < tiny * largest ? candidates[enough - sizes.begin()] : isovalue;
}
