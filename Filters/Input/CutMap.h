#pragma once

#include "Input/UserMessage.h"

#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <vector>

class vtkDataArray;
class vtkImplicitFunction;
class vtkUnstructuredGrid;

namespace hop
{

/// The surface of a slice, as a linear map of world coordinates: on a plane the value of the map is `level`, on a
/// sphere or a cylinder its length. Elements carry coordinates in their own polynomials, or rational functions, so that
/// nodal values of the map describe it exactly, on curved elements, too.
struct CutMap
{
  /// The map is 0 there.
  glm::dvec3 origin{ 0.0 };
  /// One a component: 1 of a plane (its unit normal), 2 of a cylinder, 3 of a sphere. Lengths are those of the world, or of
  /// the space to which the function's transform leads.
  std::vector<glm::dvec3> rows;
  /// 0 of a plane, else the radius.
  double level = 0.0;
  /// What its value or length is, for messages.
  const char* name = "";
};

/// The map of a vtkPlane, vtkSphere or vtkCylinder, with its transform if that is linear.
/// \param messages receives what is wrong with the function; then the map has no rows
CutMap cutMapOf(vtkImplicitFunction* function, UserMessages& messages);

/// The map at all points of a grid, one component a row of the map.
vtkSmartPointer<vtkDataArray> cutValues(const CutMap& map, vtkUnstructuredGrid* grid);

} // namespace hop
