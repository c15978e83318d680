// What is proven of the topology of isosurfaces of a file, and how long that takes.
//
//   topology_benchmark FILE.vtu [ARRAY [ISOVALUE ...]]
//
// Without isovalues those at 10, 30, 50, 70 and 90% of the array's range (magnitude of vectors); without array all
// point arrays. Prints a line an isovalue: elements that may hold surface, those that do, components and how many of
// them are proven, Euler characteristic and boundary loops of the proven ones in sum, cells without proof; of the mesh
// of the particles at 1/100 of the longest side: components, how many of them are proven, and components of the surface
// that it lacks; microseconds an element that may hold surface, on one thread: certificate, distribution and mesh.

#include "Conversion/GridElements.h"
#include "Fast/FastDistribution.h"
#include "Mesh/SurfaceMesh.h"
#include "Surface/FaceLocator.h"
#include "Topology/TopologyComparison.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

namespace
{

double secondsOf(const std::function<void()>& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void measure(vtkUnstructuredGrid* grid, vtkDataArray* array, double isovalue)
{
  const int component = hop::componentOf({ { grid, array, nullptr, "" } }, 9);
  const hop::InputBlocks blocks({ { grid, array, nullptr, "" } }, component);
  const hop::GridElements elements =
    hop::buildGridElements(blocks, hop::NodeSpacing::Uniform, { isovalue }, {});
  if (elements.mesh.elements.empty() || !elements.canBe(isovalue))
  {
    return;
  }
  const double level = elements.fieldIsovalue(isovalue);
  const hop::FaceLocator locator(elements.mesh, level, {});
  hop::SurfaceTopology topology;
  const double seconds =
    secondsOf([&]() { topology = hop::findTopology(elements.mesh, level, &locator, {}); });
  const auto withSurface = std::count_if(topology.surfaces.begin(), topology.surfaces.end(),
    [](const hop::ElementSurface& surface) { return !surface.pieces.empty(); });
  std::int64_t proven = 0, euler = 0, loops = 0;
  for (const hop::SurfaceComponent& c : topology.components)
  {
    proven += c.proven;
    euler += c.proven ? c.eulerCharacteristic : 0;
    loops += c.proven ? c.boundaryLoops : 0;
  }
  const double extent = grid->GetLength();
  const hop::Isosurface surface{ &elements.mesh, level, 1e-10 * extent };
  const vtkBoundingBox bounds(grid->GetBounds());
  hop::DistributionParameters parameters;
  parameters.sizing = { 0.01 * bounds.GetMaxLength(), 10.0 };
  hop::Distribution distribution;
  hop::SurfaceMesh mesh;
  const double distributed =
    secondsOf([&]() { distribution = hop::distributeFast(surface, parameters, {}, {}); });
  const double meshed = secondsOf(
    [&]() {
      mesh = hop::meshSurface(surface, hop::ConstrainedEdges(distribution), distribution, {}, {});
    });
  const hop::TopologyComparison comparison =
    hop::compareTopology(topology, distribution.particles, mesh.triangles, {});
  const auto same = std::count_if(comparison.meshComponents.begin(),
    comparison.meshComponents.end(), [](const hop::ComponentComparison& c) { return c.proven; });
  const double count = static_cast<double>(elements.mesh.elements.size());
  std::printf("  %-12s %10.4g %6.0f %6td %4zu %4lld %4lld %4lld %4zu  mesh %4zu %4td %4lld %s "
              "%8.1f %8.1f %8.1f us\n",
    array->GetName(), isovalue, count, withSurface, topology.components.size(),
    static_cast<long long>(proven), static_cast<long long>(euler), static_cast<long long>(loops),
    topology.unresolvedCells.size(), comparison.meshComponents.size(), same,
    static_cast<long long>(comparison.missingComponents.size()),
    comparison.proven ? "proven" : "      ", 1e6 * seconds / count, 1e6 * distributed / count,
    1e6 * meshed / count);
  std::fflush(stdout);
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc < 2)
  {
    std::fprintf(stderr, "usage: topology_benchmark FILE.vtu [ARRAY [ISOVALUE ...]]\n");
    return EXIT_FAILURE;
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  std::printf(
    "%s: array, isovalue, elements, with surface, components, proven, Euler characteristic, loops, "
    "unresolved cells, mesh: components, proven, missing\n",
    argv[1]);
  for (int a = 0; a < grid->GetPointData()->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = grid->GetPointData()->GetArray(a);
    if (!array || (argc > 2 && std::string(argv[2]) != array->GetName()))
    {
      continue;
    }
    std::vector<double> isovalues;
    for (int i = 3; i < argc; ++i)
    {
      isovalues.push_back(std::atof(argv[i]));
    }
    double range[2];
    array->GetRange(range, array->GetNumberOfComponents() > 1 ? -1 : 0);
    for (const double share : { 0.1, 0.3, 0.5, 0.7, 0.9 })
    {
      if (argc <= 3)
      {
        isovalues.push_back(range[0] + share * (range[1] - range[0]));
      }
    }
    for (const double isovalue : isovalues)
    {
      measure(grid, array, isovalue);
    }
  }
  return EXIT_SUCCESS;
}
