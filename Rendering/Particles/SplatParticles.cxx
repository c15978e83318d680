#include "Particles/SplatParticles.h"

#include "Common/SplatColumns.h"
#include "Particles/FitShapes.h"
#include "Particles/MarkLayers.h"
#include "Particles/ParticleMotion.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <string>

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

/**
 * Squared difference of unit normals that float32 may have rounded on their way, up to which they are the same: an angle
 * of 1e-5. A larger one turns normals twice that a filter has turned a little.
 */
constexpr double SameNormal = 1e-10;

// Writes the points and the cells of the particles. Returns the particles whose point is not there; they have the first
// point.
std::vector<vtkIdType> CollectIds(vtkPolyData* input, SplatParticles& particles)
{
  vtkCellArray* vertices = input->GetVerts();
  const vtkIdType cells = vertices ? vertices->GetNumberOfCells() : 0;
  if (cells == 0)
  {
    particles.PointIds.resize(input->GetNumberOfPoints());
    std::iota(particles.PointIds.begin(), particles.PointIds.end(), vtkIdType(0));
    return {};
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
  std::vector<vtkIdType> lost;
  for (vtkIdType i = 0; i < particles.GetNumberOfParticles(); ++i)
  {
    if (particles.PointIds[i] < 0 || particles.PointIds[i] >= input->GetNumberOfPoints())
    {
      particles.PointIds[i] = 0;
      lost.push_back(i);
    }
  }
  return lost;
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

// Whether a vector is not (0, 0, 0).
bool IsSet(vtkDataArray* vectors, vtkIdType id)
{
  double vector[3];
  vectors->GetTuple(id, vector);
  return vector[0] != 0. || vector[1] != 0. || vector[2] != 0.;
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

void ReadShape(vtkDataArray* shapes, vtkIdType id, float shape[8])
{
  double tensor[6];
  shapes->GetTuple(id, tensor);
  std::copy_n(tensor, 3, shape);
  std::copy_n(tensor + 3, 3, shape + 4);
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

// Number of planes that the arrays have room for, three at most.
int CountPlanes(const ParticleArrays& arrays)
{
  return arrays.ClipNormals && arrays.ClipDistances
    ? std::min({ arrays.ClipNormals->GetNumberOfComponents() / 3,
        arrays.ClipDistances->GetNumberOfComponents(), 3 })
    : 0;
}

bool ReadNormal(vtkDataArray* normals, vtkIdType id, int plane, double normal[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    normal[axis] = normals->GetComponent(id, 3 * plane + axis);
  }
  return IsFinite(normal);
}

// See SplatParticles::ClipStride. Third planes that cut no splat do not count, nor do those at which the surface is
// almost smooth: they would change pictures by little, and cost time.
int ClipStrideOf(const ParticleArrays& arrays, const std::vector<vtkIdType>& ids)
{
  if (!arrays.ClipNormals || !arrays.ClipDistances)
  {
    return 0;
  }
  const auto hasThird = [&](vtkIdType id)
  {
    double normal[3];
    const double radius = arrays.Radii ? arrays.Radii->GetComponent(id, 0) : arrays.FallbackRadius;
    return ReadNormal(arrays.ClipNormals, id, 2, normal) && vtkMath::Norm(normal) > 0. &&
      arrays.ClipDistances->GetComponent(id, 2) < radius &&
      (!arrays.ClipAngles || arrays.ClipAngles->GetNumberOfComponents() < 3 ||
        SplatParticles::OverlapAt(arrays.ClipAngles->GetComponent(id, 2)) <
          SplatParticles::LeastSmoothOverlap);
  };
  return CountPlanes(arrays) == 3 && std::any_of(ids.begin(), ids.end(), hasThird) ? 20 : 12;
}

// Reads the planes of a particle. A plane that is missing or not finite cuts nothing off.
void ReadClipPlanes(const ParticleArrays& arrays, vtkIdType id, int count, float* planes)
{
  const auto valueOf = [&](vtkDataArray* array, int plane, double without)
  {
    return array && plane < array->GetNumberOfComponents() ? array->GetComponent(id, plane)
                                                           : without;
  };
  for (int plane = 0; plane < count; ++plane)
  {
    double normal[3];
    const double distance = arrays.ClipDistances->GetComponent(id, plane);
    if (ReadNormal(arrays.ClipNormals, id, plane, normal) && std::isfinite(distance))
    {
      float* const first = planes + SplatParticles::PlaneAt(plane);
      float* const overlap = planes + SplatParticles::OverlapPlace(plane);
      std::copy_n(normal, 3, first);
      first[3] = static_cast<float>(distance);
      overlap[0] = SplatParticles::OverlapAt(valueOf(arrays.ClipAngles, plane, 180.));
      const double curvature = valueOf(arrays.ClipCurvatures, plane, 0.);
      overlap[2] = std::isfinite(curvature) ? static_cast<float>(curvature) : 0.f;
    }
  }
}

// Reads the borders of a particle's cell. A border that is missing is none.
void ReadBorders(vtkDataArray* borders, vtkIdType id, float* read)
{
  const int count =
    std::min(borders->GetNumberOfComponents() / 4, SplatParticles::MaximumNumberOfBorders);
  for (int component = 0; component < 4 * count; ++component)
  {
    read[component] = static_cast<float>(borders->GetComponent(id, component));
  }
}

// The normals of sides of creases if a point has one; nullptr otherwise.
vtkDataArray* SideNormalsAt(const ParticleArrays& arrays, vtkIdType id)
{
  return arrays.SideNormals && IsSet(arrays.SideNormals, id) ? arrays.SideNormals : nullptr;
}

// Takes a border of a particle's cell along: its curve as a map takes the edge at a clip plane.
void CarryBorder(const LinearMap& map, const double normal[3], float* border)
{
  const double far =
    std::sqrt(border[0] * border[0] + border[1] * border[1] + border[2] * border[2]);
  if (far > 0.)
  {
    float plane[4] = { 0.f, 0.f, 0.f, static_cast<float>(far) };
    for (int axis = 0; axis < 3; ++axis)
    {
      plane[axis] = static_cast<float>(border[axis] / far);
    }
    map.CarryClip(normal, plane, border[3]);
    for (int axis = 0; axis < 3; ++axis)
    {
      border[axis] = plane[axis] * plane[3];
    }
  }
}

// Takes a particle to where an affine map has moved its point. A normal that the map has turned already stays.
void Carry(const LinearMap& map, const ParticleArrays& arrays, vtkIdType id,
  SplatParticles& particles, vtkIdType i)
{
  double before[3];
  double now[3];
  double normal[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    now[axis] = particles.Normal[4 * i + axis];
    // No filter turns the normals of sides.
    before[axis] =
      SideNormalsAt(arrays, id) ? now[axis] : arrays.Placements->GetComponent(id, 3 + axis);
  }
  map.CarryNormal(before, normal);
  if (arrays.Radii)
  {
    particles.CentreRadius[4 * i + 3] *= static_cast<float>(map.StretchAcross(before));
  }
  if (arrays.Normals && vtkMath::Distance2BetweenPoints(before, now) < SameNormal)
  {
    std::copy_n(normal, 3, &particles.Normal[4 * i]);
  }
  if (!particles.Shape.empty())
  {
    map.CarryShape(before, &particles.Shape[8 * i]);
  }
  for (int plane = 0; plane < SplatParticles::ClipPlanesIn(particles.ClipStride); ++plane)
  {
    float* const planes = &particles.Clip[particles.ClipStride * i];
    map.CarryClip(before, planes + SplatParticles::PlaneAt(plane),
      planes[SplatParticles::OverlapPlace(plane) + 2]);
  }
  constexpr int borders = SplatParticles::MaximumNumberOfBorders;
  for (int border = 0; border < borders && !particles.Borders.empty(); ++border)
  {
    CarryBorder(map, before, &particles.Borders[4 * (borders * i + border)]);
  }
}

int GhostTypeOf(const ParticleArrays& arrays, vtkIdType id)
{
  return arrays.Ghosts ? static_cast<int>(arrays.Ghosts->GetComponent(id, 0)) : 0;
}

void ZeroUnlessFinite(float* first, int count)
{
  if (!std::all_of(first, first + count, [](float value) { return std::isfinite(value); }))
  {
    std::fill_n(first, count, 0.f);
  }
}

// Forgets what float32 does not hold, or what an affine map has made infinite: a particle is not drawn then, or drawn
// flat, or not cut.
void ForgetInfinities(SplatParticles& particles, vtkIdType i)
{
  float* const normal = &particles.Normal[4 * i];
  float* const centreRadius = &particles.CentreRadius[4 * i];
  ZeroUnlessFinite(centreRadius, 4);
  if (!std::isfinite(normal[0] + normal[1] + normal[2]))
  {
    std::fill_n(normal, 3, 0.f);
    centreRadius[3] = 0.f;
  }
  if (centreRadius[3] == 0.f)
  {
    normal[2] = 1.f; // any direction: shaders need not mind a zero one
  }
  if (!particles.Shape.empty())
  {
    ZeroUnlessFinite(&particles.Shape[8 * i], 8);
  }
  if (particles.ClipStride > 0)
  {
    ZeroUnlessFinite(&particles.Clip[particles.ClipStride * i], particles.ClipStride);
  }
  constexpr int borders = SplatParticles::MaximumNumberOfBorders;
  for (int border = 0; border < borders && !particles.Borders.empty(); ++border)
  {
    ZeroUnlessFinite(&particles.Borders[4 * (borders * i + border)], 4);
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
  if (GhostTypeOf(arrays, particles.PointIds[particle]) & vtkDataSetAttributes::DUPLICATEPOINT)
  {
    tag += SplatParticles::GhostMark;
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

// Some columns of an array as an array; none where it has not as many.
vtkSmartPointer<vtkDataArray> ColumnsOf(vtkDataArray* all, int first, int components)
{
  if (first + components > all->GetNumberOfComponents())
  {
    return nullptr;
  }
  auto columns = vtkSmartPointer<vtkDoubleArray>::New();
  columns->SetNumberOfComponents(components);
  columns->SetNumberOfTuples(all->GetNumberOfTuples());
  for (int c = 0; c < components; ++c)
  {
    columns->CopyComponent(c, all, first + c);
  }
  return columns;
}

// The columns with a name of an array that is made of columns; nullptr without it.
template <std::size_t Count>
vtkDataArray* FindColumns(vtkDataArray* packed, const SplatColumn (&columns)[Count],
  const std::string& name, ParticleArrays& owner)
{
  int first = 0;
  for (const SplatColumn& column : columns)
  {
    if (packed && column.name == name)
    {
      owner.Columns.push_back(ColumnsOf(packed, first, column.components));
      return owner.Columns.back();
    }
    first += column.components;
  }
  return nullptr;
}

// The arrays of other sides of creases. Where cells end there, nothing is known of.
ParticleArrays OtherSidesOf(const ParticleArrays& own)
{
  ParticleArrays other = own;
  const auto find = [&](const char* name)
  { return FindColumns(own.Creases, CreaseColumns, name, other); };
  other.SideNormals = find("Other_Normal");
  other.ClipNormals = find("Clip_Normal");
  other.ClipDistances = find("Clip_Distance");
  other.ClipAngles = find("Clip_Angle");
  other.ClipCurvatures = find("Clip_Curvature");
  other.ShapeOperators = own.ShapeOperators ? find("Shape_Operator") : nullptr;
  other.CellBorders = nullptr;
  return other;
}

// Gives points on creases a second particle, behind all others.
void AddOtherSides(vtkDataArray* normals, SplatParticles& particles)
{
  const vtkIdType count = particles.GetNumberOfParticles();
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (IsSet(normals, particles.PointIds[i]))
    {
      particles.PointIds.push_back(particles.PointIds[i]);
      if (!particles.CellIds.empty())
      {
        particles.CellIds.push_back(particles.CellIds[i]);
      }
    }
  }
}

// Reads all of a particle. Returns whether it can be drawn.
bool ReadAll(vtkPoints* points, const ParticleArrays& arrays, const std::vector<double>& isovalues,
  const ParticleMotion& motion, SplatParticles& particles, vtkIdType i)
{
  const vtkIdType id = particles.PointIds[i];
  vtkDataArray* const sides = SideNormalsAt(arrays, id);
  const bool hidden = GhostTypeOf(arrays, id) & vtkDataSetAttributes::HIDDENPOINT;
  const double radius = hidden ? 0.
    : arrays.Radii             ? arrays.Radii->GetComponent(id, 0)
                               : arrays.FallbackRadius;
  const bool isDrawn = ReadParticle(points, id, radius, sides ? sides : arrays.Normals,
    particles.Origin, &particles.CentreRadius[4 * i], &particles.Normal[4 * i]);
  particles.Normal[4 * i + 3] = TagOf(arrays, particles, isovalues, i);
  if (!particles.Shape.empty())
  {
    ReadShape(arrays.ShapeOperators, id, &particles.Shape[8 * i]);
  }
  const int stride = particles.ClipStride;
  if (stride > 0)
  {
    ReadClipPlanes(arrays, id, std::min(CountPlanes(arrays), SplatParticles::ClipPlanesIn(stride)),
      &particles.Clip[stride * i]);
  }
  if (!particles.Borders.empty() && arrays.CellBorders)
  {
    ReadBorders(
      arrays.CellBorders, id, &particles.Borders[4 * SplatParticles::MaximumNumberOfBorders * i]);
  }
  if (const LinearMap* map = motion.Of(id))
  {
    Carry(*map, arrays, id, particles, i);
  }
  ForgetInfinities(particles, i);
  return isDrawn;
}
}

//------------------------------------------------------------------------------
vtkDataArray* ParticleArrays::IfComplete(vtkDataArray* array, vtkIdType rows)
{
  return array && array->GetNumberOfTuples() >= rows ? array : nullptr;
}

//------------------------------------------------------------------------------
ParticleArrays ParticleArrays::FromPointData(vtkPointData* data, vtkIdType points)
{
  ParticleArrays arrays;
  vtkDataArray* packed = IfComplete(data->GetArray(SplatColumnsArray), points);
  const auto find = [&](const char* name)
  {
    vtkDataArray* found = IfComplete(data->GetArray(name), points);
    return found ? found : FindColumns(packed, SplatColumns, name, arrays);
  };
  arrays.Normals = IfComplete(data->GetNormals(), points);
  arrays.ClipNormals = find("Clip_Normal");
  arrays.ClipDistances = find("Clip_Distance");
  arrays.ClipAngles = find("Clip_Angle");
  arrays.ClipCurvatures = find("Clip_Curvature");
  arrays.ShapeOperators = find("Shape_Operator");
  arrays.Placements = find("Original_Placement");
  arrays.CellBorders = find("Cell_Borders");
  arrays.Isovalues = IfComplete(data->GetArray("Isovalue"), points);
  arrays.Ghosts = IfComplete(data->GetArray(vtkDataSetAttributes::GhostArrayName()), points);
  vtkDataArray* creases = IfComplete(data->GetArray(CreaseColumnsArray), points);
  const bool isWhole =
    creases && creases->GetNumberOfComponents() == splatColumnCount(CreaseColumns);
  arrays.Creases = isWhole ? creases : nullptr;
  arrays.SideNormals = FindColumns(arrays.Creases, CreaseColumns, "Side_Normal", arrays);
  return arrays;
}

//------------------------------------------------------------------------------
float SplatParticles::OverlapAt(double degrees)
{
  static_assert(Overlap::AtCrease < LeastSmoothOverlap && LeastSmoothOverlap < SmoothOverlap);
  const double cosine = std::cos(vtkMath::RadiansFromDegrees(degrees));
  if (degrees < Overlap::SmoothDegrees)
  {
    return degrees == 0. ? OpenOverlap : SmoothOverlap;
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
SplatParticles SplatParticles::FromPolyData(vtkPolyData* input, const ParticleArrays& all)
{
  SplatParticles particles;
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return particles;
  }
  const std::vector<vtkIdType> lost = CollectIds(input, particles);
  particles.Origin = MiddleOfFinitePoints(input->GetPoints());

  const ParticleMotion motion(input->GetPoints(), all.Placements);
  particles.Warped = motion.IsWarped();

  const vtkIdType firstOther = particles.GetNumberOfParticles();
  const ParticleArrays otherSides = all.SideNormals ? OtherSidesOf(all) : ParticleArrays();
  if (otherSides.SideNormals)
  {
    AddOtherSides(otherSides.SideNormals, particles);
  }
  const vtkIdType count = particles.GetNumberOfParticles();
  particles.ClipStride = particles.Warped ? 0 : ClipStrideOf(all, particles.PointIds);
  particles.CentreRadius.assign(4 * count, 0.f);
  particles.Normal.assign(4 * count, 0.f);
  const bool shaped = all.ShapeOperators && all.Normals &&
    all.ShapeOperators->GetNumberOfComponents() == 6 && !particles.Warped;
  particles.Shape.assign(shaped ? 8 * count : 0, 0.f);
  particles.Clip.assign(particles.ClipStride * count, 0.f);
  const bool bordered =
    all.CellBorders && all.CellBorders->GetNumberOfComponents() >= 4 && !particles.Warped;
  particles.Borders.assign(bordered ? 4 * MaximumNumberOfBorders * count : 0, 0.f);
  const std::vector<double> isovalues = FindIsovalues(all.Isovalues, particles.PointIds);
  std::atomic<vtkIdType> skipped(0);
  vtkSMPTools::For(0, count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const ParticleArrays& arrays = i < firstOther ? all : otherSides;
        skipped += !ReadAll(input->GetPoints(), arrays, isovalues, motion, particles, i);
      }
    });
  for (vtkIdType i : lost)
  {
    particles.CentreRadius[4 * i + 3] = 0.f;
    ++skipped;
  }
  particles.Skipped = skipped;
  particles.HasGhosts = std::any_of(particles.PointIds.begin(), particles.PointIds.end(),
    [&](vtkIdType id) { return GhostTypeOf(all, id) & vtkDataSetAttributes::DUPLICATEPOINT; });
  particles.IsovalueRanges = RangesOf(particles, std::max<std::size_t>(1, isovalues.size()));
  if (shaped && IsStronglyBent(particles))
  {
    FitShapes(particles);
  }
  else
  {
    particles.Shape.clear();
  }
  if (all.Normals)
  {
    MarkLayers(particles);
  }
  return particles;
}
}
