// How long it takes from a VTK grid to elements and to surface boxes, beside stock Contour's whole time.
//
//   setup_benchmark FILE.vtu ARRAY ISOVALUE [REPETITIONS]
//
// Prints a line a number of threads: the best of the repetitions.

#include "Common/VtkThreads.h"
#include "Conversion/GridElements.h"
#include "Isolation/SurfaceBoxes.h"

#include "vtkContourFilter.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>

namespace
{

double bestSeconds(int repetitions, const std::function<void()>& work)
{
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repetitions; ++i)
  {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    best = std::min(best, seconds.count());
  }
  return best;
}

struct Timings
{
  double elements = 0.0;
  double boxes = 0.0;
  std::size_t kept = 0;
  std::size_t boxCount = 0;
};

Timings measure(vtkUnstructuredGrid* grid, vtkDataArray* array, double isovalue, int repetitions,
  const hop::ParallelFor& parallelFor)
{
  Timings result;
  const hop::InputBlocks blocks({ { grid, array, nullptr, "" } }, 0);
  hop::GridElements elements;
  result.elements = bestSeconds(repetitions,
    [&]()
    {
      elements =
        hop::buildGridElements(blocks, hop::NodeSpacing::Uniform, { isovalue }, parallelFor);
    });
  result.kept = elements.mesh.elements.size();
  const double wantedSize = 0.03 * grid->GetLength();
  result.boxes = bestSeconds(repetitions,
    [&]()
    {
      result.boxCount = hop::findSurfaceBoxes(
        elements.mesh, elements.fieldIsovalue(isovalue), wantedSize, parallelFor)
                          .size();
    });
  return result;
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc < 4)
  {
    std::fprintf(stderr, "usage: setup_benchmark FILE.vtu ARRAY ISOVALUE [REPETITIONS]\n");
    return EXIT_FAILURE;
  }
  const double isovalue = std::atof(argv[3]);
  const int repetitions = argc > 4 ? std::atoi(argv[4]) : 5;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  vtkDataArray* array = grid->GetPointData()->GetArray(argv[2]);
  if (!array)
  {
    std::fprintf(stderr, "no point array '%s'\n", argv[2]);
    return EXIT_FAILURE;
  }
  const double cells = static_cast<double>(grid->GetNumberOfCells());
  for (const int threads : { 1, 2 })
  {
    const Timings t = [&]()
    {
      Timings inner;
      vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
        [&]()
        {
          withThreads([&](const hop::ParallelFor& parallelFor)
            { inner = measure(grid, array, isovalue, repetitions, parallelFor); });
        });
      return inner;
    }();
    std::printf("%d thread(s): %.0f cells to %zu elements %.2f ms (%.2f million cells/s), %zu "
                "boxes %.2f ms\n",
      threads, cells, t.kept, 1e3 * t.elements, 1e-6 * cells / t.elements, t.boxCount,
      1e3 * t.boxes);
  }
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(grid);
  contour->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, argv[2]);
  contour->SetValue(0, isovalue);
  const double seconds = bestSeconds(repetitions,
    [&]()
    {
      contour->Modified();
      contour->Update();
    });
  std::printf("stock Contour: %.2f ms, %lld points\n", 1e3 * seconds,
    static_cast<long long>(contour->GetOutput()->GetNumberOfPoints()));
  return EXIT_SUCCESS;
}
