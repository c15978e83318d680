#pragma once

#include "Classic/ClassicParticles.h"
#include "Isolation/SurfaceBoxes.h"

#include "TestMeshes.h"

#include <cmath>
#include <memory>

namespace hop::testing
{

/// Hexagonal packing on the plane z = 0.05 in the cube [-1,1]^3, of spacing 0.1, as particles of the paper's scheme.
struct ClassicLattice
{
  static constexpr double Height = 0.05;
  static constexpr double Spacing = 0.1;

  /// \param radius of the disk that the particles fill; the first one stands at its centre
  /// \param stretch distance of neighbours in units of the spacing
  explicit ClassicLattice(double radius = 0.8, double stretch = 1.0)
    : mesh(std::make_shared<ElementMesh>(makePlaneMesh()))
    , particles(Isosurface{ mesh.get(), 0.0, 1e-9 }, { Spacing, 0.0 }, {})
  {
    ClassicParticle centre =
      this->particles.seedsOf(findSurfaceBoxes(*this->mesh, 0.0, 0.5, {})).front();
    const glm::dvec3 toCentre = glm::dvec3(0.003, 0.004, Height) - centre.position().xyz;
    this->particles.displace(centre, { toCentre }, 3.0, centre);
    this->add(centre, { 0.0, 0.0 });
    const double distance = stretch * Spacing;
    const int rings = static_cast<int>(radius / (std::sqrt(0.75) * distance)) + 1;
    for (int row = -rings; row <= rings; ++row)
    {
      for (int column = -rings; column <= rings; ++column)
      {
        const glm::dvec2 step =
          distance * glm::dvec2(column + 0.5 * (row & 1), std::sqrt(0.75) * row);
        if ((row != 0 || column != 0) && glm::length(step) <= radius)
        {
          this->add(centre, step);
        }
      }
    }
  }

  std::size_t count() const { return this->particles.movers.size(); }

  /// A particle at a step along the plane from another.
  void add(const ClassicParticle& from, const glm::dvec2& step)
  {
    ClassicParticle particle = from;
    this->particles.displace(from, { glm::dvec3(step, 0.0) }, 3.0, particle);
    this->particles.movers.push_back(particle);
  }

  /// Gives all particles an energy, in units of the ideal one.
  void setEnergies(double share)
  {
    for (ClassicParticle& m : this->particles.movers)
    {
      m.energy = share * m.ideal;
    }
  }

  static ElementMesh makePlaneMesh()
  {
    MeshRecipe recipe;
    recipe.degrees = { 1, 1, 1 };
    recipe.field = [](const glm::dvec3& x) { return Height - x.z; };
    return makeMesh(recipe);
  }

  /// Stays where it is when the lattice is moved.
  std::shared_ptr<const ElementMesh> mesh;
  ClassicParticles particles;
};

} // namespace hop::testing
