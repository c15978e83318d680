#include "Particles/SplatParticles.h"

#include "Particles/FitShapes.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace hop
{
namespace
{
/** When the shape operators of particles are worth keeping. Both numbers were chosen by experiment. */
struct StrongBend
{
  /**
   * By how much the normal changes over one radius of a splat that is bent, radians. A smaller angle bends splats that
   * look the same as flat disks and cost more; a larger one leaves disks whose rims stand off the surface.
   */
  static constexpr double Angle = 0.125;
  /** Share of bent particles above which all splats are bent. A larger share draws more surfaces by flat disks. */
  static constexpr double Share = 0.01;
};

/** Overlaps beyond clip planes, see SplatParticles::OverlapAt(). Both numbers were chosen by experiment. */
struct Overlap
{
  /** Dihedral angle below which the surface is almost smooth, degrees. A larger one fills creases with flat flaps. */
  static constexpr double SmoothDegrees = 10.;
  /**
   * Radii, at a crease of a small dihedral angle. A smaller overlap leaves gaps where the particles of both sides
   * disagree on the crease; with a larger one splats stick out of it.
   */
  static constexpr double AtCrease = 0.15;
};

void CollectIds(vtkPolyData* input, SplatParticles& particles)
{
  vtkCellArray* vertices = input->GetVerts();
  const vtkIdType cells = vertices ? vertices->GetNumberOfCells() : 0;
  if (cells == 0)
  {
    particles.PointIds.resize(input->GetNumberOfPoints());
    std::iota(particles.PointIds.begin(), particles.PointIds.end(), vtkIdType(0));
    return;
  }
  particles.PointIds.reserve(vertices->GetNumberOfConnectivityIds());
  particles.CellIds.reserve(vertices->GetNumberOfConnectivityIds());
  vtkIdType size = 0;
  const vtkIdType* points = nullptr;
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    vertices->GetCellAtId(cell, size, points);
    particles.PointIds.insert(particles.PointIds.end(), points, points + size);
    particles.CellIds.insert(particles.CellIds.end(), size, cell);
  }
}

std::array<double, 3> MiddleOfFinitePoints(vtkPoints* points)
{
  std::array<double, 3> middle;
  for (int axis = 0; axis < 3; ++axis)
  {
    double range[2];
    points->GetData()->GetFiniteRange(range, axis);
    middle[axis] = range[0] <= range[1] ? 0.5 * range[0] + 0.5 * range[1] : 0.;
  }
  return middle;
}

bool IsFinite(const double v[3])
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

// Reads one particle; false, with nothing written, if it cannot be drawn.
bool ReadParticle(vtkPoints* points, vtkIdType id, double radius, vtkDataArray* normals,
  const std::array<double, 3>& origin, float centreRadius[4], float normal[4])
{
  double position[3];
  points->GetPoint(id, position);
  double direction[3] = { 0., 0., 0. };
  if (normals)
  {
    normals->GetTuple(id, direction);
    if (!IsFinite(direction) || vtkMath::Normalize(direction) == 0.)
    {
      return false;
    }
  }
  if (!IsFinite(position) || !std::isfinite(radius) || radius <= 0.)
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    centreRadius[axis] = static_cast<float>(position[axis] - origin[axis]);
    normal[axis] = static_cast<float>(direction[axis]);
  }
  centreRadius[3] = static_cast<float>(radius);
  return true;
}

// Reads the shape operator. It stays zero, which is flat, if it is not finite.
void ReadShape(vtkDataArray* shapes, vtkIdType id, float shape[8])
{
  double tensor[6];
  shapes->GetTuple(id, tensor);
  if (std::all_of(tensor, tensor + 6, [](double value) { return std::isfinite(value); }))
  {
    std::copy_n(tensor, 3, shape);
    std::copy_n(tensor + 3, 3, shape + 4);
  }
}

// Whether enough particles bend so much that disks would show, see StrongBend. Measured by the Frobenius norm of the
// shape operator, which is at least the larger curvature.
bool IsStronglyBent(const SplatParticles& particles)
{
  const vtkIdType count = particles.GetNumberOfParticles();
  vtkIdType found = 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const float* s = &particles.Shape[8 * i];
    const double square =
      s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2. * (s[4] * s[4] + s[5] * s[5] + s[6] * s[6]);
    found += std::sqrt(square) * particles.CentreRadius[4 * i + 3] > StrongBend::Angle;
  }
  return found > StrongBend::Share * count;
}

// Reads both planes of a particle. A plane that is missing or not finite cuts nothing off.
void ReadClipPlanes(const ParticleArrays& arrays, vtkIdType id, float planes[12])
{
  const int count = std::min(
    arrays.ClipNormals->GetNumberOfComponents() / 3, arrays.ClipDistances->GetNumberOfComponents());
  const auto valueOf = [&](vtkDataArray* array, int plane, double without)
  {
    return array && plane < array->GetNumberOfComponents() ? array->GetComponent(id, plane)
                                                           : without;
  };
  for (int plane = 0; plane < std::min(count, 2); ++plane)
  {
    double normal[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      normal[axis] = arrays.ClipNormals->GetComponent(id, 3 * plane + axis);
    }
    const double distance = arrays.ClipDistances->GetComponent(id, plane);
    if (IsFinite(normal) && std::isfinite(distance))
    {
      std::copy_n(normal, 3, planes + 4 * plane);
      planes[4 * plane + 3] = static_cast<float>(distance);
      planes[8 + plane] = SplatParticles::OverlapAt(valueOf(arrays.ClipAngles, plane, 180.));
      const double curvature = valueOf(arrays.ClipCurvatures, plane, 0.);
      planes[10 + plane] = std::isfinite(curvature) ? static_cast<float>(curvature) : 0.f;
    }
  }
}

// Reads the borders of a particle's cell. A border that is missing or not finite is none.
void ReadBorders(vtkDataArray* borders, vtkIdType id, float* read)
{
  const int count =
    std::min(borders->GetNumberOfComponents() / 4, SplatParticles::MaximumNumberOfBorders);
  for (int component = 0; component < 4 * count; ++component)
  {
    read[component] = static_cast<float>(borders->GetComponent(id, component));
  }
  for (int border = 0; border < count; ++border, read += 4)
  {
    if (!std::all_of(read, read + 4, [](float value) { return std::isfinite(value); }))
    {
      std::fill_n(read, 4, 0.f);
    }
  }
}

// The fourth number of a particle's normal, see SplatParticles::Normal.
float TagOf(const ParticleArrays& arrays, const SplatParticles& particles,
  const std::vector<double>& isovalues, vtkIdType particle)
{
  float tag = 0.f;
  if (arrays.CellColors && !particles.CellIds.empty() &&
    arrays.CellColors->GetComponent(particles.CellIds[particle], 3) < 1.)
  {
    tag += 1.f;
  }
  if (!isovalues.empty())
  {
    const double value = arrays.Isovalues->GetComponent(particles.PointIds[particle], 0);
    const auto isovalue = std::lower_bound(isovalues.begin(), isovalues.end(), value);
    tag += 2.f * static_cast<float>(isovalue - isovalues.begin());
  }
  return tag;
}

// See SplatParticles::IsovalueRanges.
std::vector<std::array<vtkIdType, 2>> RangesOf(
  const SplatParticles& particles, std::size_t isovalues)
{
  const vtkIdType count = particles.GetNumberOfParticles();
  if (isovalues == 1)
  {
    return { { 0, count } };
  }
  std::vector<std::array<vtkIdType, 2>> ranges(isovalues, { count, 0 });
  for (vtkIdType i = 0; i < count; ++i)
  {
    auto& [first, end] = ranges[static_cast<int>(particles.Normal[4 * i + 3]) / 2];
    first = std::min(first, i);
    end = i + 1;
  }
  return ranges;
}

// The different values that particles have in an array, the smallest first. None if they are too many or not finite.
std::vector<double> FindIsovalues(vtkDataArray* values, const std::vector<vtkIdType>& ids)
{
  std::vector<double> found;
  for (std::size_t i = 0; values && i < ids.size(); ++i)
  {
    const double value = values->GetComponent(ids[i], 0);
    const bool isLast = !found.empty() &&
      found.back() == value; // mostly true, as the filter writes isosurface by isosurface
    if (!isLast && std::find(found.begin(), found.end(), value) == found.end())
    {
      if (!std::isfinite(value) || found.size() == SplatParticles::MaximumNumberOfIsovalues)
      {
        return {};
      }
      found.push_back(value);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}
}

//------------------------------------------------------------------------------
ParticleArrays ParticleArrays::FromPointData(vtkPointData* data)
{
  ParticleArrays arrays;
  arrays.Normals = data->GetNormals();
  arrays.ClipNormals = data->GetArray("Clip_Normal");
  arrays.ClipDistances = data->GetArray("Clip_Distance");
  arrays.ClipAngles = data->GetArray("Clip_Angle");
  arrays.ClipCurvatures = data->GetArray("Clip_Curvature");
  arrays.CellBorders = data->GetArray("Cell_Borders");
  arrays.ShapeOperators = data->GetArray("Shape_Operator");
  arrays.Isovalues = data->GetArray("Isovalue");
  return arrays;
}

//------------------------------------------------------------------------------
float SplatParticles::OverlapAt(double degrees)
{
  static_assert(Overlap::AtCrease < LeastSmoothOverlap && LeastSmoothOverlap < SmoothOverlap);
  const double cosine = std::cos(vtkMath::RadiansFromDegrees(degrees));
  if (degrees < Overlap::SmoothDegrees)
  {
    return SmoothOverlap;
  }
  // An angle that is no number has no overlap either.
  return cosine > 0. ? static_cast<float>(Overlap::AtCrease * cosine) : 0.f;
}

//------------------------------------------------------------------------------
double SplatParticles::EstimateDistance(const double bounds[6], vtkIdType count)
{
  double size[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    size[axis] = std::max(bounds[2 * axis + 1] - bounds[2 * axis], 0.);
  }
  const double area = 2. * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
  // A hexagon of the lattice with the spacing h has the area (sqrt(3)/2) h^2.
  return area > 0. ? std::sqrt(2. * area / (std::sqrt(3.) * static_cast<double>(count)))
                   : (size[0] + size[1] + size[2]) / static_cast<double>(count);
}

//------------------------------------------------------------------------------
SplatParticles SplatParticles::FromPolyData(vtkPolyData* input, const ParticleArrays& arrays)
{
  SplatParticles particles;
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return particles;
  }
  CollectIds(input, particles);
  particles.Origin = MiddleOfFinitePoints(input->GetPoints());

  const vtkIdType count = particles.GetNumberOfParticles();
  const bool clipped = arrays.ClipNormals && arrays.ClipDistances;
  particles.CentreRadius.assign(4 * count, 0.f);
  particles.Normal.assign(4 * count, 0.f);
  const bool shaped =
    arrays.ShapeOperators && arrays.Normals && arrays.ShapeOperators->GetNumberOfComponents() == 6;
  particles.Shape.assign(shaped ? 8 * count : 0, 0.f);
  particles.Clip.assign(clipped ? 12 * count : 0, 0.f);
  const bool bordered = arrays.CellBorders && arrays.CellBorders->GetNumberOfComponents() >= 4;
  particles.Borders.assign(bordered ? 4 * MaximumNumberOfBorders * count : 0, 0.f);
  const std::vector<double> isovalues = FindIsovalues(arrays.Isovalues, particles.PointIds);
  std::atomic<vtkIdType> skipped(0);
  vtkSMPTools::For(0, count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const vtkIdType id = particles.PointIds[i];
        const double radius =
          arrays.Radii ? arrays.Radii->GetComponent(id, 0) : arrays.FallbackRadius;
        if (!ReadParticle(input->GetPoints(), id, radius, arrays.Normals, particles.Origin,
              &particles.CentreRadius[4 * i], &particles.Normal[4 * i]))
        {
          particles.Normal[4 * i + 2] = 1.f; // any direction: shaders need not mind a zero one
          ++skipped;
        }
        particles.Normal[4 * i + 3] = TagOf(arrays, particles, isovalues, i);
        if (shaped)
        {
          ReadShape(arrays.ShapeOperators, id, &particles.Shape[8 * i]);
        }
        if (clipped)
        {
          ReadClipPlanes(arrays, id, &particles.Clip[12 * i]);
        }
        if (bordered)
        {
          ReadBorders(arrays.CellBorders, id, &particles.Borders[4 * MaximumNumberOfBorders * i]);
        }
      }
    });
  particles.Skipped = skipped;
  particles.IsovalueRanges = RangesOf(particles, std::max<std::size_t>(1, isovalues.size()));
  if (shaped && IsStronglyBent(particles))
  {
    FitShapes(particles);
  }
  else
  {
    particles.Shape.clear();
  }
  return particles;
}
}
