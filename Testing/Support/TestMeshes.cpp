#include "TestMeshes.h"

#include "AnalyticFields.h"
#include "Elements/NodalBasis.h"
#include "Surface/ActiveFaces.h"
#include "Surface/Energy.h"

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

/// The point of a straight element: linear shape functions of its corners.
glm::dvec3 linearMap(Domain domain, const std::vector<glm::dvec3>& corners, const ReferencePoint& u)
{
  std::vector<double> weights(corners.size());
  evaluateBasis(domain, { 1, 1, 1 }, u, weights.data());
  glm::dvec3 x(0.0);
  for (int c = 0; c < static_cast<int>(corners.size()); ++c)
  {
    const LatticePoint at = cornerLatticePoint(domain, { 1, 1, 1 }, c);
    x += weights[coefficientIndex(domain, { 1, 1, 1 }, at)] * corners[c];
  }
  return x;
}

/// The corners of the parts of a small cube, as corners of the hexahedron (VTK's order).
std::vector<std::vector<int>> partsOfCube(Domain domain)
{
  switch (domain)
  {
    case Domain::Hexahedron:
      return { { 0, 1, 2, 3, 4, 5, 6, 7 } };
    case Domain::Tetrahedron:
      return { { 0, 1, 2, 6 }, { 0, 2, 3, 6 }, { 0, 3, 7, 6 }, { 0, 7, 4, 6 }, { 0, 4, 5, 6 },
        { 0, 5, 1, 6 } };
    case Domain::Wedge:
      return { { 0, 1, 2, 4, 5, 6 }, { 0, 2, 3, 4, 6, 7 } };
  }
  unknownDomain();
}

/// Values of the three quadratic B-splines over one span, t in [0,1].
glm::dvec3 quadraticSplines(double t)
{
  return { 0.5 * (1.0 - t) * (1.0 - t), 0.5 + t * (1.0 - t), 0.5 * t * t };
}

/// The map of a 4^3 net of control points over the two spans of [-1,1] a side; the net is the regular
/// one, which gives the identity, with its points moved.
glm::dvec3 splineMap(const Map& moved, const glm::dvec3& x)
{
  glm::ivec3 span;
  glm::dmat3 weights;
  for (int axis = 0; axis < 3; ++axis)
  {
    span[axis] = x[axis] < 0.0 ? 0 : 1;
    weights[axis] = quadraticSplines(x[axis] + 1.0 - span[axis]);
  }
  glm::dvec3 sum(0.0);
  for (int n = 0; n < 27; ++n)
  {
    const glm::ivec3 local(n % 3, n / 3 % 3, n / 9);
    const glm::dvec3 control = glm::dvec3(span + local) - 1.5;
    sum += weights[0][local.x] * weights[1][local.y] * weights[2][local.z] * moved(control);
  }
  return sum;
}

/// The net of the teardrop: longer along x, and thinner from slice to slice.
glm::dvec3 taperedNet(const glm::dvec3& control)
{
  constexpr double stretch = 1.5;
  constexpr double thickness[] = { 1.0, 1.0, 0.4, 0.02 };
  const double factor = thickness[std::lround(control.x + 1.5)];
  return { stretch * control.x, factor * control.y, factor * control.z };
}

/// 2 x 2 x 2 elements under a quadratic B-spline map. The field is a polynomial of the straight cube; the map bends what
/// it is drawn in.
ElementMesh splineMesh(int degree, const Map& net, const Field& fieldOfCube)
{
  MeshRecipe recipe;
  recipe.degrees = { degree, degree, degree };
  recipe.field = fieldOfCube;
  const ElementMesh straight = makeMesh(recipe);
  recipe.map = [&](const glm::dvec3& x) { return splineMap(net, x); };
  ElementMesh bent = makeMesh(recipe);
  for (std::size_t c = 0; c < bent.coefficients.size(); ++c)
  {
    bent.coefficients[c].w = straight.coefficients[c].w;
  }
  return bent;
}

/// Pressure of a vortex street in the wake of a cylinder of radius 0.5.
double vortexStreetPressure(const glm::dvec3& x)
{
  constexpr double gap = 1.8, offset = 0.5, core = 0.6, waver = 0.15;
  constexpr int vortices = 7;
  double pressure = 0.3 * std::exp(-0.5 * (glm::dot(x, x) - x.z * x.z));
  for (int n = 0; n < vortices; ++n)
  {
    const double side = n % 2 == 0 ? 1.0 : -1.0;
    const double dx = x.x - 1.2 - gap * n + waver * std::sin(2.0 * x.z + n);
    const double dy = x.y - side * (offset + waver * std::cos(2.0 * x.z));
    const double width = core + 0.05 * n;
    pressure -= std::exp(-(dx * dx + dy * dy) / (width * width));
  }
  return pressure;
}

} // namespace

void appendElement(ElementMesh& mesh, const MeshRecipe& recipe,
  const std::vector<glm::dvec3>& corners, const std::vector<std::int64_t>& numbers)
{
  const std::vector<LatticePoint> lattice = latticePoints(recipe.domain, recipe.degrees);
  const NodalBasis basis = NodalBasis::lagrange(recipe.domain, recipe.degrees, lattice);
  std::vector<Coefficient> nodal;
  for (const LatticePoint& point : lattice)
  {
    const glm::dvec3 x =
      recipe.map(linearMap(recipe.domain, corners, latticePosition(recipe.degrees, point)));
    nodal.emplace_back(x, recipe.field(x));
  }
  Element element;
  element.domain = recipe.domain;
  element.degrees = recipe.degrees;
  element.firstCoefficient = mesh.coefficients.size();
  element.cell = static_cast<std::int64_t>(mesh.elements.size());
  element.corners.fill(-1);
  std::copy(numbers.begin(), numbers.end(), element.corners.begin());
  mesh.elements.push_back(element);
  mesh.coefficients.resize(mesh.coefficients.size() + nodal.size());
  basis.toBernstein(&nodal[0].x, 4, &mesh.coefficients[element.firstCoefficient].x);
}

ElementMesh makeMesh(const MeshRecipe& recipe)
{
  ElementMesh mesh;
  const int n = recipe.cells;
  const auto& unitCorners = facts(Domain::Hexahedron).corners;
  for (int cube = 0; cube < n * n * n; ++cube)
  {
    const glm::dvec3 origin(cube % n, cube / n % n, cube / (n * n));
    for (const std::vector<int>& part : partsOfCube(recipe.domain))
    {
      std::vector<glm::dvec3> corners;
      std::vector<std::int64_t> numbers;
      for (const int c : part)
      {
        const glm::dvec3 grid = origin + unitCorners[c].xyz;
        corners.push_back(2.0 * grid / static_cast<double>(n) - 1.0);
        numbers.push_back(std::llround(grid.x + (n + 1) * (grid.y + (n + 1) * grid.z)));
      }
      appendElement(mesh, recipe, corners, numbers);
    }
  }
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

void findFaceNeighbors(ElementMesh& mesh, double tolerance)
{
  hop::findFaceNeighbors(mesh, std::vector<double>(mesh.elements.size(), tolerance));
}

void appendBox(
  ElementMesh& mesh, const MeshRecipe& recipe, const glm::dvec3& lower, const glm::dvec3& upper)
{
  const auto numberOf = [](const glm::dvec3& x)
  {
    constexpr double perUnit = 1e4;
    constexpr std::int64_t stride = 1 << 20;
    const glm::i64vec3 n(glm::round(perUnit * x));
    return ((n.x + stride / 2) * stride + n.y + stride / 2) * stride + n.z + stride / 2;
  };
  for (const std::vector<int>& part : partsOfCube(recipe.domain))
  {
    std::vector<glm::dvec3> corners;
    std::vector<std::int64_t> numbers;
    for (const int c : part)
    {
      corners.push_back(glm::mix(lower, upper, facts(Domain::Hexahedron).corners[c].xyz));
      numbers.push_back(numberOf(corners.back()));
    }
    appendElement(mesh, recipe, corners, numbers);
  }
}

ElementMesh hangingMesh(const MeshRecipe& left, const MeshRecipe& right)
{
  ElementMesh mesh;
  appendBox(mesh, left, { -1, -1, -1 }, { 0, 1, 1 });
  for (const double y : { -1.0, 0.0 })
  {
    for (const double z : { -1.0, 0.0 })
    {
      appendBox(mesh, right, { 0, y, z }, { 1, y + 1, z + 1 });
    }
  }
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

ElementMesh referenceMesh(Domain domain, int degree, const Field& field)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { degree, degree, degree };
  recipe.field = field;
  ElementMesh mesh;
  std::vector<glm::dvec3> corners;
  std::vector<std::int64_t> numbers;
  for (const ReferencePoint& corner : facts(domain).corners)
  {
    numbers.push_back(static_cast<std::int64_t>(corners.size()));
    corners.push_back(corner.xyz);
  }
  appendElement(mesh, recipe, corners, numbers);
  return mesh;
}

ElementMesh needleMesh()
{
  return splineMesh(5, wavyMap(0.25),
    [](const glm::dvec3& t)
    {
      const double x = 0.575 * t.x - 0.475, y = 0.5 * t.y, z = 0.5 * t.z;
      return 0.5 * x * x * x * x * (x + 1.0) - y * y - z * z;
    });
}

ElementMesh teardropMesh()
{
  constexpr double radius = 0.8;
  return splineMesh(2, taperedNet, sphere({ 0, 0, 0 }, radius).field);
}

ElementMesh vortexStreetMesh()
{
  constexpr int sectors = 30, rings = 28, outerRings = 2, layers = 6;
  constexpr double innerRadius = 0.5, growth = 1.105, layerHeight = 0.5;
  MeshRecipe recipe;
  recipe.degrees = { 3, 3, 3 };
  // The straight cube counts rings, sectors and layers; the sector without outer rings looks upstream.
  recipe.map = [](const glm::dvec3& n)
  {
    const double angle = 2.0 * Pi * (n.y + 0.5) / sectors - Pi;
    const double radius = innerRadius * std::pow(growth, n.x);
    return glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), layerHeight * n.z);
  };
  recipe.field = vortexStreetPressure;
  ElementMesh mesh;
  for (int layer = 0; layer < layers; ++layer)
  {
    for (int ring = 0; ring < rings + outerRings; ++ring)
    {
      const bool isOuter = ring >= rings;
      recipe.domain = isOuter ? Domain::Wedge : Domain::Hexahedron;
      for (int sector = 0; sector < sectors - (isOuter ? 1 : 0); ++sector)
      {
        const glm::dvec3 lower(ring, sector, layer);
        appendBox(mesh, recipe, lower, lower + 1.0);
      }
    }
  }
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

Map wavyMap(double amount)
{
  return [amount](const glm::dvec3& x)
  {
    return x +
      amount *
      glm::dvec3(std::sin(1.7 * x.y + 0.4 * x.z), std::sin(1.3 * x.z - 0.6 * x.x),
        std::cos(1.5 * x.x + 0.5 * x.y));
  };
}

int boundaryFaceCount(const ElementMesh& mesh, const Location& location)
{
  const std::vector<Face>& faces = facts(mesh.elements[location.element].domain).faces;
  int count = 0;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    count +=
      mesh.neighbor(location.element, f).element < 0 && faceMargin(faces[f], location.u) < OnFace;
  }
  return count;
}

ReferencePoint insidePoint(Domain domain, glm::dvec3 t)
{
  // Roots make the points fill the simplices evenly.
  const double a = std::sqrt(t.x);
  const glm::dvec2 onTriangle(a * (1.0 - t.y), a * t.y);
  switch (domain)
  {
    case Domain::Hexahedron:
      return { t };
    case Domain::Tetrahedron:
      return { std::cbrt(t.z) * glm::dvec3(onTriangle, 1.0 - a) };
    case Domain::Wedge:
      return { { onTriangle, t.z } };
  }
  unknownDomain();
}

} // namespace hop::testing
