#include "Edges/FaceJumps.h"

#include "AnalyticFields.h"
#include "ElementCases.h"
#include "TestMeshes.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

constexpr double spacing = 0.1;

/// \param matching false: the faces at x = 0 do not match, and a locator finds what lies behind them
FaceJumps jumpsOf(
  const ElementMesh& mesh, bool matching = true, const ParallelFor& parallelFor = {})
{
  const FaceLocator locator(mesh, 0.0, parallelFor);
  Isosurface surface{ &mesh, 0.0, 1e-9 };
  surface.locator = matching ? nullptr : &locator;
  const SurfaceProxy proxy(surface, { spacing, 0.0 },
    findSurfaceBoxes(mesh, 0.0, 6.0 * spacing, parallelFor), parallelFor);
  return findFaceJumps(surface, proxy, parallelFor);
}

/// Two halves of a cube with a plane each, z = tilt y + slope x + height.
struct Halves
{
  double slopeLeft = 0.0;
  double slopeRight = 0.0;
  double step = 0.0; ///< of the right half's height, in units of the spacing
  double tilt = 0.0;

  MeshRecipe half(Domain domain, double slope, double height) const
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.degrees = { 1, 1, 1 };
    recipe.field = [=, tilt = this->tilt](const glm::dvec3& x)
    { return x.z - tilt * x.y - slope * x.x - height; };
    return recipe;
  }
  MeshRecipe left(Domain domain) const { return this->half(domain, this->slopeLeft, 0.03); }
  MeshRecipe right(Domain domain) const
  {
    return this->half(domain, this->slopeRight, 0.03 + this->step * spacing);
  }

  ElementMesh mesh(Domain domain) const
  {
    ElementMesh result;
    appendBox(result, this->left(domain), { -1, -1, -1 }, { 0, 1, 1 });
    appendBox(result, this->right(domain), { 0, -1, -1 }, { 1, 1, 1 });
    findFaceNeighbors(result, 1e-9);
    return result;
  }
};

/// Whether a face of an element lies in the plane x = 0.
bool isInMiddle(const ElementMesh& mesh, int element, int face)
{
  const Face& which = mesh.face(element, face);
  for (int c = 0; c < which.cornerCount; ++c)
  {
    const Jet jet = evaluateHessian(
      mesh.form(element), facts(mesh.elements[element].domain).corners[which.corners[c]]);
    if (std::abs(fieldPoint(jet, 0.0).map.position.xyz.x) > 1e-9)
    {
      return false;
    }
  }
  return true;
}

struct Extremes
{
  float least = std::numeric_limits<float>::infinity();
  float most = 0.0f;

  void add(float value)
  {
    this->least = std::min(this->least, value);
    this->most = std::max(this->most, value);
  }
};

/// What was found at the faces in the middle through which the surface passes, and at all others.
struct Found
{
  Extremes tolerances;
  Extremes angles;
  Extremes otherTolerances;
  Extremes otherAngles;
  int faces = 0;
};

/// A face in the middle that nothing was seen at counts with the others: the surface may not pass it.
Found foundIn(const ElementMesh& mesh, const FaceJumps& jumps)
{
  Found found;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
  {
    const auto count = static_cast<int>(facts(mesh.elements[e].domain).faces.size());
    for (int f = 0; f < count; ++f)
    {
      const float tolerance = jumps.jumpTolerances[faceSlot(e, f)];
      const float angle = jumps.dihedralAngles[faceSlot(e, f)];
      const bool seen = isInMiddle(mesh, e, f) && (angle > 0.0f || std::isfinite(tolerance));
      (seen ? found.tolerances : found.otherTolerances).add(tolerance);
      (seen ? found.angles : found.otherAngles).add(angle);
      found.faces += seen;
    }
  }
  return found;
}

constexpr float infinity = std::numeric_limits<float>::infinity();

class FaceJumpsIn : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(FaceJumps, FaceJumpsIn, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(FaceJumpsIn, AreNotWhereFieldsAreSmooth)
{
  MeshRecipe recipe;
  recipe.domain = this->GetParam();
  recipe.cells = 3;
  recipe.field = sphere({ 0.1, -0.13, 0.07 }, 0.7).field;
  const ElementMesh mesh = makeMesh(recipe);
  const FaceJumps jumps = jumpsOf(mesh);
  ASSERT_EQ(jumps.jumpTolerances.size(), mesh.elements.size() * MaximumFaces);
  ASSERT_EQ(jumps.dihedralAngles.size(), mesh.elements.size() * MaximumFaces);
  for (const float tolerance : jumps.jumpTolerances)
  {
    EXPECT_EQ(tolerance, infinity);
  }
  for (const float angle : jumps.dihedralAngles)
  {
    EXPECT_EQ(angle, 0.0f);
  }
}

TEST_P(FaceJumpsIn, AreNotPassedWhereTheyAreLarger)
{
  const ElementMesh mesh = Halves{ 0.0, 0.0, LargestJumpPerSpacing + 0.05 }.mesh(this->GetParam());
  const Found found = foundIn(mesh, jumpsOf(mesh));
  EXPECT_GE(found.faces, 2);
  EXPECT_FLOAT_EQ(found.tolerances.least, static_cast<float>(LargestJumpPerSpacing * spacing));
  EXPECT_FLOAT_EQ(found.tolerances.most, static_cast<float>(LargestJumpPerSpacing * spacing));
  EXPECT_EQ(found.angles.most, 0.0f);
  EXPECT_EQ(found.otherTolerances.least, infinity);
  EXPECT_EQ(found.otherAngles.most, 0.0f);
}

/// A jump that the surface passes counts as an angle below that of a crease.
TEST_P(FaceJumpsIn, ThatAreSmallerArePassed)
{
  const ElementMesh mesh = Halves{ 0.0, 0.0, LargestJumpPerSpacing - 0.03 }.mesh(this->GetParam());
  const Found found = foundIn(mesh, jumpsOf(mesh));
  EXPECT_GE(found.faces, 2);
  EXPECT_EQ(found.tolerances.least, infinity);
  EXPECT_GT(found.angles.least, 0.9 * CreaseAngle);
  EXPECT_LT(found.angles.most, CreaseAngle);
  EXPECT_EQ(found.otherAngles.most, 0.0f);
}

/// On a surface that is steep along the face the sides are nearer to each other than the jump along the face is long.
TEST_P(FaceJumpsIn, AreMeasuredAlongTheFace)
{
  for (const double step : { LargestJumpPerSpacing - 0.05, LargestJumpPerSpacing + 0.05 })
  {
    const ElementMesh mesh = Halves{ 0.8, 0.8, step }.mesh(this->GetParam());
    const Found found = foundIn(mesh, jumpsOf(mesh));
    EXPECT_GE(found.faces, 2);
    EXPECT_EQ(std::isfinite(found.tolerances.least), step > LargestJumpPerSpacing) << step;
    EXPECT_EQ(std::isfinite(found.tolerances.most), step > LargestJumpPerSpacing) << step;
  }
}

/// The angle of a roof; with a tilt its ridge is inclined.
TEST_P(FaceJumpsIn, KnowTheDihedralAngleOfARoof)
{
  for (const double slope : { 0.05, 0.5, 2.0 })
  {
    for (const double tilt : { 0.0, 0.3 })
    {
      const Halves halves{ slope, -slope, 0.0, tilt };
      const ElementMesh mesh = halves.mesh(this->GetParam());
      const Found found = foundIn(mesh, jumpsOf(mesh));
      const glm::dvec3 left = glm::normalize(glm::dvec3(-slope, -tilt, 1.0));
      const glm::dvec3 right = glm::normalize(glm::dvec3(slope, -tilt, 1.0));
      const double expected = std::acos(glm::dot(left, right));
      EXPECT_GE(found.faces, 2);
      EXPECT_NEAR(found.angles.least, expected, 1e-3) << slope << " " << tilt;
      EXPECT_NEAR(found.angles.most, expected, 1e-3) << slope << " " << tilt;
      EXPECT_EQ(found.tolerances.least, infinity);
      EXPECT_EQ(found.otherAngles.most, 0.0f);
      EXPECT_EQ(found.otherTolerances.least, infinity);
    }
  }
}

/// 1.5 degrees are the smallest angle.
TEST(FaceJumps, ForgetAnglesThatNobodySees)
{
  for (const double degrees : { 1.0, 2.0 })
  {
    const double slope = std::tan(glm::radians(0.5 * degrees));
    const ElementMesh mesh = Halves{ slope, -slope }.mesh(Domain::Hexahedron);
    const double found = foundIn(mesh, jumpsOf(mesh)).angles.most;
    EXPECT_NEAR(glm::degrees(found), degrees > 1.5 ? degrees : 0.0, 0.01);
  }
}

/// Faces that do not match are judged place by place, and so have a tolerance.
TEST(FaceJumps, KnowTheDihedralAngleWhereFacesDoNotMatch)
{
  const Halves halves{ 0.5, -0.5 };
  const ElementMesh mesh =
    hangingMesh(halves.left(Domain::Hexahedron), halves.right(Domain::Hexahedron));
  const Found found = foundIn(mesh, jumpsOf(mesh, false));
  EXPECT_GE(found.faces, 3);
  EXPECT_NEAR(found.angles.least, 2.0 * std::atan(0.5), 1e-3);
  EXPECT_NEAR(found.angles.most, 2.0 * std::atan(0.5), 1e-3);
  EXPECT_FLOAT_EQ(found.tolerances.most, static_cast<float>(LargestJumpPerSpacing * spacing));
  EXPECT_EQ(found.otherAngles.most, 0.0f);
}

TEST(FaceJumps, TellWhetherTheFieldIsDiscontinuous)
{
  const auto jumps = [](double slope, double step) {
    return jumpsOf(Halves{ 0.0, slope, step }.mesh(Domain::Hexahedron)).isDiscontinuous;
  };
  EXPECT_TRUE(jumps(0.0, 2.0));
  EXPECT_FALSE(jumps(0.0, 0.0));
  // A crease alone, and one beside a step that the surface passes.
  EXPECT_FALSE(jumps(0.5, 0.0));
  EXPECT_FALSE(jumps(0.5, 0.1));
}

TEST(FaceJumps, TellHowFarTheSidesAreApartAlongTheNormal)
{
  const auto largest = [](double slope, double step, double tilt) {
    return jumpsOf(Halves{ slope, slope, step, tilt }.mesh(Domain::Hexahedron)).largestJump;
  };
  EXPECT_NEAR(largest(0.0, 0.15, 0.0), 0.15, 1e-6);
  EXPECT_NEAR(largest(0.0, 2.0, 0.0), 2.0, 1e-6);
  EXPECT_NEAR(largest(0.0, 0.3, 1.0), 0.3 / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(largest(0.5, 0.0, 0.0), 0.0, 1e-12);
  // At a crease steps too small to matter are seen, too.
  const double beside = jumpsOf(Halves{ 0.0, 0.5, 0.05 }.mesh(Domain::Hexahedron)).largestJump;
  EXPECT_NEAR(beside, 0.05, 1e-6);
}

TEST(FaceJumps, CountWhereTheSurfaceEnds)
{
  const auto passages = [](double step)
  {
    const ElementMesh mesh = Halves{ 0.0, 0.0, step }.mesh(Domain::Hexahedron);
    const Isosurface surface{ &mesh, 0.0, 1e-9 };
    const SurfaceProxy proxy(
      surface, { spacing, 0.0 }, findSurfaceBoxes(mesh, 0.0, 6.0 * spacing, {}), {});
    return countFacePassages(mesh, proxy, findFaceJumps(surface, proxy, {}), threadedFor(3));
  };
  // A plane through two boxes reaches the face between them from both; at the mesh's own end nothing is missing.
  EXPECT_EQ(passages(0.0).reached, 2);
  EXPECT_EQ(passages(0.0).ended, 0);
  EXPECT_EQ(passages(2.0).reached, 2);
  EXPECT_EQ(passages(2.0).ended, 2);
}

TEST(FaceJumps, SurfaceEndsAroundElements)
{
  const ElementMesh mesh = Halves{ 0.0, 0.0, 0.0 }.mesh(Domain::Tetrahedron);
  FaceJumps jumps = jumpsOf(mesh);
  const std::vector<float> before = jumps.jumpTolerances;
  constexpr int inMiddle = 2;
  endAround({ &mesh }, {}, jumps);
  EXPECT_FALSE(jumps.isDiscontinuous);
  endAround({ &mesh }, { inMiddle, inMiddle }, jumps);
  EXPECT_TRUE(jumps.isDiscontinuous);
  for (int element = 0; element < static_cast<int>(mesh.elements.size()); ++element)
  {
    for (int face = 0; face < 4; ++face)
    {
      const std::size_t slot = faceSlot(element, face);
      const int behind = mesh.neighbor(element, face).element;
      const bool isAround = behind >= 0 && (element == inMiddle || behind == inMiddle);
      EXPECT_EQ(jumps.jumpTolerances[slot], isAround ? 0.0f : before[slot]);
    }
  }
}

/// Beside a hanging node the large element's face, and those of all small ones behind it.
TEST(FaceJumps, SurfaceEndsAroundElementsThatTheMeshDoesNotJoin)
{
  MeshRecipe recipe;
  recipe.field = [](const glm::dvec3& x) { return x.z - 0.3 * x.x; };
  const ElementMesh mesh = hangingMesh(recipe, recipe);
  const FaceLocator locator(mesh, 0.0, {});
  Isosurface surface{ &mesh, 0.0, 1e-9 };
  surface.locator = &locator;
  FaceJumps jumps = jumpsOf(mesh, false);
  endAround(surface, { 0 }, jumps);
  int ending = 0;
  for (int element = 0; element < static_cast<int>(mesh.elements.size()); ++element)
  {
    for (int face = 0; face < 6; ++face)
    {
      const bool isBetween = isInMiddle(mesh, element, face);
      EXPECT_EQ(jumps.jumpTolerances[faceSlot(element, face)] == 0.0f, isBetween);
      ending += isBetween ? 1 : 0;
    }
  }
  EXPECT_EQ(ending, 5);
}

TEST(FaceJumps, DoNotDependOnThreads)
{
  const ElementMesh mesh = Halves{ 0.5, -0.5, 0.3 }.mesh(Domain::Tetrahedron);
  const FaceJumps serial = jumpsOf(mesh);
  const FaceJumps threaded = jumpsOf(mesh, true, threadedFor(3));
  EXPECT_EQ(threaded.jumpTolerances, serial.jumpTolerances);
  EXPECT_EQ(threaded.dihedralAngles, serial.dihedralAngles);
  EXPECT_EQ(threaded.evaluations, serial.evaluations);
}

} // namespace
} // namespace hop::testing
