#include "Input/CutMap.h"

#include "vtkAbstractTransform.h"
#include "vtkBox.h"
#include "vtkCylinder.h"
#include "vtkDoubleArray.h"
#include "vtkImplicitFunction.h"
#include "vtkLinearTransform.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkSphere.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace hop
{

namespace
{

/// y = linear x + shift; how an implicit function sees the world.
struct AffineMap
{
  glm::dmat3 linear{ 1.0 };
  glm::dvec3 shift{ 0.0 };
};

/// \pre the transform is linear, or nullptr
AffineMap affineMapOf(vtkAbstractTransform* transform)
{
  AffineMap map;
  if (auto* linear = vtkLinearTransform::SafeDownCast(transform))
  {
    linear->Update();
    vtkMatrix4x4* matrix = linear->GetMatrix();
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        map.linear[column][row] = matrix->GetElement(row, column);
      }
      map.shift[row] = matrix->GetElement(row, 3);
    }
  }
  return map;
}

/// The rows of a matrix that takes a vector to its part across an axis, which has the length of that part.
/// \param axis of unit length
std::vector<glm::dvec3> rowsAcross(const glm::dvec3& axis)
{
  // Any vector that is not along the axis: the coordinate axis on which it has its smallest part.
  const glm::dvec3 sizes = glm::abs(axis);
  const int least = sizes.x <= sizes.y && sizes.x <= sizes.z ? 0 : sizes.y <= sizes.z ? 1 : 2;
  glm::dvec3 other(0.0);
  other[least] = 1.0;
  const glm::dvec3 first = glm::normalize(glm::cross(axis, other));
  return { first, glm::cross(axis, first) };
}

/// A plane's normal and place are asked of the function itself: ParaView's planes have an offset besides.
CutMap mapOfPlane(vtkPlane* plane)
{
  CutMap map;
  map.name = "distance from the plane";
  map.origin = { plane->GetOrigin()[0], plane->GetOrigin()[1], plane->GetOrigin()[2] };
  glm::dvec3 gradient;
  plane->FunctionGradient(&map.origin.x, &gradient.x);
  const double length = glm::length(gradient);
  if (length > 0.0 && std::isfinite(length))
  {
    map.rows = { gradient / length };
    map.origin -= plane->FunctionValue(&map.origin.x) / length * map.rows[0];
  }
  return map;
}

/// A sphere or a cylinder: rows of the function's own space are taken to the world.
CutMap mapAround(vtkImplicitFunction* function, const double center[3], double radius,
  const std::vector<glm::dvec3>& rows, const char* name)
{
  CutMap map;
  map.name = name;
  map.level = radius;
  const AffineMap own = affineMapOf(function->GetTransform());
  map.origin = glm::inverse(own.linear) * (glm::dvec3(center[0], center[1], center[2]) - own.shift);
  for (const glm::dvec3& row : rows)
  {
    map.rows.push_back(row * own.linear);
  }
  return map;
}

/// A box in the space of its function.
struct OwnBox
{
  AffineMap own;
  /// The corners with the smallest and the largest coordinates.
  std::array<glm::dvec3, 2> ends;

  glm::dvec3 inWorld(const glm::dvec3& y) const
  {
    return glm::inverse(this->own.linear) * (y - this->own.shift);
  }

  /// The face across an axis, at the end of the smaller or the larger coordinates.
  CutMap mapOfFace(int axis, int end) const
  {
    glm::dvec3 row(0.0);
    row[axis] = end == 0 ? -1.0 : 1.0;
    glm::dvec3 middle = 0.5 * (this->ends[0] + this->ends[1]);
    middle[axis] = this->ends[end][axis];
    CutMap map;
    map.name = "distance from a face of the box";
    map.origin = this->inWorld(middle);
    map.rows = { row * this->own.linear };
    map.polygonAt = [box = *this, axis, end](double offset)
    { return box.faceAt(axis, end, offset); };
    return map;
  }

  /// The face of the box whose faces have all been moved outwards.
  PlanePolygon faceAt(int axis, int end, double offset) const
  {
    const std::array<glm::dvec3, 2> moved{ this->ends[0] - offset, this->ends[1] + offset };
    PlanePolygon face;
    if (glm::any(glm::lessThanEqual(moved[1], moved[0])))
    {
      return face;
    }
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    constexpr std::array<std::array<int, 2>, 4> around{ { { 0, 0 }, { 1, 0 }, { 1, 1 },
      { 0, 1 } } };
    for (const auto& [atU, atV] : around)
    {
      glm::dvec3 corner = moved[end];
      corner[u] = moved[atU][u];
      corner[v] = moved[atV][v];
      face.corners.push_back(this->inWorld(corner));
    }
    return face;
  }
};

std::vector<CutMap> mapsOfBox(vtkBox* box)
{
  std::array<double, 6> bounds;
  box->GetBounds(bounds.data());
  const OwnBox own{ affineMapOf(box->GetTransform()),
    { glm::dvec3(bounds[0], bounds[2], bounds[4]), glm::dvec3(bounds[1], bounds[3], bounds[5]) } };
  std::vector<CutMap> maps(6);
  for (int face = 0; face < 6; ++face)
  {
    maps[face] = own.mapOfFace(face / 2, face % 2);
  }
  return maps;
}

CutMap mapOf(vtkImplicitFunction* function)
{
  if (auto* plane = vtkPlane::SafeDownCast(function))
  {
    return mapOfPlane(plane);
  }
  if (auto* sphere = vtkSphere::SafeDownCast(function))
  {
    return mapAround(sphere, sphere->GetCenter(), sphere->GetRadius(),
      { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } }, "distance from the center");
  }
  if (auto* cylinder = vtkCylinder::SafeDownCast(function))
  {
    const double* axis = cylinder->GetAxis();
    return mapAround(cylinder, cylinder->GetCenter(), cylinder->GetRadius(),
      rowsAcross(glm::normalize(glm::dvec3(axis[0], axis[1], axis[2]))), "distance from the axis");
  }
  return {};
}

bool isSound(const CutMap& map)
{
  bool sound = !map.rows.empty() && std::isfinite(map.level) && !glm::any(glm::isnan(map.origin)) &&
    !glm::any(glm::isinf(map.origin));
  for (const glm::dvec3& row : map.rows)
  {
    sound = sound && std::isfinite(glm::length(row)) && glm::length(row) > 0.0;
  }
  return sound;
}

} // namespace

std::vector<CutMap> cutMapsOf(vtkImplicitFunction* function, UserMessages& messages)
{
  const auto refuse = [&](const std::string& text)
  {
    messages.push_back({ UserMessage::Error, text });
    return std::vector<CutMap>{};
  };
  if (!function)
  {
    return refuse("There is no slice, as no SliceType is given; choose a plane, a sphere, a "
                  "cylinder or a box.");
  }
  auto* box = vtkBox::SafeDownCast(function);
  const bool isKnown =
    box || function->IsA("vtkPlane") || function->IsA("vtkSphere") || function->IsA("vtkCylinder");
  vtkAbstractTransform* transform = function->GetTransform();
  if (!isKnown || (transform && !transform->IsA("vtkLinearTransform")))
  {
    return refuse(std::string("A slice along a ") + function->GetClassName() +
      (isKnown ? " with a transform that is not linear" : "") +
      " is not possible; choose a plane, a sphere, a cylinder or a box.");
  }
  std::vector<CutMap> maps = box ? mapsOfBox(box) : std::vector<CutMap>{ mapOf(function) };
  if (!std::all_of(maps.begin(), maps.end(), isSound))
  {
    return refuse(std::string("The ") + function->GetClassName() +
      " of the slice has a normal, an axis or a side of length zero, or numbers that are not "
      "finite; correct it.");
  }
  return maps;
}

vtkSmartPointer<vtkDataArray> cutValues(const CutMap& map, vtkUnstructuredGrid* grid)
{
  const auto values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetName(map.name);
  values->SetNumberOfComponents(static_cast<int>(map.rows.size()));
  values->SetNumberOfTuples(grid->GetNumberOfPoints());
  double* out = values->GetPointer(0);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 x;
    grid->GetPoint(i, &x.x);
    for (const glm::dvec3& row : map.rows)
    {
      *out++ = glm::dot(row, x - map.origin);
    }
  }
  return values;
}

} // namespace hop
