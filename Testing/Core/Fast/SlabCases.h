#pragma once

#include "Fast/SlabPlan.h"
#include "Surface/DistributionParameters.h"
#include "Surface/Particles.h"
#include "TestMeshes.h"

#include <chrono>
#include <iosfwd>
#include <vector>

namespace hop::testing
{

constexpr double SlabTolerance = 1e-9;
/// Of the bar, across z, before it is turned: a fifth of its length.
constexpr double BarWidth = 0.2;
/// Workers wait for each other longer than messages take.
constexpr std::chrono::seconds LongestWait{ 120 };

/// Turns the z axis into the direction along which slabs follow each other.
glm::dmat3 barTurn();

/// A surface in a long bar, to be cut across.
struct SlabCase
{
  const char* name = "";
  Domain domain = Domain::Hexahedron;
  /// In the coordinates of the bar, which reaches from -1 to 1 along z.
  Field field;
  SizingFunction sizing;
  /// How far the cells are bent. Straight ones have faces at z = 0 and y = 0, where a field may have a crease.
  double bend = 0.1;
  /// By how much the values of every other element are raised.
  double jump = 0.0;
  /// Surfaces more than two spacings apart.
  std::vector<double> isovalues{ 0.0 };

  /// The same with particles farther apart.
  SlabCase coarse() const;
};

std::ostream& operator<<(std::ostream& out, const SlabCase& which);

/// A closed surface.
SlabCase ellipsoidCase();
/// A tube that is open at both ends, and bends so much that its spacings vary.
SlabCase wavyTubeCase();
/// A sheet that ends at four sides of the bar.
SlabCase sheetCase();
/// The same where fields jump.
SlabCase steppedCase(const char* name, double jump);

ElementMesh meshOf(const SlabCase& which);
DistributionParameters parametersOf(const SlabCase& which, unsigned seed = 1);

/// As many slabs of equal work as are wanted.
/// \throw std::runtime_error if the surface is too small for so many
std::vector<Slab> slabsOf(
  Exchange& exchange, const ElementMesh& mine, const SlabCase& which, std::size_t count);

/// What workers have made together.
struct Together
{
  std::vector<Slab> slabs;
  /// Of all isovalues.
  Buffer<Particle> particles;
  /// Of each worker.
  std::vector<std::size_t> counts;
  std::int64_t undecided = 0;
};

bool isBesideCut(const std::vector<Slab>& slabs, const glm::dvec3& position, double distance);

/// Lets workers on some ranks, which have the elements by chance, distribute particles.
Together distributeTogether(const SlabCase& which, const ElementMesh& mesh, std::size_t workers,
  int ranks = 1, const ParallelFor& parallelFor = {});

/// The same by one worker.
Together distributeAlone(const SlabCase& which, const ElementMesh& mesh, unsigned seed = 1);

/// Places on the surfaces, closer to each other than particles.
std::vector<glm::dvec3> probesOf(const SlabCase& which, const ElementMesh& mesh);

} // namespace hop::testing
