#include "Isolation/ElementPieces.h"

#include "Elements/KernelAccess.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

constexpr Degrees cornerDegrees{ 1, 1, 1 };

/// Directions of a domain's edges at most: those of a tetrahedron.
constexpr std::size_t mostDirections = 6;

/// When a piece that is not certified is halved across its longest direction in reference space, although another one is
/// longer in world space. In a cell a thousandth as thick as it is wide, pieces halved by their world sizes alone hold
/// columns through all of the thickness: where the surface stands upright in a column, no column is ever so narrow that it
/// is certified (noise_costs.py). Chosen by experiment.
struct FlatPiece
{
  /// Ratio of lengths in world space. Beside the apex of a pyramid, where directions across it are short in world space
  /// as well, they are never that much shorter. Larger: cells less flat have columns; smaller: boxes are other ones in
  /// boundary layers.
  static constexpr double Flat = 16.0;
  /// Ratio of lengths in reference space. Larger: columns are halved to narrower ones first; smaller: pieces in which
  /// halving the thickness decides nothing.
  static constexpr double Tall = 4.0;
};

kernel::ComponentBounds boundsOf(const Buffer<Coefficient>& points)
{
  return kernel::current().bounds(&points.front().x, static_cast<std::ptrdiff_t>(points.size()));
}

/// For each edge along a direction, the storage indices of the lattice points on the edge.
std::vector<std::vector<int>> edgeLines(
  Domain domain, const Degrees& degrees, const LatticePoint& direction)
{
  std::vector<std::vector<int>> lines;
  for (const auto& [first, last] : edgesAlong(domain, direction))
  {
    std::vector<int>& line = lines.emplace_back();
    for (LatticePoint p = cornerLatticePoint(domain, degrees, first); inLattice(domain, degrees, p);
         p = { p.i + direction.i, p.j + direction.j, p.k + direction.k })
    {
      line.push_back(coefficientIndex(domain, degrees, p));
    }
  }
  return lines;
}

/// For each corner of a domain, the storage index of its lattice point.
std::vector<int> cornerIndices(Domain domain, const Degrees& degrees)
{
  std::vector<int> indices;
  indices.reserve(facts(domain).corners.size());
  for (int c = 0; c < static_cast<int>(facts(domain).corners.size()); ++c)
  {
    indices.push_back(coefficientIndex(domain, degrees, cornerLatticePoint(domain, degrees, c)));
  }
  return indices;
}

/// Square of the length of an edge along its control points, taken for steps of equal length: by Cauchy and Schwarz an
/// upper bound.
double squaredLength(const BernsteinForm& form, const std::vector<int>& edge)
{
  double sum = 0.0;
  for (std::size_t n = 1; n < edge.size(); ++n)
  {
    const glm::dvec3 step(controlPoint(form, edge[n]) - controlPoint(form, edge[n - 1]));
    sum += glm::dot(step, step);
  }
  return sum * static_cast<double>(edge.size() - 1);
}

/// Squares of the lengths of a piece along a direction: of its longest edges in world space and in reference space.
struct SquaredLengths
{
  double inWorld = 0.0;
  double inReference = 0.0;
};

/// Edges in world space are measured along their control points, as the two ends of an edge that closes on itself are in
/// one place.
SquaredLengths lengthsAlong(const PieceKind::Direction& direction, const Piece& piece)
{
  const BernsteinForm form = piece.form();
  SquaredLengths lengths;
  for (const std::vector<int>& edge : direction.edges)
  {
    lengths.inWorld = std::max(lengths.inWorld, squaredLength(form, edge));
  }
  for (const std::array<int, 2>& edge : direction.cornerEdges)
  {
    const glm::dvec3 along = piece.corners[edge[1]] - piece.corners[edge[0]];
    lengths.inReference = std::max(lengths.inReference, glm::dot(along, along));
  }
  return lengths;
}

/// The direction of the longest edge in world space; in a flat piece that is not certified, see FlatPiece.
const PieceKind::Direction& longestDirection(const Piece& piece)
{
  const std::vector<PieceKind::Direction>& directions = piece.kind->directions;
  std::array<SquaredLengths, mostDirections> lengths;
  std::transform(directions.begin(), directions.end(), lengths.begin(),
    [&](const PieceKind::Direction& direction) { return lengthsAlong(direction, piece); });
  const auto end = lengths.begin() + static_cast<std::ptrdiff_t>(directions.size());
  const auto inWorld = std::max_element(
    lengths.begin(), end, [](const auto& a, const auto& b) { return a.inWorld < b.inWorld; });
  const auto inReference = std::max_element(lengths.begin(), end,
    [](const auto& a, const auto& b) { return a.inReference < b.inReference; });
  const bool isTall = !piece.certified() &&
    inReference->inReference > FlatPiece::Tall * FlatPiece::Tall * inWorld->inReference &&
    inWorld->inWorld > FlatPiece::Flat * FlatPiece::Flat * inReference->inWorld;
  return directions[(isTall ? inReference : inWorld) - lengths.begin()];
}

} // namespace

PieceKind::PieceKind(Domain itsDomain, const Degrees& itsDegrees)
  : domain(itsDomain)
  , degrees(itsDegrees)
  , cornerPlaces(cornerIndices(itsDomain, itsDegrees))
  , cornerOrder(cornerIndices(itsDomain, cornerDegrees))
{
  for (const LatticePoint& direction : facts(this->domain).edgeDirections)
  {
    this->directions.push_back(
      { { this->domain, this->degrees, direction }, { this->domain, cornerDegrees, direction },
        edgeLines(this->domain, this->degrees, direction), {} });
    for (const std::vector<int>& edge : edgeLines(this->domain, cornerDegrees, direction))
    {
      this->directions.back().cornerEdges.push_back({ edge.front(), edge.back() });
    }
  }
}

BernsteinForm Piece::form() const
{
  return { this->kind->domain, this->kind->degrees, this->coefficients.data(),
    this->weights.empty() ? nullptr : this->weights.data() };
}

bool Piece::isFinite() const
{
  return std::all_of(this->coefficients.begin(), this->coefficients.end(),
    [](const Coefficient& c) { return std::isfinite(c.x + c.y + c.z + c.w); });
}

std::vector<double> Piece::values() const
{
  std::vector<double> values;
  values.reserve(this->coefficients.size());
  for (const Coefficient& c : this->coefficients)
  {
    values.push_back(c.w);
  }
  return values;
}

Range Piece::range() const
{
  const kernel::ComponentBounds bounds = boundsOf(this->coefficients);
  return { bounds.lower[3], bounds.upper[3] };
}

Range Piece::cornerRange() const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range range{ infinity, -infinity };
  for (const int place : this->kind->cornerPlaces)
  {
    range.include(this->coefficients[place].w);
  }
  return range;
}

std::array<double, MaximumCorners> Piece::cornerValues() const
{
  std::array<double, MaximumCorners> values{};
  for (std::size_t c = 0; c < this->kind->cornerPlaces.size(); ++c)
  {
    values[c] = controlPoint(this->form(), this->kind->cornerPlaces[c]).w;
  }
  return values;
}

ReferencePoint Piece::middle() const
{
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& corner : this->corners)
  {
    sum += corner;
  }
  return { sum / static_cast<double>(this->corners.size()) };
}

ReferencePoint Piece::inElement(const glm::dvec3& u) const
{
  const auto cornerAt = [&](const LatticePoint& point)
  { return this->corners[coefficientIndex(this->kind->domain, cornerDegrees, point)]; };
  const glm::dvec3 origin = cornerAt({ 0, 0, 0 });
  return { origin + u.x * (cornerAt({ 1, 0, 0 }) - origin) +
    u.y * (cornerAt({ 0, 1, 0 }) - origin) + u.z * (cornerAt({ 0, 0, 1 }) - origin) };
}

bool Piece::isOnBoundary() const
{
  // Reference units: above the rounding errors of margins, and below the size of pieces, 2^-MaximumBisections at
  // least. A larger figure takes pieces beside a face for pieces on the face.
  constexpr double rounding = 1e-12;
  const auto& faces = facts(this->kind->domain).faces;
  return std::any_of(faces.begin(), faces.end(),
    [&](const Face& face)
    {
      return std::count_if(this->corners.begin(), this->corners.end(),
               [&](const glm::dvec3& u) { return faceMargin(face, { u }) < rounding; }) >= 3;
    });
}

double Piece::worldSize() const
{
  Buffer<Coefficient> projected;
  if (!this->weights.empty())
  {
    projected.resize(this->coefficients.size());
    for (std::size_t i = 0; i < projected.size(); ++i)
    {
      projected[i] = this->coefficients[i] / this->weights[i];
    }
  }
  const auto [lower, upper] = boundsOf(projected.empty() ? this->coefficients : projected);
  return glm::distance(
    glm::dvec3(lower[0], lower[1], lower[2]), glm::dvec3(upper[0], upper[1], upper[2]));
}

Piece wholeElement(const ElementMesh& mesh, int element, double isovalue, const PieceKind& kind)
{
  const BernsteinForm form = mesh.form(element);
  Piece piece;
  piece.kind = &kind;
  piece.element = element;
  const int count = coefficientCount(form.domain, form.degrees);
  piece.coefficients.assign(form.coefficients, form.coefficients + count);
  if (form.weights)
  {
    piece.weights.assign(form.weights, form.weights + count);
  }
  for (int i = 0; i < count; ++i)
  {
    piece.coefficients[i].w -= isovalue * (form.weights ? piece.weights[i] : 1.0);
  }
  for (const LatticePoint& point : latticePoints(form.domain, cornerDegrees))
  {
    piece.corners.push_back(latticePosition(cornerDegrees, point).xyz);
  }
  return piece;
}

Piece halve(Piece& piece)
{
  const PieceKind::Direction& direction = longestDirection(piece);
  Piece second;
  second.kind = piece.kind;
  second.element = piece.element;
  direction.coefficients.bisect(piece.coefficients, second.coefficients);
  if (!piece.weights.empty())
  {
    direction.coefficients.bisect(piece.weights, second.weights);
  }
  direction.corners.bisect(piece.corners, second.corners);
  second.bisections = ++piece.bisections;
  second.part = piece.part;
  second.sheet = piece.sheet;
  if (piece.bisections <= PartBisections)
  {
    piece.part = 2 * piece.part;
    second.part = 2 * second.part + 1;
  }
  return second;
}

Piece partOf(Piece whole, int part)
{
  int bits = 0;
  while (part >> (bits + 1) != 0)
  {
    ++bits;
  }
  while (bits-- > 0)
  {
    Piece second = halve(whole);
    if ((part >> bits) & 1)
    {
      whole = std::move(second);
    }
  }
  return whole;
}

} // namespace hop
