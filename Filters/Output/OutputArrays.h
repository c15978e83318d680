#pragma once

#include "Conversion/CellCensus.h"
#include "Output/ParticleRow.h"
#include "Surface/Particles.h"

#include "vtkType.h"

#include <string>
#include <variant>
#include <vector>

class vtkAbstractArray;

namespace hop
{

// The two tables in OutputArrays.cxx are the one place where the filter's own arrays are named and explained.

/// Names that other code has to know.
constexpr const char* NormalsArray = "Normals";
constexpr const char* IsovalueArray = "Isovalue";
constexpr const char* CellIdsArray = "Cell_Id";
/// VTK's own name for the same ids, which ParaView does not list.
constexpr const char* OriginalCellIdsArray = "vtkOriginalCellIds";

/// Writes the numbers of one particle.
template <class Number>
using RowWriter = void (*)(const ParticleRow& row, const RowCells& cells, Number* out);

/// When an output has an array.
enum class ArrayUse
{
  Always,
  /// If diagnostics are asked for.
  Diagnostic,
  /// Always; ParaView is not to offer it to users.
  Hidden,
  /// The same, for meshes with creases alone.
  HiddenOfCreases,
};

/// A point array of the output, whatever arrays the input has.
struct ParticleArray
{
  const char* name;
  int components;
  /// For users: what the numbers mean, and their unit.
  const char* meaning;
  /// Its kind is the type of the array: double, float where that is enough, or vtkIdType. Arrays of ids with one writer
  /// share their memory.
  std::variant<RowWriter<double>, RowWriter<float>, RowWriter<vtkIdType>> write;
  ArrayUse use = ArrayUse::Always;
};

/// What a run reports of one block.
struct BlockReport
{
  /// Sums over all isovalues, of the whole mesh.
  DistributionReport sum;
  const CellCensus& census;
  /// Cells of the block with undecided boxes, ascending.
  std::vector<vtkIdType> undecidedCells;
};

/// A field-data array of outputs with diagnostics: integers, one component.
struct ReportArray
{
  const char* name;
  /// For users.
  const char* meaning;
  std::vector<vtkIdType> (*values)(const BlockReport& report);
};

/// A field-data array of meshes: one number, of sums over all isovalues, lengths in world units.
struct MeshReportArray
{
  const char* name;
  /// For users.
  const char* meaning;
  std::variant<std::int64_t (*)(const MeshNumbers&), double (*)(const MeshNumbers&)> value;
};

/// What is told of one component of a mesh.
struct ComponentRow
{
  const MeshComponent& component;
  double isovalue;
  /// World units.
  double unitOfLength;
};

/// A field-data array of meshes: one tuple a component.
struct ComponentArray
{
  const char* name;
  /// For users.
  const char* meaning;
  std::variant<std::int64_t (*)(const ComponentRow&), double (*)(const ComponentRow&),
    glm::dvec3 (*)(const ComponentRow&)>
    value;
};

/// In the order of the output.
const std::vector<MeshReportArray>& meshReportArrays();

/// In the order of the output.
const std::vector<ComponentArray>& componentArrays();

/// In the order of the output.
const std::vector<ParticleArray>& particleArrays();

/// In the order of the output.
const std::vector<ReportArray>& reportArrays();

/// A row of either table, as users see it.
struct OutputArray
{
  const char* name;
  /// vtkDataObject::POINT or FIELD.
  int association;
  int components;
  const char* meaning;
};

/// Both tables: the point arrays, then those of the field data. Without what only meshes have.
const std::vector<OutputArray>& describeOutputArrays();

/// Whether particleArrays() has that name.
bool isOwnPointArray(const std::string& name);

/// ParaView is not to offer the array to colour by.
void hideInPanels(vtkAbstractArray& array);

} // namespace hop
