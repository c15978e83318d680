#include "Particles/FitShapes.h"

#include "Particles/ParticleLocator.h"
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
/** Which neighbours a fit looks at, and how much each counts. All numbers were chosen by experiment. */
struct Neighbors
{
  /**
   * Distance up to which neighbours count, in radii of the particle. The splats of the first ring and some of the
   * second lie within it. A larger reach costs more, and fits to places that the splat does not cover.
   */
  static constexpr double Reach = 1.5;
  /**
   * The same in units of the distance that SplatParticles::EstimateDistance() gives. It bounds the number of neighbours
   * where radii are much larger than the distances of the particles.
   */
  static constexpr double LongestReach = 4.;
  /** The weight of a neighbour at the distance r, in radii, is exp(-Sharpness r^2): the default profile of a splat. */
  static constexpr double Sharpness = 2.;
  /** Cosine of 60 degrees: neighbours whose normals differ by more are of another side or another surface. */
  static constexpr double LeastCosine = 0.5;
  /**
   * Largest height of a neighbour along the mean of both normals, in radii, which is 0 on a surface that bends evenly.
   * Higher ones are of another surface, or of a layer beside a step, as in MarkLayers. A larger one bends splats towards
   * layers nearby; a smaller one drops neighbours where the curvature changes.
   */
  static constexpr double LargestStep = 0.08;
  /**
   * Distance behind a clip plane, in radii, up to which a neighbour still counts. Particles of a boundary curve or a
   * crease lie on each other's planes more or less.
   */
  static constexpr double Margin = 0.1;
  /**
   * Share of its weight that a neighbour has behind a plane at which the surface is almost smooth. It belongs to
   * another cell's surface, which may lie a step higher or lower, but the splat goes on over the plane a little.
   */
  static constexpr double ShareBehindSmooth = 0.5;
};

/** How much a particle's own shape operator counts beside its neighbours. */
struct OwnShape
{
  /**
   * Mean error of the neighbours' normals under the own operator at which the operator counts as much as all
   * neighbours together, radians. Chosen by experiment; a larger one trusts operators that jump at faces.
   */
  static constexpr double Error = 0.01;
  /** Keeps the weight finite if there is no error or no neighbour: the squared error (no unit) that counts as none. */
  static constexpr double Tiny = 1e-6;
};

/**
 * Weighted least squares for a symmetric 2 x 2 matrix, as the vector (xx, xy, yy), near a known one.
 */
class SymmetricFit
{
public:
  void Add(const vtkVector3d& row, double wanted, double weight)
  {
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        this->Matrix[i][j] += weight * row[i] * row[j];
      }
      this->Right[i] += weight * row[i] * wanted;
    }
    this->Squares += weight * wanted * wanted;
    this->Weight += weight;
  }

  vtkVector3d SolveNear(const vtkVector3d& known)
  {
    // The mean squared error is SquaredError() / Weight. Without neighbours the known matrix comes out.
    const double all = OwnShape::Error * this->Weight;
    const double weight =
      (OwnShape::Tiny + all * all) / (OwnShape::Tiny + this->SquaredError(known));
    this->Add({ 1., 0., 0. }, known[0], weight);
    this->Add({ 0., 1., 0. }, known[1], 2. * weight);
    this->Add({ 0., 0., 1. }, known[2], weight);
    vtkVector3d solution;
    vtkMath::LinearSolve3x3(this->Matrix, this->Right, solution.GetData());
    return solution;
  }

private:
  double SquaredError(const vtkVector3d& q) const
  {
    double sum = this->Squares - 2. * q.Dot(vtkVector3d(this->Right));
    for (int i = 0; i < 3; ++i)
    {
      sum += q[i] * q.Dot(vtkVector3d(this->Matrix[i]));
    }
    return sum;
  }

  double Matrix[3][3] = {};
  double Right[3] = {};
  double Squares = 0.;
  double Weight = 0.;
};

vtkVector3d VectorAt(const std::vector<float>& values, vtkIdType first)
{
  return vtkVector3d(values[first], values[first + 1], values[first + 2]);
}

vtkVector3d Times(const float shape[8], const vtkVector3d& v)
{
  return vtkVector3d(shape[0] * v[0] + shape[4] * v[1] + shape[6] * v[2],
    shape[4] * v[0] + shape[1] * v[1] + shape[5] * v[2],
    shape[6] * v[0] + shape[5] * v[1] + shape[2] * v[2]);
}

// The share of its weight that a neighbour at this offset (model coordinates) has, as far as the particle's planes tell:
// 0 if the surface ends or has a crease before it. A neighbour less than `margin` behind a plane counts as one before it.
double ShareByPlanesOf(
  const SplatParticles& particles, vtkIdType particle, const vtkVector3d& offset, double margin)
{
  double share = 1.;
  const std::vector<float>& clip = particles.Clip;
  for (int plane = 0; plane < SplatParticles::ClipPlanesIn(particles.ClipStride); ++plane)
  {
    const vtkIdType first = particles.ClipStride * particle + SplatParticles::PlaneAt(plane);
    const vtkIdType overlap = particles.ClipStride * particle + SplatParticles::OverlapPlace(plane);
    const bool isSmooth = clip[overlap] >= SplatParticles::LeastSmoothOverlap &&
      clip[overlap] < SplatParticles::OpenOverlap;
    const double across = VectorAt(clip, first).Dot(offset);
    const double bend = 0.5 * clip[overlap + 2];
    const double edge = clip[first + 3] + bend * (offset.SquaredNorm() - across * across);
    if (across > edge + margin)
    {
      share = std::min(share, isSmooth ? Neighbors::ShareBehindSmooth : 0.);
    }
  }
  return share;
}

// The share of its weight that a neighbour has for a particle. Both are asked: particles know of creases at faces of their
// own cell only, and with small cells the next crease may be one cell farther off.
double ShareOf(const SplatParticles& particles, vtkIdType particle, vtkIdType neighbor,
  const vtkVector3d& offset, double margin)
{
  const vtkVector3d back(-offset[0], -offset[1], -offset[2]);
  return std::min(ShareByPlanesOf(particles, particle, offset, margin),
    ShareByPlanesOf(particles, neighbor, back, margin));
}

/** The shape operator of one particle, in the plane of its disk and in units of 1 / radius. */
class ParticleFit
{
public:
  ParticleFit(const SplatParticles& particles, vtkIdType particle)
    : Particles(particles)
    , Particle(particle)
    , Place(VectorAt(particles.CentreRadius, 4 * particle))
    , Radius(particles.CentreRadius[4 * particle + 3])
    , Normal(VectorAt(particles.Normal, 4 * particle))
  {
    vtkMath::Perpendiculars(
      this->Normal.GetData(), this->Tangent.GetData(), this->Bitangent.GetData(), 0.);
    const float* shape = &particles.Shape[8 * particle];
    // Derivatives of the normal.
    const vtkVector3d alongTangent = Times(shape, this->Tangent);
    const vtkVector3d alongBitangent = Times(shape, this->Bitangent);
    this->Own = vtkVector3d(this->Radius * alongTangent.Dot(this->Tangent),
      this->Radius * alongTangent.Dot(this->Bitangent),
      this->Radius * alongBitangent.Dot(this->Bitangent));
  }

  void AddNeighbor(vtkIdType neighbor)
  {
    vtkVector3d offset = VectorAt(this->Particles.CentreRadius, 4 * neighbor);
    vtkMath::Subtract(offset, this->Place, offset);
    const vtkVector3d normal = VectorAt(this->Particles.Normal, 4 * neighbor);
    const double height = offset.Dot(this->Normal) / this->Radius;
    const double x = offset.Dot(this->Tangent) / this->Radius;
    const double y = offset.Dot(this->Bitangent) / this->Radius;
    const double cosine = normal.Dot(this->Normal);
    const double square = x * x + y * y;
    const double step = 0.5 * (offset.Dot(this->Normal) + offset.Dot(normal)) / this->Radius;
    const bool isDrawn = this->Particles.CentreRadius[4 * neighbor + 3] > 0.f;
    if (neighbor == this->Particle || !isDrawn || cosine < Neighbors::LeastCosine ||
      std::abs(step) > Neighbors::LargestStep)
    {
      return;
    }
    // At disk coordinates t the paraboloid has the height -t.Q t / 2 and the normal n + Q t, not normalized. Each
    // neighbour gives three rows: two of the normal, one of the height.
    const double weight = std::exp(-Neighbors::Sharpness * square) *
      ShareOf(this->Particles, this->Particle, neighbor, offset, Neighbors::Margin * this->Radius);
    this->Fit.Add({ x, y, 0. }, normal.Dot(this->Tangent) / cosine, weight);
    this->Fit.Add({ 0., x, y }, normal.Dot(this->Bitangent) / cosine, weight);
    this->Fit.Add({ 0.5 * x * x, x * y, 0.5 * y * y }, -height, weight);
  }

  /** Writes the operator in model coordinates: xx, yy, zz, 0, xy, yz, xz, 0. */
  void Write(float shape[8])
  {
    const vtkVector3d found = this->Fit.SolveNear(this->Own);
    const auto entry = [&](int i, int j)
    {
      const double mixed =
        this->Tangent[i] * this->Bitangent[j] + this->Bitangent[i] * this->Tangent[j];
      return static_cast<float>((found[0] * this->Tangent[i] * this->Tangent[j] + found[1] * mixed +
                                  found[2] * this->Bitangent[i] * this->Bitangent[j]) /
        this->Radius);
    };
    const float entries[8] = { entry(0, 0), entry(1, 1), entry(2, 2), 0.f, entry(0, 1), entry(1, 2),
      entry(0, 2), 0.f };
    std::copy_n(entries, 8, shape);
  }

private:
  const SplatParticles& Particles;
  const vtkIdType Particle;
  const vtkVector3d Place;
  const double Radius;
  vtkVector3d Normal, Tangent, Bitangent, Own;
  SymmetricFit Fit;
};
}

//------------------------------------------------------------------------------
void FitShapes(SplatParticles& particles)
{
  const ParticleLocator locator(particles.CentreRadius.data(), particles.GetNumberOfParticles());
  const double distance = locator.GetDistance();
  if (distance == 0.)
  {
    return; // all particles are in one place
  }
  std::vector<float> shapes = particles.Shape;
  vtkSMPTools::For(0, particles.GetNumberOfParticles(),
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkNew<vtkIdList> around;
      for (vtkIdType i = begin; i < end; ++i)
      {
        const double radius = particles.CentreRadius[4 * i + 3];
        if (radius == 0.)
        {
          continue;
        }
        ParticleFit fit(particles, i);
        locator.FindAround(
          i, std::min(Neighbors::Reach * radius, Neighbors::LongestReach * distance), around);
        for (vtkIdType neighbor : *around)
        {
          fit.AddNeighbor(neighbor);
        }
        fit.Write(&shapes[8 * i]);
      }
    });
  particles.Shape = std::move(shapes);
}
}
