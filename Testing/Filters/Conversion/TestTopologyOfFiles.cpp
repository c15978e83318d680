#include "Conversion/GridElements.h"
#include "Surface/FaceLocator.h"
#include "Topology/SurfaceTopology.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPUnstructuredGridReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace hop
{
namespace
{

/// An isosurface of a file: of a vector, its magnitude.
struct FileCase
{
  std::string file, array;
  double isovalue = 0.0;
  /// Components of the surface, their Euler characteristics and boundary loops in sum; -1 components: the field jumps,
  /// or is singular, so that there is no proof.
  int components = 0;
  int eulerCharacteristic = 0;
  int boundaryLoops = 0;
};

std::ostream& operator<<(std::ostream& out, const FileCase& which)
{
  return out << which.file << " " << which.array << " " << which.isovalue;
}

vtkSmartPointer<vtkUnstructuredGrid> read(const std::string& file)
{
  const std::string path = std::string(HOP_DATA) + "/" + file;
  if (file.find(".pvtu") != std::string::npos)
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

SurfaceTopology topologyOf(const FileCase& which)
{
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read(which.file);
  vtkDataArray* array = grid->GetPointData()->GetArray(which.array.c_str());
  if (!array)
  {
    ADD_FAILURE() << "no array";
    return {};
  }
  constexpr int magnitude = 9;
  const std::vector<InputBlock> blocks{ { grid, array, nullptr, "" } };
  const GridElements elements = buildGridElements(
    { blocks, componentOf(blocks, magnitude) }, NodeSpacing::Uniform, { which.isovalue }, {});
  const double level = elements.fieldIsovalue(which.isovalue);
  const FaceLocator locator(elements.mesh, level, {});
  return findTopology(elements.mesh, level, &locator, {});
}

class TopologyOfFiles : public ::testing::TestWithParam<FileCase>
{
};

TEST_P(TopologyOfFiles, IsProven)
{
  const FileCase& which = this->GetParam();
  const SurfaceTopology topology = topologyOf(which);
  if (which.components < 0)
  {
    EXPECT_FALSE(topology.isProven());
    return;
  }
  EXPECT_TRUE(topology.isProven());
  std::int64_t euler = 0, loops = 0;
  for (const SurfaceComponent& component : topology.components)
  {
    euler += component.eulerCharacteristic;
    loops += component.boundaryLoops;
  }
  EXPECT_EQ(topology.components.size(), static_cast<std::size_t>(which.components));
  EXPECT_EQ(euler, which.eulerCharacteristic);
  EXPECT_EQ(loops, which.boundaryLoops);
}

// The numbers are those of the triangle meshes of the particles, where these are closed (topology_benchmark).
INSTANTIATE_TEST_SUITE_P(Continuous, TopologyOfFiles,
  ::testing::Values(FileCase{ "mfem_hex1_p8.vtu", "u", 0.2, 1, 0, 2 },
    FileCase{ "mfem_torus_wedge_p4.vtu", "radius", 1.0, 1, 0, 2 },
    FileCase{ "mfem_torus_wedge_p4.vtu", "f", 0.04221, 6, 6, 6 },
    FileCase{ "mfem_cylinder_hex_prism_p3.vtu", "phi", 2.483, 1, 1, 1 },
    FileCase{ "mfem_amr_hanging_hex_p3.vtu", "u", 0.0, 1, 1, 1 },
    FileCase{ "mfem_amr_hanging_hex_p3.vtu", "u", 0.4, 1, 1, 1 },
    FileCase{ "dolfinx_tet_p3.vtu", "u", 1.755, 3, 3, 3 },
    FileCase{ "dealii_shell_p3_00.pvtu", "u", 0.4, 3, 1, 5 },
    FileCase{ "ngsolve_cylinder_ns_tet_p3.vtu", "velocity", 0.1778, 1, -2, 2 },
    FileCase{ "ngsolve_cylinder_ns_tet_p3.vtu", "pressure", 0.5239, 2, 2, 2 },
    FileCase{ "yeti_pipe_bezier_rational_p333.vtu", "disp", 1.1e-4, 1, 1, 1 },
    FileCase{ "yeti_pipe_bezier_rational_p423.vtu", "RationalWeights", 0.81, 2, 0, 4 },
    FileCase{ "vtkdata_pyramid_quadratic.vtu", "DistanceToCenter", 0.5196, 1, 2, 0 },
    FileCase{ "vtkdata_pyramid_quadratic.vtu", "Polynomial", 1.6, 19, 37, 1 },
    FileCase{
      "vtkdata_notch_quadratic_hex20_wedge15.vtu", "Nodal Displacement", 1.956e-6, 1, 1, 1 }));

INSTANTIATE_TEST_SUITE_P(Jumping, TopologyOfFiles,
  ::testing::Values(FileCase{ "mfem_cylinder_hex_prism_p3.vtu", "pressure", -0.5, -1, 0, 0 },
    FileCase{ "mfem_dg_advection_0.vtu", "rho", 0.3, -1, 0, 0 },
    FileCase{ "trixi_adv_sphere_hex_p3.vtu", "scalar", 1.28, -1, 0, 0 }));

INSTANTIATE_TEST_SUITE_P(Singular, TopologyOfFiles,
  ::testing::Values(FileCase{ "vtkdata_pyramid_quadratic.vtu", "Polynomial", 4.0, -1, 0, 0 }));

} // namespace
} // namespace hop
