/**
 * @file  GhostParticles.h
 * @brief particles of other ranks beside a rank's own, so that splats blend where ranks meet
 */

#pragma once

#include "vtkSmartPointer.h"

class vtkBoundingBox;
class vtkDoubleArray;
class vtkMultiProcessController;
class vtkPolyData;

namespace hop
{
namespace GhostParticles
{
/** Name of the point array with the number of the rank that has each particle, as selections want it. */
constexpr const char* RankName = "SurfaceSplatRank";

/**
 * The box around all disks with a radius; not valid where there are none. The boxes of several ranks make up that of one
 * rank with all particles.
 */
vtkBoundingBox BoxOf(vtkDoubleArray* disks);

/**
 * This rank's particles and, behind them, the ghosts: copies of those particles of other ranks whose disks reach the
 * disks of this rank's, both with twice their radius, and with all arrays that this rank has. They are marked in vtkGhostType. What the input has marked
 * there is hidden. Every rank of the controller has to call it, also one without particles; a rank that is alone gets
 * its input back. Ranks send each other the disks in the boxes around the others' disks, and then the ghosts.
 *
 * Where the input has vertex cells, the ghosts are vertex cells behind them; other cells are left out then.
 *
 * @param disks for each point centre and radius, see vtkSurfaceSplatMapper::GetDisks(); particles with the radius 0 have
 *   no part in it
 */
vtkSmartPointer<vtkPolyData> Add(
  vtkPolyData* own, vtkDoubleArray* disks, vtkMultiProcessController* controller);

/**
 * All particles on rank 0, marked as Add() does, and none on other ranks; with the arrays of the first rank that has
 * particles. Every rank of the controller has to call it; a rank that is alone gets its input back.
 */
vtkSmartPointer<vtkPolyData> Gather(vtkPolyData* own, vtkMultiProcessController* controller);

/** Whether particles of several ranks have been merged, so that what ghosts are copies of is there as well. */
bool AreMerged(vtkPolyData* particles);
}
}
