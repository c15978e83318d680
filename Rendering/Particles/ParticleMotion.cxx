#include "Particles/ParticleMotion.h"

#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkPoints.h"
#include "vtkVector.h"
#if __has_include("vtkVectorOperators.h") // newer VTK has the operators in vtkVector.h
#include "vtkVectorOperators.h"
#endif

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{
/** When points count as moved by one affine map. */
struct AffineFit
{
  /**
   * Distance from the map's image, in units of the largest coordinate: positions may have been rounded to float32 on
   * their way. A larger one takes slight warps for affine, a smaller one takes rounded points for warped.
   */
  static constexpr double Tolerance = 2. * std::numeric_limits<float>::epsilon();
  /**
   * Extent of points along an axis below which they are flat, as a share of their largest extent, squared. Rounding by
   * float32 tilts what such points say of that axis by up to 1e-3. A larger one forgets the thickness of thin shells.
   */
  static constexpr double Flat = 1e-8;
  /** Points of a run at least: any five points are nearly affine. A larger one gives up small components. */
  static constexpr vtkIdType FewestPoints = 16;
};

vtkVector3d PointOf(vtkPoints* points, vtkIdType i)
{
  vtkVector3d place;
  points->GetPoint(i, place.GetData());
  return place;
}

vtkVector3d OriginOf(vtkDataArray* placements, vtkIdType i)
{
  return vtkVector3d(
    placements->GetComponent(i, 0), placements->GetComponent(i, 1), placements->GetComponent(i, 2));
}

bool IsFinite(const vtkVector3d& v)
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

vtkVector3d Times(const LinearMap::Matrix& m, const vtkVector3d& v)
{
  vtkVector3d product;
  vtkMath::Multiply3x3(
    reinterpret_cast<const double(*)[3]>(m.data()), v.GetData(), product.GetData());
  return product;
}

LinearMap::Matrix InverseTransposeOf(const LinearMap::Matrix& m)
{
  const vtkVector3d x(m[0].data()), y(m[1].data()), z(m[2].data());
  const double determinant = x.Dot(y.Cross(z));
  LinearMap::Matrix inverse;
  const vtkVector3d rows[3] = { y.Cross(z), z.Cross(x), x.Cross(y) };
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      inverse[i][j] = rows[i][j] / determinant;
    }
  }
  return inverse;
}

/** The best affine map of a range of points from where they were computed, by least squares. */
class AffineMap
{
public:
  AffineMap(vtkPoints* points, vtkDataArray* placements, vtkIdType begin, vtkIdType end)
    : Points(points)
    , Placements(placements)
    , Begin(begin)
    , End(end)
  {
    this->FindMiddles();
    double squares[3][3] = {};
    double mixed[3][3] = {};
    this->ForEach(
      [&](const vtkVector3d& from, const vtkVector3d& to)
      {
        const vtkVector3d a = from - this->From;
        const vtkVector3d b = to - this->To;
        for (int i = 0; i < 3; ++i)
        {
          for (int j = 0; j < 3; ++j)
          {
            squares[i][j] += a[i] * a[j];
            mixed[i][j] += b[i] * a[j];
          }
        }
      });
    this->Solve(squares, mixed);
  }

  /** Whether all points are where the map takes them. */
  bool Fits() const
  {
    double largest = 0.;
    double distance = 0.;
    this->ForEach(
      [&](const vtkVector3d& from, const vtkVector3d& to)
      {
        largest = std::max(largest, to.Norm());
        distance =
          std::max(distance, (to - this->To - Times(this->Linear, from - this->From)).Norm());
      });
    return distance <= AffineFit::Tolerance * largest;
  }

  /** Whether the points tell all of the map. A map of flat points is completed, see Solve(). */
  bool IsKnown() const { return this->Rank >= 2 && this->IsRegular; }

  const LinearMap::Matrix& GetLinear() const { return this->Linear; }

private:
  template <class Use>
  void ForEach(const Use& use) const
  {
    for (vtkIdType i = this->Begin; i < this->End; ++i)
    {
      const vtkVector3d from = OriginOf(this->Placements, i);
      const vtkVector3d to = PointOf(this->Points, i);
      if (IsFinite(from) && IsFinite(to))
      {
        use(from, to);
      }
    }
  }

  void FindMiddles()
  {
    double count = 0.;
    this->ForEach(
      [&](const vtkVector3d& from, const vtkVector3d& to)
      {
        this->From = this->From + from;
        this->To = this->To + to;
        ++count;
      });
    const double share = 1. / std::max(count, 1.);
    this->From = share * this->From;
    this->To = share * this->To;
  }

  // Along an axis in which the points have no extent the map is that of a similarity: orthogonal to the images of the
  // other axes, turned as they are, and as long as both are on average.
  void Solve(double squares[3][3], double mixed[3][3])
  {
    double extents[3];
    double axes[3][3]; // in columns
    vtkMath::Diagonalize3x3(squares, extents, axes);
    const double least = AffineFit::Flat * *std::max_element(extents, extents + 3);
    vtkVector3d axis[3], image[3];
    int flat = 0;
    for (int k = 0; k < 3; ++k)
    {
      axis[k] = vtkVector3d(axes[0][k], axes[1][k], axes[2][k]);
      if (extents[k] > least)
      {
        vtkMath::Multiply3x3(mixed, axis[k].GetData(), image[k].GetData());
        image[k] = (1. / extents[k]) * image[k];
        ++this->Rank;
      }
      else
      {
        image[k] = vtkVector3d(0.);
        flat = k;
      }
    }
    if (this->Rank == 2)
    {
      const vtkVector3d across = image[(flat + 1) % 3].Cross(image[(flat + 2) % 3]);
      const double side = axis[flat].Dot(axis[(flat + 1) % 3].Cross(axis[(flat + 2) % 3]));
      image[flat] = (side / std::sqrt(std::max(across.Norm(), VTK_DBL_MIN))) * across;
    }
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        this->Linear[i][j] =
          image[0][i] * axis[0][j] + image[1][i] * axis[1][j] + image[2][i] * axis[2][j];
      }
    }
    const double volume = std::abs(image[0].Dot(image[1].Cross(image[2])));
    const double longest = std::max({ image[0].Norm(), image[1].Norm(), image[2].Norm() });
    this->IsRegular = volume > std::sqrt(AffineFit::Flat) * longest * longest * longest;
  }

  vtkPoints* Points;
  vtkDataArray* Placements;
  const vtkIdType Begin;
  const vtkIdType End;
  vtkVector3d From{ 0. };
  vtkVector3d To{ 0. };
  LinearMap::Matrix Linear;
  int Rank = 0;
  bool IsRegular = false;
};

bool HasMoved(vtkPoints* points, vtkDataArray* placements)
{
  double bounds[6];
  points->GetBounds(bounds);
  double largest = 0.;
  for (double side : bounds)
  {
    largest = std::max(largest, std::isfinite(side) ? std::abs(side) : 0.);
  }
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    if ((PointOf(points, i) - OriginOf(placements, i)).Norm() > AffineFit::Tolerance * largest)
    {
      return true;
    }
  }
  return false;
}

// Where the longest run from `begin` on ends that one affine map has moved.
vtkIdType EndOfRun(vtkPoints* points, vtkDataArray* placements, vtkIdType begin)
{
  vtkIdType fits = begin;
  vtkIdType tried = points->GetNumberOfPoints();
  for (vtkIdType fails = tried + 1; fits + 1 < fails; tried = fits + (fails - fits) / 2)
  {
    (AffineMap(points, placements, begin, tried).Fits() ? fits : fails) = tried;
  }
  return fits;
}
}

//------------------------------------------------------------------------------
LinearMap::LinearMap(const Matrix& matrix)
  : Forward(matrix)
  , InverseTranspose(InverseTransposeOf(matrix))
{
}

void LinearMap::CarryNormal(const double from[3], double to[3]) const
{
  const vtkVector3d image = Times(this->InverseTranspose, vtkVector3d(from)).Normalized();
  std::copy_n(image.GetData(), 3, to);
}

double LinearMap::StretchAcross(const double normal[3]) const
{
  vtkVector3d s, t;
  vtkMath::Perpendiculars(normal, s.GetData(), t.GetData(), 0.);
  s = Times(this->Forward, s);
  t = Times(this->Forward, t);
  // The larger singular value of the matrix with these two columns.
  const double mean = 0.5 * (s.SquaredNorm() + t.SquaredNorm());
  const double difference = 0.5 * (s.SquaredNorm() - t.SquaredNorm());
  return std::sqrt(mean + std::hypot(difference, s.Dot(t)));
}

//------------------------------------------------------------------------------
// Heights above the tangent plane shrink by |A^-T n|, and the second fundamental form with them: II'(Au, Av) =
// II(u, v) / |A^-T n| for tangents u, v.
void LinearMap::CarryShape(const double normal[3], float shape[8]) const
{
  const vtkVector3d image = Times(this->InverseTranspose, vtkVector3d(normal));
  const double length = image.Norm();
  const double before[3][3] = { { shape[0], shape[4], shape[6] }, { shape[4], shape[1], shape[5] },
    { shape[6], shape[5], shape[2] } };
  vtkVector3d inverse[3]; // of unit vectors, projected onto the image of the tangent plane
  for (int i = 0; i < 3; ++i)
  {
    vtkVector3d tangent(0.);
    tangent[i] = 1.;
    tangent = tangent - (image[i] / (length * length)) * image;
    for (int j = 0; j < 3; ++j)
    {
      inverse[i][j] = tangent[0] * this->InverseTranspose[0][j] +
        tangent[1] * this->InverseTranspose[1][j] + tangent[2] * this->InverseTranspose[2][j];
    }
  }
  const auto entry = [&](int i, int j)
  {
    vtkVector3d product;
    vtkMath::Multiply3x3(before, inverse[j].GetData(), product.GetData());
    return static_cast<float>(inverse[i].Dot(product) / length);
  };
  const float after[8] = { entry(0, 0), entry(1, 1), entry(2, 2), 0.f, entry(0, 1), entry(1, 2),
    entry(0, 2), 0.f };
  std::copy_n(after, 8, shape);
}

//------------------------------------------------------------------------------
void LinearMap::CarryClip(const double normal[3], float plane[4], float& curvature) const
{
  const vtkVector3d across(plane[0], plane[1], plane[2]);
  if (across.SquaredNorm() == 0.)
  {
    return;
  }
  const vtkVector3d image = Times(this->InverseTranspose, across);
  const double length = image.Norm(); // distances from the plane shrink by it
  const vtkVector3d along = vtkVector3d(normal).Cross(across).Normalized();
  for (int axis = 0; axis < 3; ++axis)
  {
    plane[axis] = static_cast<float>(image[axis] / length);
  }
  plane[3] = static_cast<float>(plane[3] / length);
  // The edge stands off the plane by curvature / 2 times the squared distance along it.
  const double stretch = length * Times(this->Forward, along).SquaredNorm();
  curvature = static_cast<float>(stretch > 0. ? curvature / stretch : 0.);
}

//------------------------------------------------------------------------------
ParticleMotion::ParticleMotion(vtkPoints* points, vtkDataArray* placements)
{
  const bool isThere = placements && placements->GetNumberOfComponents() == 6 &&
    placements->GetNumberOfTuples() == points->GetNumberOfPoints();
  if (!isThere || !HasMoved(points, placements))
  {
    return;
  }
  const vtkIdType count = points->GetNumberOfPoints();
  for (vtkIdType begin = 0; begin < count && !this->Warped;)
  {
    const vtkIdType end = EndOfRun(points, placements, begin);
    const AffineMap map(points, placements, begin, end);
    this->Warped = !map.IsKnown() || (end - begin < AffineFit::FewestPoints && end < count);
    if (!this->Warped)
    {
      this->Runs.push_back({ end, LinearMap(map.GetLinear()) });
    }
    begin = end;
  }
  if (this->Warped)
  {
    this->Runs.clear();
  }
}

const LinearMap* ParticleMotion::Of(vtkIdType point) const
{
  const auto run = std::upper_bound(this->Runs.begin(), this->Runs.end(), point,
    [](vtkIdType i, const Run& some) { return i < some.End; });
  return run != this->Runs.end() ? &run->Map : nullptr;
}
}
