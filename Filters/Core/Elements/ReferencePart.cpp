#include "Elements/ReferencePart.h"

#include <glm/glm.hpp>

#include <utility>

namespace hop
{

namespace
{

/// The half of a line at its start, then the other.
const std::array<std::pair<double, double>, 2> lineHalves{ { { 0.0, 0.5 }, { 0.5, 0.5 } } };

std::vector<ReferencePart> halvesOfHexahedron()
{
  std::vector<ReferencePart> parts;
  parts.reserve(8);
  for (int n = 0; n < 8; ++n)
  {
    parts.push_back({ 0.5 * glm::dvec3(n % 2, n / 2 % 2, n / 4), glm::dmat3(0.5) });
  }
  return parts;
}

/// Three triangles at the corners and the turned one between them, on both halves of the line.
std::vector<ReferencePart> halvesOfWedge()
{
  std::vector<ReferencePart> parts;
  for (const auto& [start, length] : lineHalves)
  {
    const glm::dvec3 line(0.0, 0.0, length);
    const glm::dmat3 upright(glm::dvec3(0.5, 0.0, 0.0), glm::dvec3(0.0, 0.5, 0.0), line);
    const glm::dmat3 turned(glm::dvec3(-0.5, 0.0, 0.0), glm::dvec3(0.0, -0.5, 0.0), line);
    parts.push_back({ { 0.0, 0.0, start }, upright });
    parts.push_back({ { 0.5, 0.0, start }, upright });
    parts.push_back({ { 0.0, 0.5, start }, upright });
    parts.push_back({ { 0.5, 0.5, start }, turned });
  }
  return parts;
}

/// Four tetrahedra at the corners, and four of the octahedron between them, around one of its diagonals.
std::vector<ReferencePart> halvesOfTetrahedron()
{
  const std::array<glm::dvec3, 4> corners{ glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0),
    glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, 1.0) };
  const auto middle = [&](int a, int b) { return 0.5 * (corners[a] + corners[b]); };
  std::vector<ReferencePart> parts;
  parts.reserve(8);
  for (const glm::dvec3& corner : corners)
  {
    parts.push_back({ 0.5 * corner, glm::dmat3(0.5) });
  }
  const std::array<glm::dvec3, 4> around{ middle(0, 1), middle(1, 2), middle(2, 3), middle(0, 3) };
  const glm::dvec3 start = middle(0, 2);
  const glm::dvec3 diagonal = middle(1, 3) - start;
  for (int n = 0; n < 4; ++n)
  {
    glm::dmat3 axes(around[n] - start, around[(n + 1) % 4] - start, diagonal);
    if (glm::determinant(axes) < 0.0)
    {
      std::swap(axes[0], axes[1]);
    }
    parts.push_back({ start, axes });
  }
  return parts;
}

std::vector<ReferencePart> halvesOf(Domain domain)
{
  switch (domain)
  {
    case Domain::Hexahedron:
      return halvesOfHexahedron();
    case Domain::Tetrahedron:
      return halvesOfTetrahedron();
    case Domain::Wedge:
      return halvesOfWedge();
  }
  unknownDomain();
}

} // namespace

std::vector<ReferencePart> partsOf(Domain domain, int halvings)
{
  std::vector<ReferencePart> parts{ ReferencePart{} };
  const std::vector<ReferencePart> halves = halvesOf(domain);
  for (int n = 0; n < halvings; ++n)
  {
    std::vector<ReferencePart> finer;
    for (const ReferencePart& part : parts)
    {
      for (const ReferencePart& half : halves)
      {
        finer.push_back({ part.inWhole({ half.origin }).xyz, part.axes * half.axes });
      }
    }
    parts = std::move(finer);
  }
  return parts;
}

} // namespace hop
