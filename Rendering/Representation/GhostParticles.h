/**
 * @file  GhostParticles.h
 * @brief particles of other ranks beside a rank's own, so that splats blend where ranks meet
 */

#pragma once

#include "vtkSmartPointer.h"

class vtkDoubleArray;
class vtkMultiProcessController;
class vtkPolyData;

namespace hop
{
namespace GhostParticles
{
/** Name of the point array with the number of the rank that has each particle, as selections want it. */
constexpr const char* RankName = "SurfaceSplatRank";

/** The largest of the radii that the ranks give. Every rank of the controller has to call it. */
double LargestOfRanks(double radius, vtkMultiProcessController* controller);

/**
 * This rank's particles and, behind them, the ghosts: copies of those particles of other ranks whose disks, with twice
 * their radius, reach this rank's, with all arrays that this rank has. They are marked in vtkGhostType. What the input has marked
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
