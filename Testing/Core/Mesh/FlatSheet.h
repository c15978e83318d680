#pragma once

#include "Surface/Particles.h"
#include "TestMeshes.h"

#include <glm/glm.hpp>

#include <cmath>
#include <vector>

namespace hop::testing
{

/// Particles in a plane, one spacing of 1 apart where their places differ by 1.
inline Buffer<Particle> particlesAt(const std::vector<glm::dvec2>& places)
{
  Buffer<Particle> particles;
  for (const glm::dvec2& place : places)
  {
    Particle p;
    p.position = { glm::dvec3(place, 0.0) };
    p.normal = { { 0, 0, 1 } };
    p.spacing = 1.0;
    particles.push_back(p);
  }
  return particles;
}

/// Flat surfaces z = 0 with a border of straight lines, and particles on them: evenly on the border, in hexagonal
/// packing inside.
class FlatSheet
{
public:
  using Loop = std::vector<glm::dvec2>;

  /// \param loops corners within [-0.9, 0.9]^2 with the surface to the left: counterclockwise around the surface,
  ///   clockwise around holes
  FlatSheet(const std::vector<Loop>& loops, double spacing)
    : Loops(loops)
    , Spacing(spacing)
  {
    MeshRecipe recipe;
    recipe.degrees = { 1, 1, 1 };
    recipe.cells = 1;
    recipe.field = [](const glm::dvec3& x) { return -x.z; };
    this->Mesh = makeMesh(recipe);
    this->addInside();
    for (const Loop& loop : loops)
    {
      this->addBorder(loop);
    }
  }
  FlatSheet(const FlatSheet&) = delete;
  FlatSheet& operator=(const FlatSheet&) = delete;

  Isosurface surface() const { return { &this->Mesh, 0.0, 1e-9 }; }

  double area() const
  {
    double twice = 0.0;
    for (const Loop& loop : this->Loops)
    {
      for (std::size_t n = 0; n < loop.size(); ++n)
      {
        const glm::dvec2 a = loop[n];
        const glm::dvec2 b = loop[(n + 1) % loop.size()];
        twice += a.x * b.y - a.y * b.x;
      }
    }
    return 0.5 * twice;
  }

  Distribution distribution;

private:
  static ClipPlane endOf(const glm::dvec2& along)
  {
    ClipPlane plane;
    plane.normal = { glm::normalize(glm::dvec3(along.y, -along.x, 0.0)) };
    return plane;
  }

  int add(const glm::dvec2& x)
  {
    Particle p;
    p.position = { glm::dvec3(x, 0.0) };
    p.location = { 0, { 0.5 * (p.position.xyz + 1.0) } };
    p.normal = { { 0, 0, 1 } };
    p.spacing = this->Spacing;
    this->distribution.particles.push_back(p);
    return static_cast<int>(this->distribution.particles.size()) - 1;
  }

  void addBorder(const Loop& loop)
  {
    const std::size_t count = loop.size();
    const int first = static_cast<int>(this->distribution.particles.size());
    for (std::size_t n = 0; n < count; ++n)
    {
      const glm::dvec2 before = loop[n] - loop[(n + count - 1) % count];
      const glm::dvec2 along = loop[(n + 1) % count] - loop[n];
      const int pieces =
        std::max(1, static_cast<int>(std::lround(glm::length(along) / this->Spacing)));
      for (int piece = 0; piece < pieces; ++piece)
      {
        const int i = this->add(loop[n] + static_cast<double>(piece) / pieces * along);
        this->distribution.particles[i].clips[0] = endOf(along);
        if (piece == 0)
        {
          this->distribution.particles[i].clips[1] = endOf(before);
        }
        this->distribution.edges.segments.push_back({ i, i + 1 });
      }
    }
    // Segments have no direction: every other one is given in the other.
    auto& segments = this->distribution.edges.segments;
    segments.back()[1] = first;
    for (std::size_t s = 0; s < segments.size(); s += 2)
    {
      std::swap(segments[s][0], segments[s][1]);
    }
  }

  /// Distance from the border, negative outside.
  double depth(const glm::dvec2& x) const
  {
    double least = 10.0;
    double turn = 0.0;
    for (const Loop& loop : this->Loops)
    {
      for (std::size_t n = 0; n < loop.size(); ++n)
      {
        const glm::dvec2 a = loop[n] - x;
        const glm::dvec2 b = loop[(n + 1) % loop.size()] - x;
        const glm::dvec2 along = b - a;
        const double at = glm::clamp(-glm::dot(a, along) / glm::dot(along, along), 0.0, 1.0);
        least = std::min(least, glm::length(a + at * along));
        turn += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
      }
    }
    return turn > 1.0 ? least : -least;
  }

  void addInside()
  {
    const double rows = 0.5 * std::sqrt(3.0) * this->Spacing;
    const int count = static_cast<int>(2.0 / rows);
    for (int row = -count; row <= count; ++row)
    {
      for (int column = -count; column <= count; ++column)
      {
        const glm::dvec2 x(
          (column + 0.5 * (row % 2)) * this->Spacing + 0.0123, row * rows + 0.0071);
        if (this->depth(x) > 0.5 * this->Spacing)
        {
          this->add(x);
        }
      }
    }
  }

  std::vector<Loop> Loops;
  double Spacing;
  ElementMesh Mesh;
};

} // namespace hop::testing
