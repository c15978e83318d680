#include "Conversion/CellCensus.h"

#include "Elements/Domain.h"
#include "Input/VtkCompatibility.h"

#include "vtkGenericCell.h"
#include "vtkSmartPointer.h"

#include <sstream>

namespace hop
{

namespace
{

/// The class of a cell type. VTK's table of names confuses triangles and quadrilaterals of Lagrange and Bezier type, so
/// it is asked only about types of which no cell can be made.
std::string nameOfCellType(int type)
{
  const auto cell = vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(type));
  return cell ? cell->GetClassName() : CellTypeNames::GetClassNameFromTypeId(type);
}

/// \param advice follows the cells; may be empty
void describeCells(std::ostream& text, const SkippedCells& cells, const std::string& reason,
  const std::string& advice = "")
{
  if (cells.count > 0)
  {
    text << "\n  " << cells.count << (cells.count == 1 ? " cell " : " cells ") << reason
         << " (first: cell " << cells.first << ")" << advice;
  }
}

} // namespace

void CellCensus::count(Verdict verdict, vtkIdType cell, int cellType)
{
  switch (verdict)
  {
    case Verdict::Drop:
      ++this->dropped;
      break;
    case Verdict::Unsupported:
      this->unsupported[cellType].add(cell);
      break;
    case Verdict::BrokenConnectivity:
      this->brokenConnectivity.add(cell);
      break;
    case Verdict::NotFinite:
      this->notFinite.add(cell);
      break;
    case Verdict::BadWeights:
      this->badWeights.add(cell);
      break;
    case Verdict::Level:
      this->level.add(cell);
      break;
    case Verdict::Singular:
      this->singular.add(cell);
      break;
    case Verdict::Undefined:
      this->undefined.add(cell);
      break;
    case Verdict::Keep:
    case Verdict::Ghost:
      break;
  }
}

void CellCensus::add(const CellCensus& others)
{
  this->dropped += others.dropped;
  for (const auto& [type, cells] : others.unsupported)
  {
    this->unsupported[type].add(cells);
  }
  this->brokenConnectivity.add(others.brokenConnectivity);
  this->notFinite.add(others.notFinite);
  this->badWeights.add(others.badWeights);
  this->level.add(others.level);
  this->singular.add(others.singular);
  this->undefined.add(others.undefined);
  this->collapsed.add(others.collapsed);
  for (const auto& [which, cells] : others.misordered)
  {
    this->misordered[which].add(cells);
  }
  this->folded.add(others.folded);
  this->unresolved.add(others.unresolved);
}

vtkIdType CellCensus::skipped() const
{
  vtkIdType sum = this->brokenConnectivity.count + this->notFinite.count + this->badWeights.count +
    this->level.count + this->collapsed.count + this->singular.count + this->undefined.count;
  for (const auto& [type, cells] : this->unsupported)
  {
    sum += cells.count;
  }
  for (const auto& [which, cells] : this->misordered)
  {
    sum += cells.count;
  }
  return sum;
}

std::string CellCensus::describe() const
{
  std::ostringstream text;
  for (const auto& [type, cells] : this->unsupported)
  {
    describeCells(text, cells,
      "of type " + nameOfCellType(type) +
        " skipped: not a supported 3-D cell, or its number of points fits no degree up to " +
        std::to_string(maximumInputDegree(Domain::Tetrahedron)) +
        " (hexahedra: " + std::to_string(maximumInputDegree(Domain::Hexahedron)) + ")");
  }
  describeCells(text, this->brokenConnectivity, "skipped: point ids outside the grid");
  describeCells(text, this->notFinite,
    "skipped: coordinates or values that are NaN or infinite, or values 1e75 times as large as "
    "the changes of the field in other cells");
  describeCells(text, this->badWeights, "skipped: RationalWeights that are not positive");
  describeCells(text, this->level,
    "skipped: the field is the isovalue throughout, to rounding, which is no surface");
  describeCells(text, this->singular,
    "skipped: so distorted that derivatives may be infinite in them: the Jacobian determinant is "
    "not proven to keep its sign");
  describeCells(text, this->undefined,
    "skipped: the quantity is not finite somewhere in them: a formula divides by zero, or takes a "
    "root or a logarithm of what has none");
  describeCells(text, this->collapsed,
    "skipped: without volume, or smaller than 1e-15 of the bounds of the input");
  for (const auto& [which, cells] : this->misordered)
  {
    describeCells(text, cells,
      "of type " + nameOfCellType(which.first) + " skipped: " + which.second,
      ". The file seems to have its nodes in another order than VTK's, as Gmsh's is for instance: "
      "check what wrote it");
  }
  describeCells(text, this->folded, "kept, but partly inverted: the Jacobian changes its sign");
  describeCells(text, this->unresolved,
    "kept, but the Quantity is not smooth enough in them: polynomials miss it by more than 1e-9 of "
    "its largest value there, and what of the surface is smaller may be missing");
  return text.str();
}

} // namespace hop
