/**
 * @file  vtkSurfaceSplatInput.h
 * @brief any data object as one polydata of particles
 */

#ifndef vtkSurfaceSplatInput_h
#define vtkSurfaceSplatInput_h

#include "vtkSmartPointer.h"

#include <set>
#include <string>

class vtkDataObject;
class vtkPolyData;

namespace vtkSurfaceSplatInput
{
/**
 * Arrays of a merged input that lead back to its blocks, for selections. Inputs that are not
 * composite do not have them.
 */
constexpr const char* BlockPointIdName = "SurfaceSplatPointId";
constexpr const char* BlockCellIdName = "SurfaceSplatCellId";
constexpr const char* BlockIndexName = "SurfaceSplatBlockIndex";

/**
 * Polydata comes back as a shallow copy, other point sets with their points and vertex cells, the
 * blocks of a composite merged into one, so that their disks meet without seams and the nearest one
 * wins. Of arrays only those common to all blocks are kept. Other data, and nullptr, give a polydata
 * without points. Of a composite only those blocks are taken that one of the selectors names, in
 * the language of vtkDataAssembly for its hierarchy; "/" names all.
 */
vtkSmartPointer<vtkPolyData> AsParticles(
  vtkDataObject* data, const std::set<std::string>& blockSelectors = { "/" });

/** A shallow copy without the arrays named above: what is offered to users. */
vtkSmartPointer<vtkPolyData> WithoutBlockIds(vtkPolyData* particles);
}

#endif
