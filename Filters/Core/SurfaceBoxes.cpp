#include "SurfaceBoxes.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// A piece of an element: its coefficients (and weights, if rational), and its corners in the element's reference space.
struct Piece
{
  std::vector<Coefficient> coefficients;
  std::vector<double> weights;
  std::vector<glm::dvec3> corners;
  int bisections = 0;
};

constexpr Degrees cornerDegrees{ 1, 1, 1 };

class ElementSplitter
{
public:
  ElementSplitter(const ElementMesh& mesh, double isovalue, double wantedSize)
    : Mesh(mesh)
    , Isovalue(isovalue)
    , WantedSize(wantedSize)
  {
  }

  void split(int element, std::vector<SurfaceBox>& boxes)
  {
    this->Form = this->Mesh.form(element);
    std::vector<Piece> stack{ this->wholeElement() };
    if (!isFinite(stack.back()))
    {
      return;
    }
    while (!stack.empty())
    {
      Piece piece = std::move(stack.back());
      stack.pop_back();
      if (!this->mayHoldSurface(piece))
      {
        continue;
      }
      const double size = this->worldSize(piece);
      if (size <= this->WantedSize || piece.bisections == MaximumBisections)
      {
        boxes.push_back({ { element, this->middle(piece) }, size });
        continue;
      }
      stack.push_back(this->halve(piece));
      stack.push_back(std::move(piece));
    }
  }

private:
  Piece wholeElement() const
  {
    Piece piece;
    const int count = coefficientCount(this->Form.domain, this->Form.degrees);
    piece.coefficients.assign(this->Form.coefficients, this->Form.coefficients + count);
    if (this->Form.weights)
    {
      piece.weights.assign(this->Form.weights, this->Form.weights + count);
    }
    for (const LatticePoint& point : latticePoints(this->Form.domain, cornerDegrees))
    {
      piece.corners.push_back(latticePosition(cornerDegrees, point).xyz);
    }
    return piece;
  }

  /// Halving would spread a NaN, and no box with one could be dropped or grow small enough.
  static bool isFinite(const Piece& piece)
  {
    return std::all_of(piece.coefficients.begin(), piece.coefficients.end(),
      [](const Coefficient& c) {
        return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && std::isfinite(c.w);
      });
  }

  BernsteinForm formOf(const Piece& piece) const
  {
    return { this->Form.domain, this->Form.degrees, piece.coefficients.data(),
      piece.weights.empty() ? nullptr : piece.weights.data() };
  }

  bool mayHoldSurface(const Piece& piece) const
  {
    const Range range = fieldRange(this->formOf(piece));
    // Halving adds rounding errors of the order of eps times the values themselves.
    const double slack = 1e-14 * std::max(std::abs(range.lower), std::abs(range.upper));
    return range.lower - slack <= this->Isovalue && this->Isovalue <= range.upper + slack;
  }

  double worldSize(const Piece& piece) const
  {
    const BernsteinForm form = this->formOf(piece);
    glm::dvec3 lower(controlPoint(form, 0));
    glm::dvec3 upper = lower;
    for (int i = 1; i < static_cast<int>(piece.coefficients.size()); ++i)
    {
      const glm::dvec3 x(controlPoint(form, i));
      lower = glm::min(lower, x);
      upper = glm::max(upper, x);
    }
    return glm::distance(lower, upper);
  }

  static ReferencePoint middle(const Piece& piece)
  {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& corner : piece.corners)
    {
      sum += corner;
    }
    return { sum / static_cast<double>(piece.corners.size()) };
  }

  /// Halves the piece across its longest direction; it keeps the first half, the second is returned.
  Piece halve(Piece& piece) const
  {
    const LatticePoint direction = this->longestDirection(piece);
    Piece second;
    bisect(
      this->Form.domain, this->Form.degrees, direction, piece.coefficients, second.coefficients);
    if (!piece.weights.empty())
    {
      bisect(this->Form.domain, this->Form.degrees, direction, piece.weights, second.weights);
    }
    bisect(this->Form.domain, cornerDegrees, direction, piece.corners, second.corners);
    second.bisections = ++piece.bisections;
    return second;
  }

  /// The direction whose edges are longest in world space.
  LatticePoint longestDirection(const Piece& piece) const
  {
    LatticePoint longest;
    double longestLength = -1.0;
    for (const LatticePoint& d : facts(this->Form.domain).edgeDirections)
    {
      double edgeLength = 0.0;
      for (const LatticePoint& a : latticePoints(this->Form.domain, cornerDegrees))
      {
        const LatticePoint b{ a.i + d.i, a.j + d.j, a.k + d.k };
        if (inLattice(this->Form.domain, cornerDegrees, b))
        {
          edgeLength = std::max(
            edgeLength, glm::distance(this->worldCorner(piece, a), this->worldCorner(piece, b)));
        }
      }
      if (edgeLength > longestLength)
      {
        longest = d;
        longestLength = edgeLength;
      }
    }
    return longest;
  }

  glm::dvec3 worldCorner(const Piece& piece, const LatticePoint& corner) const
  {
    const Degrees& d = this->Form.degrees;
    return glm::dvec3(controlPoint(this->formOf(piece),
      coefficientIndex(
        this->Form.domain, d, { corner.i * d[0], corner.j * d[1], corner.k * d[2] })));
  }

  const ElementMesh& Mesh;
  double Isovalue;
  double WantedSize;
  BernsteinForm Form;
};

} // namespace

std::vector<SurfaceBox> findSurfaceBoxes(
  const ElementMesh& mesh, double isovalue, double wantedSize, const ParallelFor& parallelFor)
{
  std::vector<std::vector<SurfaceBox>> ofElement(mesh.elements.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(mesh.elements.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      ElementSplitter splitter(mesh, isovalue, wantedSize);
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        splitter.split(static_cast<int>(e), ofElement[e]);
      }
    });
  std::vector<SurfaceBox> boxes;
  for (const auto& some : ofElement)
  {
    boxes.insert(boxes.end(), some.begin(), some.end());
  }
  return boxes;
}

} // namespace hop
