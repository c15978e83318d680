#pragma once

#include "Input/UserMessage.h"
#include "Surface/PlanePolygon.h"

#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <functional>
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
  /// Of a face of a box: to what an offset of its plane is cut, nothing where the box has turned inside out. Not set
  /// elsewhere.
  std::function<PlanePolygon(double offset)> polygonAt;
};

/// The map of a vtkPlane, vtkSphere or vtkCylinder, or those of the six faces of a vtkBox, with the function's transform if
/// that is linear. The map of a face is the distance outwards.
/// \param messages receives what is wrong with the function; then there are no maps
std::vector<CutMap> cutMapsOf(vtkImplicitFunction* function, UserMessages& messages);

/// The map at all points of a grid, one component a row of the map.
vtkSmartPointer<vtkDataArray> cutValues(const CutMap& map, vtkUnstructuredGrid* grid);

} // namespace hop
