#include "VtkCells.h"

#include <vtkIdList.h>
#include <vtkLagrangeHexahedron.h>
#include <vtkLagrangeTetra.h>
#include <vtkLagrangeWedge.h>
#include <vtkPoints.h>

namespace hop::testing
{
namespace
{

void setNodeCount(vtkNonLinearCell& cell, int count)
{
  cell.GetPoints()->SetDataTypeToDouble();
  cell.GetPoints()->SetNumberOfPoints(count);
  cell.GetPointIds()->SetNumberOfIds(count);
}

} // namespace

vtkSmartPointer<vtkNonLinearCell> makeLagrangeCell(Domain domain, int nodeCount)
{
  if (domain == Domain::Tetrahedron)
  {
    auto cell = vtkSmartPointer<vtkLagrangeTetra>::New();
    setNodeCount(*cell, nodeCount);
    cell->Initialize();
    return cell;
  }
  if (domain == Domain::Wedge)
  {
    auto cell = vtkSmartPointer<vtkLagrangeWedge>::New();
    setNodeCount(*cell, nodeCount);
    cell->SetUniformOrderFromNumPoints(nodeCount);
    cell->Initialize();
    return cell;
  }
  auto cell = vtkSmartPointer<vtkLagrangeHexahedron>::New();
  setNodeCount(*cell, nodeCount);
  cell->SetUniformOrderFromNumPoints(nodeCount);
  cell->Initialize();
  return cell;
}

VtkCell::VtkCell(const ElementCase& which)
{
  const int count = coefficientCount(which.domain, which.degrees);
  this->Cell = makeLagrangeCell(which.domain, count);
  this->Weights.resize(count);
  Random random(2);
  const double* nodes = this->Cell->GetParametricCoords();
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 u(nodes[3 * i], nodes[3 * i + 1], nodes[3 * i + 2]);
    const glm::dvec3 x = u + 0.1 * glm::dvec3(u.y * u.y, u.z * u.z, u.x * u.x);
    this->Cell->GetPoints()->SetPoint(i, x.x, x.y, x.z);
    this->Cell->GetPointIds()->SetId(i, i);
    this->Values.push_back(randomNumber(random));
  }
}

double VtkCell::evaluate(const ReferencePoint& u)
{
  const double where[3] = { u.xyz.x, u.xyz.y, u.xyz.z };
  double x[3];
  double gradient[3];
  int subId = 0;
  this->Cell->EvaluateLocation(subId, where, x, this->Weights.data());
  this->Cell->Derivatives(subId, where, this->Values.data(), 1, gradient);
  return x[0] + gradient[0];
}

} // namespace hop::testing
