#include "Topology/ElementCube.h"

#include "Elements/Bisection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace hop
{
namespace
{

/// Corners of the reference hexahedron, in VTK's order, at the corners of the cube.
constexpr std::array<int, 8> hexahedronCorners{ 0, 1, 3, 2, 4, 5, 7, 6 };

/// Length of an edge's control polygon below which the edge has collapsed, as a share of the element's size: some
/// digits more than files hold. Larger: short edges count as collapsed; smaller: pyramids of coarse digits are no
/// pyramids.
constexpr double collapsedLength = 1e-6;

int simplexCorners(Domain domain)
{
  return domain == Domain::Tetrahedron ? 4 : domain == Domain::Wedge ? 3 : 0;
}

/// Diagonal of the bounds of an element's control points.
double sizeOf(const BernsteinForm& form)
{
  glm::dvec3 lower(controlPoint(form, 0));
  glm::dvec3 upper = lower;
  for (int i = 1; i < coefficientCount(form.domain, form.degrees); ++i)
  {
    lower = glm::min(lower, glm::dvec3(controlPoint(form, i)));
    upper = glm::max(upper, glm::dvec3(controlPoint(form, i)));
  }
  return glm::distance(lower, upper);
}

/// Whether all control points along an edge of a hexahedron lie in one place.
bool hasCollapsed(const BernsteinForm& form, int first, int second, double size)
{
  const LatticePoint a = cornerLatticePoint(form.domain, form.degrees, first);
  const LatticePoint b = cornerLatticePoint(form.domain, form.degrees, second);
  const int steps = std::abs(b.i - a.i) + std::abs(b.j - a.j) + std::abs(b.k - a.k);
  const auto place = [&](int n)
  {
    return glm::dvec3(controlPoint(form,
      coefficientIndex(form.domain, form.degrees,
        { a.i + n * (b.i - a.i) / steps, a.j + n * (b.j - a.j) / steps,
          a.k + n * (b.k - a.k) / steps })));
  };
  double length = 0.0;
  for (int n = 1; n <= steps; ++n)
  {
    length += glm::distance(place(n), place(n - 1));
  }
  return length <= collapsedLength * size;
}

/// The corners of a hexahedron, the first one of those in one place.
std::array<int, 8> distinctCorners(const ElementMesh& mesh, int element)
{
  const auto& numbers = mesh.elements[element].corners;
  std::array<int, 8> first{};
  std::iota(first.begin(), first.end(), 0);
  const std::set<std::int64_t> distinct(numbers.begin(), numbers.end());
  if (distinct.size() == numbers.size())
  {
    return first;
  }
  const BernsteinForm form = mesh.form(element);
  const double size = sizeOf(form);
  for (const auto& [a, b] : facts(Domain::Hexahedron).edges)
  {
    if (numbers[a] == numbers[b] && hasCollapsed(form, a, b, size))
    {
      const auto [less, more] = std::minmax({ first[a], first[b] });
      std::replace(first.begin(), first.end(), int(more), int(less));
    }
  }
  return first;
}

/// The values at the corners of the domain.
std::array<double, MaximumCorners> cornerValues(
  const BernsteinForm& form, const std::vector<double>& values)
{
  std::array<double, MaximumCorners> result{};
  for (int c = 0; c < static_cast<int>(facts(form.domain).corners.size()); ++c)
  {
    result[c] = values[coefficientIndex(
      form.domain, form.degrees, cornerLatticePoint(form.domain, form.degrees, c))];
  }
  return result;
}

/// The first axis leads to the corner, or to the wedge's edge, that is farthest from the isovalue; a tetrahedron's
/// second axis to the corner that is farthest on the same side, so that the surface does not cross the edge between the
/// two if it can be helped.
std::array<int, 4> rolesFor(Domain domain, const std::array<double, MaximumCorners>& values)
{
  std::array<double, 4> height{};
  for (int c = 0; c < 3; ++c)
  {
    const double a = values[c], b = values[c + 3];
    height[c] = a * b > 0.0 ? std::min(std::abs(a), std::abs(b)) : 0.0;
  }
  if (domain == Domain::Tetrahedron)
  {
    std::transform(
      values.begin(), values.begin() + 4, height.begin(), [](double v) { return std::abs(v); });
  }
  std::vector<int> order(simplexCorners(domain));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return height[a] > height[b]; });
  if (domain == Domain::Tetrahedron)
  {
    std::stable_partition(order.begin() + 1, order.end(),
      [&](int c) { return values[c] * values[order.front()] > 0.0; });
  }
  std::array<int, 4> roles{ 0, 1, 2, 3 };
  for (std::size_t n = 0; n < order.size(); ++n)
  {
    roles[(n + 1) % order.size()] = order[n];
  }
  return roles;
}

/// The corner of the domain at each corner of the cube.
std::array<int, 8> cubeCorners(Domain domain, const std::array<int, 4>& roles)
{
  std::array<int, 8> corners{};
  for (int c = 0; c < 8; ++c)
  {
    const bool x = c & 1, y = c >> 1 & 1, z = c >> 2 & 1;
    switch (domain)
    {
      case Domain::Hexahedron:
        corners[c] = hexahedronCorners[c];
        break;
      case Domain::Tetrahedron:
        corners[c] = roles[x ? 1 : y ? 2 : z ? 3 : 0];
        break;
      case Domain::Wedge:
        corners[c] = roles[x ? 1 : y ? 2 : 0] + (z ? 3 : 0);
        break;
    }
  }
  return corners;
}

/// The corners of the domain at a face of the cube.
std::set<int> cornersOfFace(const std::array<int, 8>& corners, int face)
{
  std::set<int> result;
  for (int c = 0; c < 8; ++c)
  {
    if ((c >> face / 2 & 1) == face % 2)
    {
      result.insert(corners[c]);
    }
  }
  return result;
}

/// \param corners before those in one place are made equal
std::array<int, 6> cubeFaces(
  Domain domain, const std::array<int, 8>& corners, const std::array<int, 8>& distinct)
{
  std::array<int, 6> faces{};
  for (int f = 0; f < 6; ++f)
  {
    const std::set<int> atCube = cornersOfFace(corners, f);
    const auto& all = facts(domain).faces;
    const auto same = std::find_if(all.begin(), all.end(),
      [&](const Face& face) {
        return std::set<int>(face.corners.begin(), face.corners.begin() + face.cornerCount) ==
          atCube;
      });
    const bool isFace = same != all.end() && cornersOfFace(distinct, f).size() >= 3;
    faces[f] = isFace ? static_cast<int>(same - all.begin()) : -1;
  }
  return faces;
}

/// Coefficients of a polynomial on a line, at the places start + i stride, raised from degree n to degree p.
void elevate(std::vector<double>& values, int start, int stride, int n, int p)
{
  for (; n < p; ++n)
  {
    const auto at = [&](int i) -> double& { return values[start + i * stride]; };
    at(n + 1) = at(n);
    for (int i = n; i > 0; --i)
    {
      const double share = static_cast<double>(i) / (n + 1);
      at(i) = share * at(i - 1) + (1.0 - share) * at(i);
    }
  }
}

/// Coefficients over the cube from those over a simplex or wedge:
///   B_(i,j,k)(lambda) = B_i^p(t1) B_j^(p-i)(t2) B_k^(p-i-j)(t3),
/// a wedge's last factor being that of its line.
std::vector<double> onCube(
  const BernsteinForm& form, const std::vector<double>& values, const std::array<int, 4>& roles)
{
  const int p = form.degrees[0];
  const int r = form.degrees[2];
  const bool isWedge = form.domain == Domain::Wedge;
  const auto index = [&](int i, int j, int k) { return i + (p + 1) * (j + (p + 1) * k); };
  std::vector<double> result(static_cast<std::size_t>(index(0, 0, r + 1)), 0.0);
  for (int i = 0; i <= p; ++i)
  {
    for (int j = 0; j <= p - i; ++j)
    {
      const int last = isWedge ? r : p - i - j;
      for (int k = 0; k <= last; ++k)
      {
        std::array<int, 4> power{}; // of each corner of the simplex
        power[roles[1]] = i;
        power[roles[2]] = j;
        power[roles[3]] = k;
        power[roles[0]] = isWedge ? p - i - j : p - i - j - k;
        const LatticePoint from{ power[1], power[2], isWedge ? k : power[3] };
        result[index(i, j, k)] = values[coefficientIndex(form.domain, form.degrees, from)];
      }
      elevate(result, index(i, j, 0), index(0, 0, 1), last, r);
    }
    for (int k = 0; k <= r; ++k)
    {
      elevate(result, index(i, 0, k), index(0, 1, 0), p - i, p);
    }
  }
  return result;
}

/// Makes coefficients positive that are zero to rounding, as at corners and in faces that the surface passes. Elements
/// that share a corner or a face share the coefficients there, and so they see one field still, which differs from the
/// given one by less than rounding may.
/// \return whether there are some
bool liftZeros(std::vector<double>& values, double slack)
{
  const auto isZero = [slack](double value) { return std::abs(value) <= slack; };
  const auto count = std::count_if(values.begin(), values.end(), isZero);
  // Where all are, the field is the isovalue all over the element.
  if (count == 0 || count == static_cast<std::ptrdiff_t>(values.size()))
  {
    return false;
  }
  std::replace_if(values.begin(), values.end(), isZero, 2.0 * slack);
  return true;
}

} // namespace

bool ElementCube::isFinite() const
{
  return std::isfinite(std::accumulate(this->values.begin(), this->values.end(), 0.0));
}

int CubeShape::distinctCorner(int corner) const
{
  // The order is its own inverse.
  return this->domain == Domain::Hexahedron ? this->corners[hexahedronCorners[corner]] : corner;
}

glm::dvec3 CubeShape::inCube(const ReferencePoint& u) const
{
  const int count = simplexCorners(this->domain);
  if (count == 0)
  {
    return u.xyz;
  }
  std::array<double, 4> lambda{ 1.0, u.xyz.x, u.xyz.y, count == 4 ? u.xyz.z : 0.0 };
  lambda[0] -= lambda[1] + lambda[2] + lambda[3];
  glm::dvec3 t(0.0, 0.0, u.xyz.z);
  double rest = 1.0;
  for (int axis = 0; axis < count - 1; ++axis)
  {
    const double share = lambda[this->roles[axis + 1]];
    t[axis] = rest > 0.0 ? std::clamp(share / rest, 0.0, 1.0) : 0.0;
    rest -= share;
  }
  return t;
}

ReferencePoint CubeShape::inElement(const glm::dvec3& t) const
{
  const int count = simplexCorners(this->domain);
  if (count == 0)
  {
    return { t };
  }
  std::array<double, 4> lambda{};
  double rest = 1.0;
  for (int axis = 0; axis < count - 1; ++axis)
  {
    lambda[this->roles[axis + 1]] = rest * t[axis];
    rest *= 1.0 - t[axis];
  }
  lambda[this->roles[0]] = rest;
  return { { lambda[1], lambda[2], count == 4 ? lambda[3] : t.z } };
}

ElementCube elementCube(const ElementMesh& mesh, int element, double isovalue)
{
  const BernsteinForm form = mesh.form(element);
  ElementCube cube;
  cube.shape.domain = form.domain;
  cube.degrees = form.degrees;
  double largest = 0.0;
  for (int i = 0; i < coefficientCount(form.domain, form.degrees); ++i)
  {
    const double weight = form.weights ? form.weights[i] : 1.0;
    cube.values.push_back(form.coefficients[i].w - isovalue * weight);
    largest = std::max({ largest, std::abs(cube.values.back()), std::abs(isovalue) * weight });
  }
  cube.slack = BisectionRounding * largest;
  cube.isLifted = liftZeros(cube.values, cube.slack);
  CubeShape& shape = cube.shape;
  if (form.domain != Domain::Hexahedron)
  {
    shape.roles = rolesFor(form.domain, cornerValues(form, cube.values));
    cube.values = onCube(form, cube.values, shape.roles);
  }
  const std::array<int, 8> corners = cubeCorners(form.domain, shape.roles);
  shape.corners = corners;
  if (form.domain == Domain::Hexahedron)
  {
    const std::array<int, 8> distinct = distinctCorners(mesh, element);
    std::transform(
      corners.begin(), corners.end(), shape.corners.begin(), [&](int c) { return distinct[c]; });
  }
  shape.faces = cubeFaces(form.domain, corners, shape.corners);
  return cube;
}

} // namespace hop
