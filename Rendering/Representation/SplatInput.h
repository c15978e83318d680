/**
 * @file  SplatInput.h
 * @brief any data object as one polydata of particles
 */

#pragma once

#include "vtkSmartPointer.h"

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace hop
{
namespace SplatInput
{
/**
 * Names of arrays that lead from particles back to the input, for selections: of a merged input to its blocks, of a
 * grid to its vertex cells. -1 stands for no cell. Particles from polydata have these arrays only on several ranks, see
 * EnsureIds().
 */
constexpr const char* BlockPointIdName = "SurfaceSplatPointId";
constexpr const char* BlockCellIdName = "SurfaceSplatCellId";
constexpr const char* BlockIndexName = "SurfaceSplatBlockIndex";

/**
 * Name of the cell array that a merged input has where blocks have colours or opacities of their own, see
 * vtkSurfaceSplatMapper::SetCellColorArrayName().
 */
constexpr const char* BlockColorName = "SurfaceSplatBlockColor";

/**
 * Name of the cell array with the number of each cell's block in a merged input. ParaView's geometry keeps the number
 * under this name in the field data of blocks.
 */
constexpr const char* BlockNumberName = "vtkBlockColors";

/**
 * How the blocks of a composite are drawn. Selectors are in the language of vtkDataAssembly for the composite's
 * hierarchy; "/" names all blocks. Where several colours or opacities name a block, the last one counts.
 */
struct Blocks
{
  std::set<std::string> Drawn = { "/" };
  std::vector<std::pair<std::string, std::array<double, 3>>> Colors; ///< RGB in [0, 1]
  std::vector<std::pair<std::string, double>> Opacities;             ///< in [0, 1]
  unsigned int DistinctNumbers =
    12; ///< numbers of blocks go from 0 to before this, and begin again
};

/**
 * The particles of a data object. Polydata comes back as a shallow copy; other point sets with their points and vertex
 * cells; the blocks of a composite merged into one polydata, so that their disks meet without seams and the nearest one
 * is seen. A merged polydata keeps the arrays that all blocks have. Other data, and nullptr, give a polydata without
 * points.
 */
vtkSmartPointer<vtkPolyData> AsParticles(vtkDataObject* data, const Blocks& blocks = {});

/** Gives particles the arrays with numbers of points and cells if they have none: their places. */
void EnsureIds(vtkPolyData* particles);

/**
 * A shallow copy as it is offered to users: without the arrays named above, and with the blocks' numbers as field data.
 */
vtkSmartPointer<vtkPolyData> WithoutBlockIds(vtkPolyData* particles);
}
}
