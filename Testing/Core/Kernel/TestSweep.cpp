#include "AvailableParts.h"

#include "Support/Random.h"
#include "Surface/Energy.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hop::testing
{
namespace
{

using kernel::Seen;
using kernel::SweepBlock;
using kernel::SweepLanes;

class SweepParts : public ::testing::TestWithParam<CompiledParts>
{
};

TEST_P(SweepParts, InverseSquareRootsAreThoseOfSinglePrecision)
{
  float x[SweepLanes], result[SweepLanes];
  for (float first = std::numeric_limits<float>::min(); first < 1e37f; first *= 7.3f)
  {
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      x[lane] = first * (1.0f + 0.37f * static_cast<float>(lane));
    }
    GetParam().parts.inverseSquareRoot(x, result);
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      const double exact = 1.0 / std::sqrt(static_cast<double>(x[lane]));
      EXPECT_NEAR(result[lane], exact, 3e-7 * exact) << x[lane];
    }
  }
}

/// What pairEnergy() of Sweep.h returns for eight numbers.
struct PairEnergies
{
  float energy[SweepLanes], first[SweepLanes], second[SweepLanes];
};

PairEnergies pairEnergies(const KernelParts& parts, const float (&t)[SweepLanes])
{
  float result[3][SweepLanes];
  parts.pairEnergy(t, result[0]);
  PairEnergies all;
  std::copy_n(result[0], SweepLanes, all.energy);
  std::copy_n(result[1], SweepLanes, all.first);
  std::copy_n(result[2], SweepLanes, all.second);
  return all;
}

TEST_P(SweepParts, PairEnergyAndItsDerivativesAreThoseOfTheEnergy)
{
  // Half a dozen roundings of single precision (6e-8 each), of terms as large as the cotangent; the derivatives have
  // its square and cube.
  constexpr double tolerance = 5e-7;
  constexpr int steps = 5000;
  for (int step = 1; step <= steps; step += SweepLanes)
  {
    float t[SweepLanes];
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      const float r = static_cast<float>(std::min(step + lane, steps)) / steps;
      t[lane] = r * r;
    }
    const PairEnergies actual = pairEnergies(GetParam().parts, t);
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      const double r = std::sqrt(static_cast<double>(t[lane]));
      const double cotangent = 1.0 / std::tan(0.5 * Pi * r);
      const double first = pairEnergyDerivative(r) / r;
      const double second = (pairEnergySecondDerivative(r) - first) / (r * r);
      EXPECT_NEAR(actual.energy[lane], pairEnergy(r), tolerance * (1.0 + cotangent)) << r;
      EXPECT_NEAR(actual.first[lane], first, -3.0 * tolerance * first) << r;
      EXPECT_NEAR(actual.second[lane], second, 4.0 * tolerance * second) << r;
    }
  }
}

TEST_P(SweepParts, PairForcesEndExactlyAtRangeOne)
{
  const float one[SweepLanes] = { 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f };
  const PairEnergies actual = pairEnergies(GetParam().parts, one);
  for (int lane = 0; lane < SweepLanes; ++lane)
  {
    EXPECT_NEAR(actual.energy[lane], 0.0, 3e-7);
    EXPECT_EQ(actual.first[lane], 0.0f);
    EXPECT_EQ(actual.second[lane], 0.0f);
  }
}

/// H^-1 g by eigenvectors, eigenvalues raised to `floor`.
glm::dvec2 newtonStep(const glm::dmat2& h, const glm::dvec2& g, double floor)
{
  const double angle = 0.5 * std::atan2(2.0 * h[0][1], h[0][0] - h[1][1]);
  const glm::dvec2 axes[2] = { { std::cos(angle), std::sin(angle) },
    { -std::sin(angle), std::cos(angle) } };
  glm::dvec2 step(0.0);
  for (const glm::dvec2& axis : axes)
  {
    step += glm::dot(g, axis) / std::max(glm::dot(axis, h * axis), floor) * axis;
  }
  return step;
}

TEST_P(SweepParts, NewtonStepsRaiseEigenvaluesToTheFloor)
{
  constexpr float floor = 2.0f;
  Random random(2);
  for (int n = 0; n < 100; ++n)
  {
    float h[3][SweepLanes], g[2][SweepLanes], actual[2][SweepLanes];
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      for (auto& entry : h)
      {
        entry[lane] = static_cast<float>(20.0 * random.uniform() - 5.0);
      }
      for (auto& entry : g)
      {
        entry[lane] = static_cast<float>(2.0 * random.uniform() - 1.0);
      }
    }
    // One that is the same in all directions, one that is soft in all.
    h[1][0] = 0.0f;
    h[2][0] = h[0][0];
    h[0][1] = h[1][1] = h[2][1] = -3.0f;
    GetParam().parts.newtonStep(h[0], g[0], floor, actual[0]);
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      const glm::dmat2 hessian(h[0][lane], h[1][lane], h[1][lane], h[2][lane]);
      const glm::dvec2 expected = newtonStep(hessian, { g[0][lane], g[1][lane] }, floor);
      EXPECT_NEAR(actual[0][lane], expected.x, 4e-6);
      EXPECT_NEAR(actual[1][lane], expected.y, 4e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SweepParts, ::testing::ValuesIn(availableParts()), nameOfParts);

/// Eight particles, and neighbours about them.
struct Scene
{
  static constexpr int neighborCount = 14;
  SweepBlock block{};
  std::vector<std::int32_t> neighbors;
  std::vector<Seen> seen;

  /// \param bend size of the second fundamental form, times the spacing
  Scene(std::uint64_t seed, double bend)
  {
    Random random(seed);
    const auto within = [&](double size)
    { return static_cast<float>(size * (2.0 * random.uniform() - 1.0)); };
    this->block.count = SweepLanes;
    this->block.neighborCount = neighborCount;
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      const glm::vec3 normal = glm::normalize(glm::vec3(within(1.0), within(1.0), 1.5f));
      const glm::vec3 e1 = glm::normalize(glm::cross(normal, glm::vec3(0.3f, 1.0f, 0.0f)));
      const glm::vec3 e2 = glm::cross(normal, e1);
      const glm::vec3 base(within(5.0), within(5.0), within(5.0));
      for (int axis = 0; axis < 3; ++axis)
      {
        this->block.base[axis][lane] = base[axis];
        this->block.normal[axis][lane] = normal[axis];
        this->block.tangents[0][axis][lane] = e1[axis];
        this->block.tangents[1][axis][lane] = e2[axis];
        this->block.shape[axis][lane] = within(bend);
      }
      this->block.inverseSpacing[lane] = 1.0f + within(0.2);
      this->block.relaxation[lane] = 1.1f;
      this->block.farthest[lane] = 0.4f;
      this->block.moved[0][lane] = within(0.1);
      this->block.moved[1][lane] = within(0.1);
      this->block.particle[lane] = lane;
      this->seen.push_back({ { base.x, base.y, base.z }, this->block.inverseSpacing[lane],
        { normal.x, normal.y, normal.z }, 0.0f });
    }
    this->neighbors.resize(neighborCount * SweepLanes);
    for (int n = 0; n < neighborCount; ++n)
    {
      for (int lane = 0; lane < SweepLanes; ++lane)
      {
        this->neighbors[n * SweepLanes + lane] = static_cast<std::int32_t>(this->seen.size());
        this->seen.push_back(this->neighborOf(lane, 6.2832 / neighborCount * n,
          0.6 + 1.2 * random.uniform(), { within(1.0), within(1.0), within(1.0) }));
      }
    }
  }

  /// \param tilt what is added to the normal
  Seen neighborOf(int lane, double angle, double distance, const glm::vec3& tilt) const
  {
    Seen other{};
    glm::vec3 normal;
    for (int axis = 0; axis < 3; ++axis)
    {
      normal[axis] = this->block.normal[axis][lane] + tilt[axis];
      other.position[axis] = static_cast<float>(this->block.base[axis][lane] +
        distance *
          (std::cos(angle) * this->block.tangents[0][axis][lane] +
            std::sin(angle) * this->block.tangents[1][axis][lane]));
    }
    normal = glm::normalize(normal);
    std::copy_n(&normal.x, 3, other.normal);
    other.inverseSpacing = this->block.inverseSpacing[lane] * 1.1f;
    return other;
  }
};

/// One step of one particle in double precision, by the words of Kernels.h.
struct Reference
{
  double energy = 0.0;
  glm::dvec2 moved;
  glm::dvec3 position;

  Reference(const Scene& scene, int lane)
    : Block(scene.block)
    , Lane(lane)
  {
    const glm::dvec2 from(this->Block.moved[0][lane], this->Block.moved[1][lane]);
    const glm::dvec3 here = this->positionAt(from);
    const std::array<glm::dvec3, 2> tangents = this->tangentsAt(from);
    glm::dvec2 gradient(0.0);
    glm::dmat2 hessian(0.0);
    for (int n = 0; n < this->Block.neighborCount; ++n)
    {
      const Seen& other = scene.seen[scene.neighbors[n * SweepLanes + lane]];
      this->addPair(other, here, tangents, gradient, hessian);
    }
    constexpr double softest = 0.35 * 13.7;
    this->moved = from -
      static_cast<double>(this->Block.relaxation[lane]) * newtonStep(hessian, gradient, softest);
    const double length = glm::length(this->moved);
    this->moved *= std::min(1.0, this->Block.farthest[lane] / length);
    this->position = this->positionAt(this->moved);
  }

private:
  glm::dvec3 vectorOf(const float (&rows)[3][SweepLanes]) const
  {
    return { rows[0][this->Lane], rows[1][this->Lane], rows[2][this->Lane] };
  }
  glm::dvec2 bendAt(const glm::dvec2& x) const
  {
    const glm::dvec3 shape = this->vectorOf(this->Block.shape);
    return { shape[0] * x.x + shape[1] * x.y, shape[1] * x.x + shape[2] * x.y };
  }
  glm::dvec3 positionAt(const glm::dvec2& x) const
  {
    return this->vectorOf(this->Block.base) + x.x * this->vectorOf(this->Block.tangents[0]) +
      x.y * this->vectorOf(this->Block.tangents[1]) -
      0.5 * glm::dot(x, this->bendAt(x)) * this->vectorOf(this->Block.normal);
  }
  std::array<glm::dvec3, 2> tangentsAt(const glm::dvec2& x) const
  {
    const glm::dvec2 bend = this->bendAt(x);
    const glm::dvec3 normal = this->vectorOf(this->Block.normal);
    return { this->vectorOf(this->Block.tangents[0]) - bend.x * normal,
      this->vectorOf(this->Block.tangents[1]) - bend.y * normal };
  }
  void addPair(const Seen& other, const glm::dvec3& here, const std::array<glm::dvec3, 2>& tangents,
    glm::dvec2& gradient, glm::dmat2& hessian)
  {
    const glm::dvec3 d = here - glm::dvec3(other.position[0], other.position[1], other.position[2]);
    const double inverse = 0.5 * (this->Block.inverseSpacing[this->Lane] + other.inverseSpacing);
    const double r = std::max(HexagonalDistance * inverse * glm::length(d), 0.01);
    const double cosine = glm::dot(this->vectorOf(this->Block.normal),
      glm::dvec3(other.normal[0], other.normal[1], other.normal[2]));
    const double facing = std::clamp(2.0 * cosine, 0.0, 1.0);
    const double fade = facing * facing * (3.0 - 2.0 * facing);
    this->energy += fade * pairEnergy(r);
    const double slope = pairEnergyDerivative(r) / r;
    const double along = (pairEnergySecondDerivative(r) - slope) / glm::dot(d, d);
    const glm::dvec2 flat(glm::dot(d, tangents[0]), glm::dot(d, tangents[1]));
    gradient += fade * slope * flat;
    hessian += fade * (along * glm::outerProduct(flat, flat) + slope * glm::dmat2(1.0));
  }

  const SweepBlock& Block;
  int Lane;
};

class Sweep : public ::testing::TestWithParam<InstructionSet>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(availableInstructionSets().back()); }

  static void sweep(Scene& scene)
  {
    kernel::current().sweep(&scene.block, 1, scene.neighbors.data(), scene.seen.data());
  }
};

TEST_P(Sweep, TakesTheStepOfDoublePrecision)
{
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    Scene scene(seed, seed % 2 ? 0.0 : 0.5);
    const Scene before = scene;
    sweep(scene);
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", lane " << lane);
      const Reference expected(before, lane);
      EXPECT_NEAR(scene.block.energy[lane], expected.energy, 1e-5 * (1.0 + expected.energy));
      EXPECT_NEAR(scene.block.moved[0][lane], expected.moved.x, 2e-5);
      EXPECT_NEAR(scene.block.moved[1][lane], expected.moved.y, 2e-5);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(scene.seen[lane].position[axis], expected.position[axis], 2e-5);
      }
    }
  }
}

TEST_P(Sweep, LeavesParticlesOutOfReachWhereTheyAre)
{
  Scene scene(3, 0.5);
  for (const std::int32_t neighbor : scene.neighbors)
  {
    for (float& x : scene.seen[neighbor].position)
    {
      x += 100.0f;
    }
  }
  const Scene before = scene;
  sweep(scene);
  for (int lane = 0; lane < SweepLanes; ++lane)
  {
    EXPECT_NEAR(scene.block.energy[lane], 0.0, 1e-5);
    EXPECT_EQ(scene.block.moved[0][lane], before.block.moved[0][lane]);
    EXPECT_EQ(scene.block.moved[1][lane], before.block.moved[1][lane]);
  }
}

TEST_P(Sweep, WritesTheLanesInUseOnly)
{
  Scene scene(4, 0.0);
  scene.block.count = 3;
  const Scene before = scene;
  sweep(scene);
  for (int lane = 0; lane < SweepLanes; ++lane)
  {
    const bool same = std::equal(
      scene.seen[lane].position, scene.seen[lane].position + 3, before.seen[lane].position);
    EXPECT_EQ(same, lane >= 3) << lane;
  }
}

TEST_P(Sweep, StopsAtTheLargestDisplacement)
{
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    Scene scene(seed, 0.0);
    std::fill_n(scene.block.farthest, SweepLanes, 0.02f);
    sweep(scene);
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      const double length = std::hypot(scene.block.moved[0][lane], scene.block.moved[1][lane]);
      EXPECT_LE(length, 0.02 * (1.0 + 1e-6));
    }
  }
}

TEST_P(Sweep, IsFiniteForParticlesInOnePlace)
{
  Scene scene(5, 0.5);
  for (int n = 0; n < Scene::neighborCount; ++n)
  {
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      scene.block.moved[0][lane] = scene.block.moved[1][lane] = 0.0f;
      scene.seen[scene.neighbors[n * SweepLanes + lane]] = scene.seen[lane];
    }
  }
  sweep(scene);
  for (int lane = 0; lane < SweepLanes; ++lane)
  {
    EXPECT_NEAR(scene.block.energy[lane], Scene::neighborCount * pairEnergy(0.01),
      1e-3 * Scene::neighborCount);
    EXPECT_EQ(scene.block.moved[0][lane], 0.0f);
    EXPECT_EQ(scene.block.moved[1][lane], 0.0f);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Sweep, ::testing::ValuesIn(availableInstructionSets()), nameOfSet);

} // namespace
} // namespace hop::testing
