#include "Output/OutputArrays.h"

#include "Common/SplatColumns.h"
#include "Conversion/CellBases.h"

#include "vtkAbstractArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"

#include <algorithm>
#include <iterator>

namespace hop
{

namespace
{

template <class Component, class Number>
void writeVector(const glm::vec<3, Component>& v, Number* out)
{
  std::copy_n(&v.x, 3, out);
}

/// Writes a quantity of all clip planes.
template <class Quantity>
void writeOfClips(const ParticleRow& row, double* out, const Quantity& quantity)
{
  for (const ClipPlane& plane : row.particle->clips)
  {
    *out++ = quantity(plane);
  }
}

void writeShapeOperator(const ParticleRow& row, const RowCells& cells, double* out)
{
  const glm::dmat3& shape = row.particle->curvature.shape;
  const double components[] = { shape[0][0], shape[1][1], shape[2][2], shape[0][1], shape[1][2],
    shape[0][2] }; // VTK's order of symmetric tensors
  std::transform(std::begin(components), std::end(components), out,
    [&](double component) { return cells.curvature(component); });
}

void writePlacement(const ParticleRow& row, const RowCells& cells, double* out)
{
  writeVector(cells.position(row).xyz, out);
  writeVector(row.particle->normal.xyz, out + 3);
}

void writeParametricCoordinates(const ParticleRow& row, const RowCells& cells, double* out)
{
  // Places on a face may have left the domain by a rounding error.
  const ReferencePoint u{ glm::clamp(cells.inCell(row).xyz, 0.0, 1.0) };
  writeVector(parametricCoordinates(cells.cellTypeOf(row), u).xyz, out);
}

void writeCellBorders(const ParticleRow& row, const RowCells& cells, double* out)
{
  for (const CellBorder& border : row.particle->borders)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      *out++ = cells.length(border.foot[axis]);
    }
    *out++ = cells.curvature(border.curvature);
  }
}

void writeCellId(const ParticleRow& row, const RowCells& cells, vtkIdType* out)
{
  *out = cells.cellOf(row);
}

/// The arrays that are columns, in their order; those of no such name are left out.
template <std::size_t Count>
std::vector<const ParticleArray*> findColumns(const SplatColumn (&names)[Count])
{
  const std::vector<ParticleArray>& table = particleArrays();
  std::vector<const ParticleArray*> columns;
  for (const SplatColumn& column : names)
  {
    const auto found = std::find_if(table.begin(), table.end(),
      [&](const ParticleArray& array) { return array.name == std::string(column.name); });
    if (found != table.end())
    {
      columns.push_back(&*found);
    }
  }
  return columns;
}

/// Writes columns one after the other.
void writeColumns(const std::vector<const ParticleArray*>& columns, const ParticleRow& row,
  const RowCells& cells, double* out)
{
  for (const ParticleArray* column : columns)
  {
    std::get<RowWriter<double>>(column->write)(row, cells, out);
    out += column->components;
  }
}

void writeSplatColumns(const ParticleRow& row, const RowCells& cells, double* out)
{
  static const std::vector<const ParticleArray*> columns = findColumns(SplatColumns);
  writeColumns(columns, row, cells, out);
}

void writeCreaseColumns(const ParticleRow& row, const RowCells& cells, double* out)
{
  static const std::vector<const ParticleArray*> columns = findColumns(CreaseColumns);
  std::fill_n(out, splatColumnCount(CreaseColumns), 0.0);
  if (row.otherSide)
  {
    writeVector(row.particle->sideNormal, out);
    writeVector(row.otherSide->sideNormal, out + 3);
    ParticleRow other;
    other.particle = row.otherSide;
    writeColumns(columns, other, cells, out + 6);
  }
}

std::vector<ParticleArray> makeParticleArrays()
{
  return {
    { NormalsArray, 3,
      "Unit normal of the surface, -grad F/|grad F|: towards lower values, as Contour orients it.",
      [](const ParticleRow& row, const RowCells&, float* out)
      { writeVector(glm::vec3(row.particle->normal.xyz), out); } },
    { "Radius", 1,
      "Radius of the particle's splat, world units: the distance to neighbours that the particle "
      "wants; less where it stands alone on a component of the surface smaller than this distance.",
      [](const ParticleRow& row, const RowCells& cells, double* out)
      { *out = cells.length(row.particle->radiusPerSpacing * row.particle->spacing); } },
    { "Area", 1,
      "Area of the surface around the particle, world units squared: their sum is the area of the "
      "surface. Nodes inside edges and faces of curved triangles have none.",
      [](const ParticleRow& row, const RowCells& cells, double* out)
      { *out = cells.area(row.particle->area); } },
    { "Mean_Curvature", 1,
      "Mean of the two principal curvatures with respect to Normals, 1/world units: 1/r on a "
      "sphere of radius r with high values inside.",
      [](const ParticleRow& row, const RowCells& cells, double* out)
      { *out = cells.curvature(row.particle->curvature.mean); } },
    { "Gauss_Curvature", 1, "Product of the two principal curvatures, 1/world units squared.",
      [](const ParticleRow& row, const RowCells& cells, double* out)
      { *out = cells.curvature(cells.curvature(row.particle->curvature.gauss)); } },
    { "Shape_Operator", 6,
      "Derivative of Normals along the surface, 1/world units: a symmetric tensor, xx, yy, zz, xy, "
      "yz, xz.",
      writeShapeOperator, ArrayUse::Diagnostic },
    { "Residual", 1, "Distance from the isosurface to first order, |F - c|/|grad F|, world units.",
      [](const ParticleRow& row, const RowCells& cells, double* out)
      { *out = cells.length(row.particle->residual); } },
    { "Clip_Normal", 9,
      "Unit normals, pointing to the far side, of up to three planes near the particle at which "
      "the surface ends (at boundary curves) or turns (at faces between elements); zero where "
      "there is "
      "no plane. Splats are to be cut at boundary curves and at creases, and to give way to the "
      "splats of the other side where Clip_Angle is below 10 degrees.",
      [](const ParticleRow& row, const RowCells&, double* out)
      {
        for (const ClipPlane& plane : row.particle->clips)
        {
          writeVector(plane.normal.xyz, out);
          out += 3;
        }
      },
      ArrayUse::Diagnostic },
    { "Clip_Distance", 3,
      "Distance of the particle from each of these planes, world units. A plane touches its "
      "boundary curve or crease where this is nearest. Where creases meet, a plane is moved "
      "outwards if nothing else would cover what it cuts off.",
      [](const ParticleRow& row, const RowCells& cells, double* out) {
        writeOfClips(
          row, out, [&](const ClipPlane& plane) { return cells.length(plane.distance); });
      },
      ArrayUse::Diagnostic },
    { "Clip_Angle", 3,
      "Largest angle seen at each of these planes between the normals of both sides, degrees: 180 "
      "at boundary curves, 0 at a crease behind which no particle stands, else at least 1.5. A "
      "step of the surface counts as an angle of "
      "step/spacing, below 10 degrees.",
      [](const ParticleRow& row, const RowCells&, double* out)
      {
        writeOfClips(
          row, out, [](const ClipPlane& plane) { return glm::degrees(plane.dihedralAngle); });
      },
      ArrayUse::Diagnostic },
    { "Clip_Curvature", 3,
      "Curvature of the boundary curve or crease at each of these planes, 1/world units: positive "
      "where the edge bends towards the plane's normal, 0 where Clip_Angle is below 10 degrees.",
      [](const ParticleRow& row, const RowCells& cells, double* out)
      {
        writeOfClips(
          row, out, [&](const ClipPlane& plane) { return cells.curvature(plane.edgeCurvature); });
      },
      ArrayUse::Diagnostic },
    { "Original_Placement", 6,
      "Position and Normals of the particle as computed. Renderers compare them with the points to "
      "take radii, planes and curvatures along where a filter has moved particles.",
      writePlacement, ArrayUse::Diagnostic },
    { "Cell_Borders", 4 * CellBorder::Most,
      "Up to four borders of the particle's cell on the surface that its splat reaches, nearest "
      "first, four numbers each: the vector to the nearest place of the border along the tangent "
      "plane, world units, zero where there is no border; and the border's curvature, 1/world "
      "units, positive where it bends out of the cell. Colours that differ from cell to cell end "
      "there, and edges of cells are drawn there.",
      writeCellBorders, ArrayUse::Diagnostic },
    { "Jump", 1,
      "F - c on the other side, where the particle stands on a boundary curve at which the field "
      "jumps from element to element; else 0.",
      [](const ParticleRow& row, const RowCells& cells, double* out)
      { *out = cells.difference(row.particle->jump); },
      ArrayUse::Diagnostic },
    { IsovalueArray, 1, "The isovalue c of the particle's surface.",
      [](const ParticleRow& row, const RowCells&, double* out) { *out = row.isovalue; } },
    { "ParametricCoordinates", 3,
      "Where the particle stands in its cell, in the parametric coordinates of VTK's cell.",
      writeParametricCoordinates, ArrayUse::Diagnostic },
    { CellIdsArray, 1, "Number of the particle's cell in its block of the input.", writeCellId },
    { OriginalCellIdsArray, 1,
      "The same as Cell_Id, under the name by which VTK's filters know it; ParaView does not list "
      "it.",
      writeCellId },
    { SplatColumnsArray, splatColumnCount(SplatColumns),
      "What only the renderer reads: Clip_Normal, Clip_Distance, Clip_Angle, Clip_Curvature, "
      "Shape_Operator, Original_Placement and Cell_Borders side by side.",
      writeSplatColumns, ArrayUse::Hidden },
    { CreaseColumnsArray, splatColumnCount(CreaseColumns),
      "What only the renderer reads of points of meshes on creases: the unit normal of one side, "
      "that of "
      "another one, and Clip_Normal, Clip_Distance, Clip_Angle, Clip_Curvature and Shape_Operator "
      "of the "
      "other one; zero elsewhere. Of meshes with creases.",
      writeCreaseColumns, ArrayUse::HiddenOfCreases },
  };
}

std::vector<vtkIdType> oneValue(std::int64_t value)
{
  return { static_cast<vtkIdType>(value) };
}

std::vector<ReportArray> makeReportArrays()
{
  return {
    { "Evaluations", "Evaluations of element polynomials.",
      [](const BlockReport& report) { return oneValue(report.sum.evaluations); } },
    { "Iterations", "Sweeps of the relaxation.",
      [](const BlockReport& report) { return oneValue(report.sum.iterations); } },
    { "ElementsDropped", "Cells of the block that provably hold no surface.",
      [](const BlockReport& report) { return oneValue(report.census.dropped); } },
    { "CellsSkipped", "Cells of the block that were left out because something is wrong with them.",
      [](const BlockReport& report) { return oneValue(report.census.skipped()); } },
    { "BoxesUnresolved",
      "Parts of cells that were split to 1/4096 of the cell without proof that they hold at most "
      "one sheet of the surface.",
      [](const BlockReport& report) { return oneValue(report.sum.boxesUndecided); } },
    { "SingularPoints",
      "Points near such parts at which the gradient vanishes on the surface: cones, isolated "
      "points, crossings.",
      [](const BlockReport& report) { return oneValue(report.sum.singularPoints); } },
    { "ParticlesRejected", "Particles given up because they could not be put on the surface again.",
      [](const BlockReport& report) { return oneValue(report.sum.particlesRejected); } },
    { "ParticlesUndersampled",
      "Particles at which the surface bends faster than their spacing can follow: curvature times "
      "spacing above 2.",
      [](const BlockReport& report) { return oneValue(report.sum.particlesUndersampled); } },
    { "FacesReached",
      "Faces of cells that the surface reaches, counted from each side. Of method Fast.",
      [](const BlockReport& report) { return oneValue(report.sum.facesReached); } },
    { "FacesEnded",
      "Faces, of those that FacesReached counts, at which the surface ends: at a jump of the "
      "field, or "
      "where the mesh or the surface in the next cell ends.",
      [](const BlockReport& report) { return oneValue(report.sum.facesEnded); } },
    { "UnresolvedCellIds", "Cells of the block with the parts that BoxesUnresolved counts.",
      [](const BlockReport& report) { return report.undecidedCells; } },
  };
}

std::vector<MeshReportArray> makeMeshReportArrays()
{
  return {
    { "MeshOpenLoops",
      "Holes of the mesh that are no boundary curves of the surface, of all blocks together.",
      [](const MeshNumbers& report) { return report.openLoops; } },
    { "MeshOpenLength", "Length of the edges around these holes, world units.",
      [](const MeshNumbers& report) { return report.openLength; } },
    { "MeshUnusedParticles",
      "Particles that are corners of no triangle, and not in the output; of all blocks together.",
      [](const MeshNumbers& report) { return report.unusedParticles; } },
    { "MeshTurnedTriangles",
      "Triangles that are turned away from the normal of a corner; of all blocks together.",
      [](const MeshNumbers& report) { return report.turnedTriangles; } },
    { "MeshStraightNodes",
      "Nodes of curved triangles that were not found on the surface, and stay on straight edges or "
      "in the plane of the corners; of all blocks together.",
      [](const MeshNumbers& report) { return report.straightNodes; } },
    { "TopologyProven",
      "1 if it is proven that the mesh has the components, Euler characteristics and boundary "
      "curves "
      "of the surface, 0 if not; of all blocks together.",
      [](const MeshNumbers& report) { return std::int64_t(report.isProven); } },
    { "MeshComponents", "Connected parts of the mesh, of all blocks together.",
      [](const MeshNumbers& report) { return report.components; } },
    { "ComponentsUnproven",
      "Parts of the mesh for which there is no such proof, and components of the surface that it "
      "lacks; of all blocks together.",
      [](const MeshNumbers& report) { return report.unprovenComponents; } },
  };
}

std::vector<ComponentArray> makeComponentArrays()
{
  return {
    { "ComponentIsovalue",
      "One value a component of the mesh, and of the surface that the mesh lacks, of all blocks "
      "together: its isovalue.",
      [](const ComponentRow& row) { return row.isovalue; } },
    { "ComponentPoint", "A point of it; where the mesh lacks it, of a cell that it passes.",
      [](const ComponentRow& row) { return row.unitOfLength * row.component.place.xyz; } },
    { "ComponentCellId",
      "The cell of the input around this point; of several blocks, and of several ranks, the cells "
      "are numbered through.",
      [](const ComponentRow& row) { return row.component.cell; } },
    { "ComponentEulerCharacteristic", "Vertices - edges + triangles: 2 for a sphere, 1 for a disc.",
      [](const ComponentRow& row) { return row.component.eulerCharacteristic; } },
    { "ComponentBoundaryLoops", "Number of closed curves in which it ends.",
      [](const ComponentRow& row) { return row.component.boundaryLoops; } },
    { "ComponentProven", "1 if both are proven to be those of the surface, 0 if not.",
      [](const ComponentRow& row) { return std::int64_t(row.component.proven); } },
  };
}

std::vector<OutputArray> makeDescriptions()
{
  std::vector<OutputArray> rows;
  for (const ParticleArray& array : particleArrays())
  {
    if (array.use != ArrayUse::HiddenOfCreases)
    {
      rows.push_back({ array.name, vtkDataObject::POINT, array.components, array.meaning });
    }
  }
  for (const ReportArray& array : reportArrays())
  {
    rows.push_back({ array.name, vtkDataObject::FIELD, 1, array.meaning });
  }
  return rows;
}

} // namespace

const std::vector<ParticleArray>& particleArrays()
{
  static const std::vector<ParticleArray> table = makeParticleArrays();
  return table;
}

const std::vector<ReportArray>& reportArrays()
{
  static const std::vector<ReportArray> table = makeReportArrays();
  return table;
}

const std::vector<ComponentArray>& componentArrays()
{
  static const std::vector<ComponentArray> table = makeComponentArrays();
  return table;
}

const std::vector<MeshReportArray>& meshReportArrays()
{
  static const std::vector<MeshReportArray> table = makeMeshReportArrays();
  return table;
}

const std::vector<OutputArray>& describeOutputArrays()
{
  static const std::vector<OutputArray> rows = makeDescriptions();
  return rows;
}

bool isOwnPointArray(const std::string& name)
{
  const std::vector<ParticleArray>& table = particleArrays();
  return std::any_of(
    table.begin(), table.end(), [&](const ParticleArray& array) { return array.name == name; });
}

void hideInPanels(vtkAbstractArray& array)
{
  array.GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
}

} // namespace hop
