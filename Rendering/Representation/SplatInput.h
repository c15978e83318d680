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
 * Arrays that lead back to the input, for selections: of a merged input to its blocks; of a grid to those of
 * its cells that are vertices. -1 stands for no cell. Polydata does not have them.
 */
constexpr const char* BlockPointIdName = "SurfaceSplatPointId";
constexpr const char* BlockCellIdName = "SurfaceSplatCellId";
constexpr const char* BlockIndexName = "SurfaceSplatBlockIndex";

/**
 * Cell array of a merged input where blocks have colours or opacities of their own, see
 * vtkSurfaceSplatMapper::SetCellColorArrayName().
 */
constexpr const char* BlockColorName = "SurfaceSplatBlockColor";

/**
 * The number of its block, of each cell of a merged input: what ParaView's geometry keeps under this name in the
 * field data of blocks.
 */
constexpr const char* BlockNumberName = "vtkBlockColors";

/**
 * How the blocks of a composite are drawn. Selectors are in the language of vtkDataAssembly for its
 * hierarchy; "/" names all. Of colours and opacities the last one that names a block counts.
 */
struct Blocks
{
  std::set<std::string> Drawn = { "/" };
  std::vector<std::pair<std::string, std::array<double, 3>>> Colors; ///< RGB in [0, 1]
  std::vector<std::pair<std::string, double>> Opacities;             ///< in [0, 1]
  unsigned int DistinctNumbers = 7; ///< after so many blocks their numbers begin again with 0
};

/**
 * Polydata comes back as a shallow copy, other point sets with their points and vertex cells, the
 * blocks of a composite merged into one, so that their disks meet without seams and the nearest one
 * wins. Of arrays only those common to all blocks are kept. Other data, and nullptr, give a polydata
 * without points.
 */
vtkSmartPointer<vtkPolyData> AsParticles(vtkDataObject* data, const Blocks& blocks = {});

/**
 * A shallow copy without the arrays named above, but for the blocks' numbers, which become field data: what is
 * offered to users.
 */
vtkSmartPointer<vtkPolyData> WithoutBlockIds(vtkPolyData* particles);
}
}
