/**
 * @struct ParticleInput
 * @brief  a polydata, and what the properties of the mapper make of it: the arrays and sizes of its particles
 */

#pragma once

#include "Particles/SplatParticles.h"

#include <string>
#include <tuple>

class vtkDoubleArray;

namespace hop
{
struct ParticleInput
{
  vtkPolyData* Data;              ///< never nullptr
  const char* RadiusArrayName;    ///< nullptr: none
  const char* CellColorArrayName; ///< nullptr: none
  double Radius; ///< of particles without an array of radii, world units; 0: not known

  /** The arrays of these names; nullptr if they are missing or not usable. */
  vtkDataArray* GetRadii() const;
  vtkDataArray* GetCellColors() const;

  bool HasNormals() const;

  /** Whether some particles have a colour of their own that is translucent, or all have. */
  bool HasTranslucentCells() const;
  bool HasOnlyTranslucentCells() const;

  /** Radius of all particles without an array: if not known, the one with which as many disks cover the bounds. */
  double GetFallbackRadius() const;

  /** All that particles are made of. */
  ParticleArrays DescribeArrays() const;

  /** The largest finite radius; 0 if there are no points. */
  double GetLargestRadius() const;

  /**
   * Bounds of all points, grown by the largest radius, or the one given if it is larger, times the scale. Uninitialized
   * bounds if there are no points.
   */
  void GetDiskBounds(double radiusScale, double leastRadius, double bounds[6]) const;

  /** See vtkSurfaceSplatMapper::GetDisks(). */
  vtkSmartPointer<vtkDoubleArray> GetDisks(double radiusScale) const;

  /** What particles are made from: the polydata, to be compared and never dereferenced, its time, radius and names. */
  using Key = std::tuple<vtkPolyData*, vtkMTimeType, double, std::string, std::string>;
  Key GetKey() const;
};
}
