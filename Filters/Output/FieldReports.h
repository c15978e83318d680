#pragma once

#include "Output/OutputRows.h"

class vtkFieldData;

namespace hop
{

/// Removes what the functions below add, as an input may have it that is an output of this filter.
void removeReports(vtkFieldData* from);

/// Tells of the run: the arrays of reportArrays().
/// \param block whose cells are told of
void addRunReport(const std::vector<IsovalueParticles>& isovalues, const InputBlocks& blocks,
  std::size_t block, const CellCensus& census, vtkFieldData* to);

/// Tells of meshes what they lack, and of each component what is known: the arrays of meshReportArrays() and
/// componentArrays().
/// \param unitOfLength world units
void addMeshReports(
  const std::vector<IsovalueParticles>& isovalues, double unitOfLength, vtkFieldData* to);

} // namespace hop
