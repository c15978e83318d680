#include "Particles/ParticleInput.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace hop
{
namespace
{
// Radius of all particles without a radius array, as a share of their distance. Hexagons are covered from 0.577 =
// 1 / sqrt(3) on; three quarters leave some room for unevenness. Smaller disks leave holes, larger ones stand out more.
constexpr double FallbackRadiusShare = 0.75;

// Bounds of the points that are finite.
void GetFiniteBounds(vtkPolyData* data, double bounds[6])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    data->GetPoints()->GetData()->GetFiniteRange(bounds + 2 * axis, axis);
  }
}
}

//------------------------------------------------------------------------------
vtkDataArray* ParticleInput::GetRadii() const
{
  return this->RadiusArrayName
    ? ParticleArrays::IfComplete(this->Data->GetPointData()->GetArray(this->RadiusArrayName),
        this->Data->GetNumberOfPoints())
    : nullptr;
}

vtkDataArray* ParticleInput::GetCellColors() const
{
  vtkDataArray* colors = this->CellColorArrayName
    ? ParticleArrays::IfComplete(this->Data->GetCellData()->GetArray(this->CellColorArrayName),
        this->Data->GetNumberOfVerts())
    : nullptr;
  return colors && colors->GetNumberOfComponents() == 4 && colors->GetNumberOfTuples() > 0
    ? colors
    : nullptr;
}

bool ParticleInput::HasNormals() const
{
  return ParticleArrays::IfComplete(
           this->Data->GetPointData()->GetNormals(), this->Data->GetNumberOfPoints()) != nullptr;
}

bool ParticleInput::HasTranslucentCells() const
{
  vtkDataArray* colors = this->GetCellColors();
  return colors && colors->GetRange(3)[0] < 1.;
}

bool ParticleInput::HasOnlyTranslucentCells() const
{
  vtkDataArray* colors = this->GetCellColors();
  return colors && colors->GetRange(3)[1] < 1.;
}

//------------------------------------------------------------------------------
double ParticleInput::GetFallbackRadius() const
{
  if (this->Radius > 0.)
  {
    return this->Radius;
  }
  double bounds[6];
  GetFiniteBounds(this->Data, bounds);
  const double distance = SplatParticles::EstimateDistance(bounds, this->Data->GetNumberOfPoints());
  return distance > 0. ? FallbackRadiusShare * distance : 1.;
}

//------------------------------------------------------------------------------
ParticleArrays ParticleInput::DescribeArrays() const
{
  auto arrays =
    ParticleArrays::FromPointData(this->Data->GetPointData(), this->Data->GetNumberOfPoints());
  arrays.Radii = this->GetRadii();
  arrays.FallbackRadius = this->GetFallbackRadius();
  arrays.CellColors = this->GetCellColors();
  return arrays;
}

//------------------------------------------------------------------------------
double ParticleInput::GetLargestRadius() const
{
  if (this->Data->GetNumberOfPoints() == 0)
  {
    return 0.;
  }
  double range[2] = { 0., this->GetFallbackRadius() };
  if (vtkDataArray* radii = this->GetRadii())
  {
    radii->GetFiniteRange(range, 0);
  }
  return std::max(range[1], 0.);
}

//------------------------------------------------------------------------------
void ParticleInput::GetDiskBounds(double radiusScale, double leastRadius, double bounds[6]) const
{
  vtkMath::UninitializeBounds(bounds);
  if (this->Data->GetNumberOfPoints() == 0)
  {
    return;
  }
  const double margin = radiusScale * std::max(this->GetLargestRadius(), leastRadius);
  GetFiniteBounds(this->Data, bounds);
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] -= margin;
    bounds[2 * axis + 1] += margin;
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDoubleArray> ParticleInput::GetDisks(double radiusScale) const
{
  auto disks = vtkSmartPointer<vtkDoubleArray>::New();
  disks->SetNumberOfComponents(4);
  disks->SetNumberOfTuples(this->Data->GetNumberOfPoints());
  disks->Fill(0.);
  const ParticleArrays all =
    ParticleArrays::FromPointData(this->Data->GetPointData(), this->Data->GetNumberOfPoints());
  ParticleArrays arrays;
  arrays.Radii = this->GetRadii();
  arrays.FallbackRadius = this->Radius;
  arrays.Normals = all.Normals;
  arrays.Placements = all.Placements;
  arrays.Ghosts = all.Ghosts;
  const auto particles = SplatParticles::FromPolyData(this->Data, arrays);
  for (vtkIdType i = 0; i < particles.GetNumberOfParticles(); ++i)
  {
    double* disk = disks->GetPointer(4 * particles.PointIds[i]);
    this->Data->GetPoint(particles.PointIds[i], disk);
    disk[3] = radiusScale * particles.CentreRadius[4 * i + 3];
  }
  return disks;
}

//------------------------------------------------------------------------------
ParticleInput::Key ParticleInput::GetKey() const
{
  return { this->Data, this->Data->GetMTime(), this->Radius,
    this->RadiusArrayName ? this->RadiusArrayName : "",
    this->CellColorArrayName ? this->CellColorArrayName : "" };
}
}
