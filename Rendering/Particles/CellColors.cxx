#include "Particles/CellColors.h"

#include "Particles/SplatParticles.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkSMPTools.h"
#include "vtkVector.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{
/** Which neighbours a gradient is fitted to. All numbers were chosen by experiment. */
struct Neighbors
{
  /** Distance in radii of the particle up to which neighbours count. Larger ones cost more and blur gradients. */
  static constexpr double Reach = 1.5;
  /** The same in units of ParticleLocator::GetDistance(). It bounds their number where radii are large. */
  static constexpr double LongestReach = 4.;
  /** The weight of a neighbour at the distance r, in radii, is exp(-Sharpness r^2): the default profile of a splat. */
  static constexpr double Sharpness = 2.;
  /** Cosine of 60 degrees: neighbours whose normals differ by more are of another side or another surface. */
  static constexpr double LeastCosine = 0.5;
  /** Distance beyond a border, in radii, from which on a neighbour is of another cell. Far above rounding. */
  static constexpr double Margin = 0.01;
  /**
   * Weight with which a gradient of 0 takes part in the fit, in units of weight times squared radii. It decides where
   * neighbours stand in a line; a larger one flattens gradients, which then leave borders with fringes.
   */
  static constexpr double Flatness = 0.01;
};

/** When values jump. */
struct Jumps
{
  /** Number of borders that are looked at, about. More take longer, fewer may miss jumps in a small part. */
  static constexpr vtkIdType Samples = 1024;
  /** A border farther from its particle, in radii, is not looked at: both sides would foretell from afar. */
  static constexpr double Farthest = 0.7;
  /**
   * Values jump if the mean difference across borders is so many times the one within cells. Smooth fields reach 3 in
   * tests, as both sides extrapolate; chosen by experiment.
   */
  static constexpr double Ratio = 5.;
  /** Mean difference that nobody sees: half a step of a table of 256 colours. */
  static constexpr double Unseen = 1. / 512.;
};

vtkVector3d VectorAt(const float* values, vtkIdType first)
{
  return vtkVector3d(values[first], values[first + 1], values[first + 2]);
}

vtkVector3d Sum(const vtkVector3d& a, const vtkVector3d& b)
{
  return vtkVector3d(a[0] + b[0], a[1] + b[1], a[2] + b[2]);
}

vtkVector3d Difference(const vtkVector3d& a, const vtkVector3d& b)
{
  return vtkVector3d(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

const float* BorderOf(const CellColors::Particles& drawn, vtkIdType particle, int border)
{
  return drawn.Borders + 4 * (SplatParticles::MaximumNumberOfBorders * particle + border);
}

// Whether another particle lies beyond a border of a particle's cell.
bool IsBeyondCell(const CellColors::Particles& drawn, vtkIdType particle, vtkIdType other)
{
  const vtkVector3d offset =
    Difference(VectorAt(drawn.CentreRadius, 4 * other), VectorAt(drawn.CentreRadius, 4 * particle));
  const double height = offset.Dot(VectorAt(drawn.Normal, 4 * particle));
  const double margin = Neighbors::Margin * drawn.CentreRadius[4 * particle + 3];
  for (int i = 0; i < SplatParticles::MaximumNumberOfBorders; ++i)
  {
    const float* border = BorderOf(drawn, particle, i);
    const vtkVector3d foot = VectorAt(border, 0);
    const double distance = foot.Norm();
    if (distance == 0.)
    {
      break; // the others are none either
    }
    const double across = foot.Dot(offset) / distance;
    const double squaredAlong = offset.SquaredNorm() - height * height - across * across;
    if (across > distance + 0.5 * border[3] * squaredAlong + margin)
    {
      return true;
    }
  }
  return false;
}

// The tangent of glsl/Disk.glsl.
vtkVector3d TangentOf(const vtkVector3d& normal)
{
  const bool alongX = std::abs(static_cast<float>(normal[0])) < 0.6f;
  vtkVector3d tangent = normal.Cross(alongX ? vtkVector3d(1., 0., 0.) : vtkVector3d(0., 1., 0.));
  tangent.Normalize();
  return tangent;
}
}

/** A particle and the particles of its cell around it. Places are disk coordinates: in radii of the particle. */
class CellColors::Neighborhood
{
public:
  explicit Neighborhood(const CellColors& all)
    : All(all)
  {
  }

  void MoveTo(vtkIdType particle)
  {
    const Particles& drawn = this->All.Drawn;
    this->Particle = particle;
    this->Centre = VectorAt(drawn.CentreRadius, 4 * particle);
    this->Radius = drawn.CentreRadius[4 * particle + 3];
    this->Normal = VectorAt(drawn.Normal, 4 * particle);
    this->Tangent = TangentOf(this->Normal);
    this->Bitangent = this->Normal.Cross(this->Tangent);
    this->Around->Reset();
    const double longest = Neighbors::LongestReach * this->All.Locator.GetDistance();
    if (this->Radius > 0. && longest > 0.)
    {
      this->All.Locator.FindAround(
        particle, std::min(Neighbors::Reach * this->Radius, longest), this->Around);
    }
    this->FitGradient();
  }

  Vector2 PlaceOf(const vtkVector3d& point) const
  {
    const vtkVector3d offset = Difference(point, this->Centre);
    return { offset.Dot(this->Tangent) / this->Radius, offset.Dot(this->Bitangent) / this->Radius };
  }

  /** Where the nearest border is (model coordinates); the particle's own place if there is none. */
  vtkVector3d NearestBorder() const
  {
    return Sum(this->Centre, VectorAt(BorderOf(this->All.Drawn, this->Particle, 0), 0));
  }

  /** The value that the particle foretells for a place. */
  double ValueAt(const Vector2& place) const
  {
    return this->All.Values[this->Particle] + this->Gradient[0] * place[0] +
      this->Gradient[1] * place[1];
  }

  /** The nearest particle to a point that is of the cell, or of another one; -1 if there is none. */
  vtkIdType NearestTo(const vtkVector3d& point, bool ofCell) const
  {
    vtkIdType nearest = -1;
    double least = this->Radius * this->Radius;
    for (vtkIdType j : *this->Around)
    {
      const vtkVector3d offset = Difference(VectorAt(this->All.Drawn.CentreRadius, 4 * j), point);
      if (offset.SquaredNorm() < least && this->IsNeighbor(j) && this->IsOfCell(j) == ofCell)
      {
        least = offset.SquaredNorm();
        nearest = j;
      }
    }
    return nearest;
  }

  const Vector2& GetGradient() const { return this->Gradient; }

private:
  bool IsNeighbor(vtkIdType j) const
  {
    const Particles& drawn = this->All.Drawn;
    return j != this->Particle && drawn.CentreRadius[4 * j + 3] > 0.f &&
      VectorAt(drawn.Normal, 4 * j).Dot(this->Normal) >= Neighbors::LeastCosine &&
      std::isfinite(this->All.Values[j]);
  }

  // Both are asked: a border between two particles is within reach of the nearer one, if not of the other.
  bool IsOfCell(vtkIdType j) const
  {
    return !IsBeyondCell(this->All.Drawn, this->Particle, j) &&
      !IsBeyondCell(this->All.Drawn, j, this->Particle);
  }

  void FitGradient()
  {
    const double own = this->All.Values[this->Particle];
    double xx = Neighbors::Flatness;
    double yy = Neighbors::Flatness;
    double xy = 0., x = 0., y = 0.;
    for (vtkIdType j : *this->Around)
    {
      if (this->IsNeighbor(j) && this->IsOfCell(j))
      {
        const Vector2 place = this->PlaceOf(VectorAt(this->All.Drawn.CentreRadius, 4 * j));
        const double weight =
          std::exp(-Neighbors::Sharpness * (place[0] * place[0] + place[1] * place[1]));
        const double rise = weight * (this->All.Values[j] - own);
        xx += weight * place[0] * place[0];
        xy += weight * place[0] * place[1];
        yy += weight * place[1] * place[1];
        x += rise * place[0];
        y += rise * place[1];
      }
    }
    const double determinant = xx * yy - xy * xy; // at least the square of Flatness
    this->Gradient = { (yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant };
    if (!std::isfinite(own))
    {
      this->Gradient = { 0., 0. };
    }
  }

  const CellColors& All;
  vtkIdType Particle = -1;
  vtkVector3d Centre, Normal, Tangent, Bitangent;
  double Radius = 0.;
  Vector2 Gradient = { 0., 0. };
  vtkNew<vtkIdList> Around;
};

//------------------------------------------------------------------------------
CellColors::CellColors(const Particles& particles, const std::vector<float>& values)
  : Drawn(particles)
  , Values(values)
  , Locator(particles.CentreRadius, particles.Count)
{
}

//------------------------------------------------------------------------------
// Adds what the particle and the nearest one of another cell foretell for the border between them, and what the particle
// and the nearest one of its own cell foretell for the middle between them.
void CellColors::Compare(
  Neighborhood& own, Neighborhood& other, vtkIdType particle, Differences& sums) const
{
  own.MoveTo(particle);
  const vtkVector3d centre = VectorAt(this->Drawn.CentreRadius, 4 * particle);
  const vtkVector3d border = own.NearestBorder();
  const vtkIdType within = own.NearestTo(centre, true);
  const vtkIdType beyond = own.NearestTo(border, false);
  if (within < 0 || beyond < 0)
  {
    return;
  }
  other.MoveTo(beyond);
  sums.Across += std::abs(own.ValueAt(own.PlaceOf(border)) - other.ValueAt(other.PlaceOf(border)));
  vtkVector3d middle = Sum(centre, VectorAt(this->Drawn.CentreRadius, 4 * within));
  vtkMath::MultiplyScalar(middle.GetData(), 0.5);
  other.MoveTo(within);
  sums.Within += std::abs(own.ValueAt(own.PlaceOf(middle)) - other.ValueAt(other.PlaceOf(middle)));
  ++sums.Count;
}

//------------------------------------------------------------------------------
bool CellColors::JumpBetweenCells() const
{
  std::vector<vtkIdType> near;
  for (vtkIdType i = 0; i < this->Drawn.Count; ++i)
  {
    const double distance = VectorAt(BorderOf(this->Drawn, i, 0), 0).Norm();
    if (distance > 0. && distance < Jumps::Farthest * this->Drawn.CentreRadius[4 * i + 3] &&
      std::isfinite(this->Values[i]))
    {
      near.push_back(i);
    }
  }
  const std::size_t stride = near.size() / Jumps::Samples + 1;
  Differences sums;
  Neighborhood own(*this);
  Neighborhood other(*this);
  for (std::size_t i = 0; i < near.size(); i += stride)
  {
    this->Compare(own, other, near[i], sums);
  }
  return sums.Across > Jumps::Unseen * sums.Count && sums.Across > Jumps::Ratio * sums.Within;
}

//------------------------------------------------------------------------------
std::vector<std::array<float, 2>> CellColors::FitGradients() const
{
  std::vector<std::array<float, 2>> gradients(this->Drawn.Count, { 0.f, 0.f });
  vtkSMPTools::For(0, this->Drawn.Count,
    [&](vtkIdType begin, vtkIdType end)
    {
      Neighborhood own(*this);
      for (vtkIdType i = begin; i < end; ++i)
      {
        own.MoveTo(i);
        const Vector2& gradient = own.GetGradient();
        gradients[i] = { static_cast<float>(gradient[0]), static_cast<float>(gradient[1]) };
      }
    });
  return gradients;
}
}
