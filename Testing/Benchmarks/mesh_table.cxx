// What the mesh between particles is like on files of solvers: a table in Markdown.
//
//   mesh_table [density=D] [finer=F] [only=NAME] [FOLDER ...]
//
// Every FOLDER (default: Testing/Data of the working folder) is searched for the files of the list below; with
// file=NAME array=A isovalue=C [component=N] one other file. The spacing is the proxy's default, 1/100 of the longest side, over F
// (default 1); the angular density is D (default 10, the filter's). Columns: holes are edges with one triangle that are
// no edges of the surface, in loops; V - E + F is the Euler characteristic; angles are the median and the 1% quantile
// (without triangles at edges of the surface) of the triangles' smallest angles, degrees; areas are those of the mesh
// and of all particles; microseconds of processor time a particle are for the mesh and for the areas, one thread, the
// least of five runs; bytes a particle are the most memory that the mesh took beyond what was there before (Linux).

#include "Conversion/GridElements.h"
#include "Fast/FastDistribution.h"
#include "Measurement.h"
#include "Mesh/SurfaceMesh.h"
#include "MeshMeasures.h"

#include <vtkBoundingBox.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <numeric>
#include <string>
#include <vector>

namespace
{

struct Case
{
  std::string file, array;
  double isovalue = 0.0;
  int component = 0;
};

const std::vector<Case> cases{
  { "mfem_hex1_p8.vtu", "u", 0.2 },
  { "mfem_torus_wedge_p4.vtu", "f", 0.3 },
  { "mfem_cylinder_hex_prism_p3.vtu", "phi", 0.3 },
  { "mfem_cylinder_hex_prism_p3.vtu", "pressure", -0.5 },
  { "mfem_amr_hanging_hex_p3.vtu", "u", 0.0 },
  { "mfem_dg_advection_0.vtu", "rho", 0.3 },
  { "mfem_dg_advection_1.vtu", "rho", 0.3 },
  { "mfem_dg_advection_2.vtu", "rho", 0.3 },
  { "mfem_dg_advection_3.vtu", "rho", 0.3 },
  { "mfem_dg_advection_4.vtu", "rho", 0.3 },
  { "dolfinx_tet_p3.vtu", "u", 0.5 },
  { "dealii_shell_p3_00.pvtu", "u", 0.4 },
  { "ngsolve_cylinder_ns_tet_p3.vtu", "pressure", 0.6 },
  { "ngsolve_cylinder_ns_tet_p3.vtu", "velocity", 0.1 },
  { "trixi_adv_sphere_hex_p3.vtu", "scalar", 1.28 },
  { "yeti_pipe_bezier_rational_p333.vtu", "disp", -1e-4 },
  { "yeti_pipe_bezier_rational_p423.vtu", "disp", -1e-4 },
  { "vtkdata_pyramid_quadratic.vtu", "Polynomial", 4.01 },
  { "vtkdata_notch_quadratic_hex20_wedge15.vtu", "Nodal Displacement", 1.68e-6 },
  { "pyfr_cylinder_5040hex_696prism_p3.vtu", "Pressure", 17.6 },
  { "pyfr_cylinder_3360hex_7656prism_p3.vtu", "Pressure", 17.8 },
};

struct Options
{
  double density = 10.0, finer = 1.0;
  std::string only;
  Case single;
  std::string surface;
  bool creases = true;
  std::vector<std::filesystem::path> folders;
};

vtkSmartPointer<vtkUnstructuredGrid> read(const std::filesystem::path& path)
{
  if (path.extension() == ".pvtu")
  {
    vtkNew<vtkXMLPUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Points and triangles as an OBJ file, to look at.
void write(const std::string& name, const hop::Distribution& distribution,
  const std::vector<std::array<int, 3>>& triangles)
{
  std::ofstream out(name);
  out.precision(12);
  for (const hop::Particle& p : distribution.particles)
  {
    const glm::dvec3& x = p.position.xyz;
    out << "v " << x.x << " " << x.y << " " << x.z << "\n";
  }
  for (const auto& [a, b, c] : triangles)
  {
    out << "f " << a + 1 << " " << b + 1 << " " << c + 1 << "\n";
  }
}

/// Processor time of a mesh on one thread, the least of five.
double meshTime(const hop::Isosurface& surface, const hop::Distribution& distribution)
{
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 5; ++run)
  {
    // Meshing may add particles, for which runs have room.
    hop::Distribution copy;
    copy.particles.reserve(distribution.particles.capacity());
    copy = distribution;
    least = std::min(least,
      hop::testing::fastest(
        1, 1, [&]() { hop::meshSurface(surface, hop::ConstrainedEdges(copy), copy, {}, {}); })
        .cpu);
  }
  return least;
}

void measure(const Options& options, const Case& which, const std::filesystem::path& path)
{
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read(path);
  vtkDataArray* array = grid->GetPointData()->GetArray(which.array.c_str());
  if (!array)
  {
    std::printf("| %s | no array %s |\n", which.file.c_str(), which.array.c_str());
    return;
  }
  const vtkNew<vtkPolyData> output;
  const hop::InputBlocks blocks({ { grid, array, output, "" } }, which.component);
  const vtkBoundingBox bounds(grid->GetBounds());
  const hop::GridElements elements =
    hop::buildGridElements(blocks, hop::NodeSpacing::Uniform, { which.isovalue }, {});
  constexpr double tolerancePerDiagonal = 1e-10;
  const hop::Isosurface surface{ &elements.mesh, elements.fieldIsovalue(which.isovalue),
    tolerancePerDiagonal * bounds.GetDiagonalLength() };
  hop::DistributionParameters parameters;
  parameters.onCreases = options.creases;
  parameters.sizing = { 0.01 * bounds.GetMaxLength() / options.finer, options.density };
  hop::Distribution distribution = hop::distributeFast(surface, parameters, {}, {});
  const auto count = static_cast<double>(std::max<std::size_t>(1, distribution.particles.size()));
  const auto undersampled = distribution.report.particlesUndersampled;
  const std::size_t before = distribution.particles.size();
  hop::SurfaceMesh mesh;
  std::vector<double> areas;
  const double areaTime = hop::testing::fastest(1, 5,
    [&]() {
      areas = hop::particleAreas(distribution, hop::ConstrainedEdges(distribution), {}, {});
    }).cpu;
  const double time = meshTime(surface, distribution);
  ::malloc_trim(0); // what the distribution has freed is no memory of the mesh
  std::ofstream("/proc/self/clear_refs") << "5"; // the peak begins anew
  const double megabytes = hop::testing::presentMegabytes();
  mesh = hop::meshSurface(surface, hop::ConstrainedEdges(distribution), distribution, {}, {});
  const double bytes = 1e6 * (hop::testing::peakMegabytes() - megabytes) / count;
  const hop::testing::MeshMeasures m = hop::testing::measureMesh(distribution, mesh.triangles);
  std::printf(
    "| %s %s | %zu | %zu | %lld | %zu | %lld+%lld+%lld | %lld in %lld, %.2g | %lld | %lld | %lld | "
    "%.1f %.1f %.1f | %.6g %.6g | %.2f %.2f | %.0f |\n",
    which.file.substr(0, 32).c_str(), which.array.c_str(), before,
    distribution.particles.size() - before, static_cast<long long>(undersampled),
    mesh.triangles.size(), static_cast<long long>(m.badEdges),
    static_cast<long long>(m.turnedTriangles), static_cast<long long>(m.badVertices),
    static_cast<long long>(m.holeEdges), static_cast<long long>(mesh.openLoops),
    mesh.openLength / parameters.sizing.spacing, static_cast<long long>(mesh.unusedParticles),
    static_cast<long long>(m.eulerCharacteristic), static_cast<long long>(m.components),
    m.medianMinAngle, m.lowMinAngle, m.worstMinAngle, m.area,
    std::accumulate(areas.begin(), areas.end(), 0.0), 1e6 * time / count, 1e6 * areaTime / count,
    bytes);
  std::fflush(stdout);
  if (!options.surface.empty())
  {
    write(options.surface, distribution, mesh.triangles);
  }
}

Options parse(int argc, char* argv[])
{
  Options options;
  for (int a = 1; a < argc; ++a)
  {
    const std::string argument = argv[a];
    const std::size_t equals = argument.find('=');
    const std::string key = argument.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : argument.substr(equals + 1);
    if (key == "density")
    {
      options.density = std::stod(value);
    }
    else if (key == "finer")
    {
      options.finer = std::stod(value);
    }
    else if (key == "only")
    {
      options.only = value;
    }
    else if (key == "file")
    {
      options.single.file = value;
    }
    else if (key == "creases")
    {
      options.creases = std::stoi(value) != 0;
    }
    else if (key == "array")
    {
      options.single.array = value;
    }
    else if (key == "isovalue")
    {
      options.single.isovalue = std::stod(value);
    }
    else if (key == "component")
    {
      options.single.component = std::stoi(value);
    }
    else if (key == "surface")
    {
      options.surface = value;
    }
    else
    {
      options.folders.emplace_back(argument);
    }
  }
  if (options.folders.empty())
  {
    options.folders.emplace_back("Testing/Data");
  }
  return options;
}

} // namespace

int main(int argc, char* argv[])
{
  const Options options = parse(argc, argv);
  vtkObject::GlobalWarningDisplayOff(); // some files hold cells that are told as doubtful
  std::printf(
    "| file | particles | added | undersampled | triangles | bad edges + turned + bad vertices | "
    "holes, length "
    "/ spacing | unused | V - E + F | "
    "components | angles | areas | us | bytes "
    "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Case& which :
    options.single.file.empty() ? cases : std::vector<Case>{ options.single })
  {
    for (const std::filesystem::path& folder : options.folders)
    {
      const std::filesystem::path path = folder / which.file;
      if (std::filesystem::exists(path) && which.file.find(options.only) != std::string::npos)
      {
        measure(options, which, path);
        break;
      }
    }
  }
  return EXIT_SUCCESS;
}
