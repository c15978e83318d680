#include "Surface/Anchor.h"

#include "ElementCases.h"
#include "Support/Random.h"
#include "Surface/Energy.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hop::testing
{
namespace
{

class Anchored : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(Anchor, Anchored, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

/// Largest distances from the isosurface, over many places from which the surface is sought.
struct Errors
{
  /// Of the places to which anchors lead, and of the positions of patches.
  double place = 0.0, position = 0.0;
};

/// \param distance from each place to its isosurface, to first order
Errors errorsAt(const ElementMesh& mesh, double distance)
{
  Random random(3);
  Errors result;
  for (int n = 0; n < 200; ++n)
  {
    const int element = n % static_cast<int>(mesh.elements.size());
    const Location place{ element,
      insidePoint(
        mesh.elements[element].domain, { random.uniform(), random.uniform(), random.uniform() }) };
    const Jet jet = evaluateHessian(mesh.form(element), place.u);
    const double slope = length(fieldPoint(jet, 0.0).gradient);
    const double isovalue = jet.value.w + distance * slope;
    hop::Anchor anchor;
    Patch patch;
    EXPECT_TRUE(anchorPatch(place, jet, isovalue, anchor, patch));
    const glm::dvec3 u = place.u.xyz +
      glm::dmat3(anchor.pull) * (static_cast<double>(anchor.offset) * glm::dvec3(patch.normal));
    const FieldPoint at = fieldPoint(evaluateHessian(mesh.form(element), { u }), isovalue);
    result.place = std::max(result.place, std::abs(at.value) / length(at.gradient));
    // By one more step of Newton's method in the world, which is good to second order.
    const glm::dvec3 foot =
      at.map.position.xyz - at.value / glm::pow(length(at.gradient), 2.0) * at.gradient.xyz;
    const glm::dvec3 error = foot - patch.position;
    result.position =
      std::max(result.position, std::abs(glm::dot(error, at.gradient.xyz)) / length(at.gradient));
  }
  return result;
}

TEST_P(Anchored, LeadsToTheSurfaceToThirdOrder)
{
  MeshRecipe recipe;
  recipe.domain = this->GetParam();
  recipe.degrees = { 3, 3, 3 };
  recipe.map = wavyMap(0.1);
  // No place where the gradient vanishes.
  recipe.field = [](const glm::dvec3& x) { return x.x + 0.2 * x.y * x.y + 0.1 * x.x * x.z; };
  const ElementMesh mesh = makeMesh(recipe);
  const Errors far = errorsAt(mesh, 0.08);
  const Errors near = errorsAt(mesh, 0.02);
  // To third order a quarter of the distance leaves a 64th of the error, to second order a 16th.
  EXPECT_LE(near.place, far.place / 40.0);
  EXPECT_LE(near.position, far.position / 40.0);
  EXPECT_LE(near.place, 1e-4);
  EXPECT_LE(near.position, 1e-4);
}

TEST_P(Anchored, TellsAboutPlacesAround)
{
  // In straight elements the extrapolation is as exact as the patch: positions to third order, normals to second.
  MeshRecipe recipe;
  recipe.domain = this->GetParam();
  recipe.degrees = { 3, 3, 3 };
  recipe.field = [](const glm::dvec3& x) { return x.x + 0.2 * x.y * x.y + 0.1 * x.x * x.z * x.z; };
  const ElementMesh mesh = makeMesh(recipe);
  const auto largestErrors = [&](double distance)
  {
    Random random(5);
    double position = 0.0;
    double normal = 0.0;
    for (int n = 0; n < 200; ++n)
    {
      const int element = n % static_cast<int>(mesh.elements.size());
      const ReferencePoint u = insidePoint(
        mesh.elements[element].domain, { random.uniform(), random.uniform(), random.uniform() });
      const Jet jet = evaluateHessian(mesh.form(element), u);
      hop::Anchor known;
      Patch patch;
      EXPECT_TRUE(anchorPatch({ element, u }, jet, jet.value.w, known, patch));
      const auto tangents = tangentsOf(patch.normal);
      const double angle = 2.0 * Pi * random.uniform();
      const glm::dvec3 step =
        std::cos(angle) * glm::dvec3(tangents[0]) + std::sin(angle) * glm::dvec3(tangents[1]);
      const ReferencePoint other{ u.xyz + glm::dmat3(known.pull) * (distance * step) };
      hop::Anchor guessed;
      Patch guess;
      continuePatch(known, patch, { element, other }, guessed, guess);
      hop::Anchor there;
      Patch found;
      EXPECT_TRUE(anchorPatch(
        { element, other }, evaluateHessian(mesh.form(element), other), jet.value.w, there, found));
      // Positions may differ along the surface: they are feet of slightly different normals.
      position = std::max(
        position, std::abs(glm::dot(guess.position - found.position, glm::dvec3(found.normal))));
      normal = std::max<double>(normal, glm::distance(guess.normal, found.normal));
      EXPECT_EQ(guessed.place.element, element);
      EXPECT_NEAR(guessed.offset, there.offset, 0.1 * distance);
      EXPECT_NEAR(guess.curvatureMagnitude(), found.curvatureMagnitude(), 0.2);
    }
    return std::array<double, 2>{ position, normal };
  };
  const auto far = largestErrors(0.08);
  const auto near = largestErrors(0.02);
  EXPECT_LE(near[0], far[0] / 30.0);
  EXPECT_LE(near[1], far[1] / 10.0);
  EXPECT_LE(near[0], 1e-5);
  EXPECT_LE(near[1], 1e-3);
}

} // namespace
} // namespace hop::testing
