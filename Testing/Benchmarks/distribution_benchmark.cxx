// One measurement of the filter or of a stock filter, as a JSON object on standard output.
// distribution_table.py runs it for all cases, each in a process of its own, so that peak memory is
// that of one measurement.
//
//   distribution_benchmark key=value ...
//     grid=      a file or a name of BenchmarkGrids.h
//     array=     its point array (default f)
//     isovalue=  (default 0)
//     density=   AngularDensity (default 0)
//     particles= number wanted: the spacing that gives it is searched first; or
//     spacing=   world units
//     method=    fast, classic, contour, tessellate (then Contour), sampled (pieces^3 linear cells an element,
//                then vtkContour3DLinearGrid), write (the grid, into the file `out`), or spacing: only the search;
//                default fast
//     out=       of write: a .vtu file
//     number=    NumberOfParticles (default 0: the spacing decides)
//     quality=   of fast: draft, standard, high (default standard)
//     error=     of tessellate: chord and field error, as fractions of the bounding diagonal and of the
//                field's range (default 1e-3)
//     pieces=    of sampled, along each edge (default 4)
//     repetitions= the fastest one counts (default 3)

#include "BenchmarkGrids.h"
#include "Classic/ClassicDistribution.h"
#include "Common/VtkThreads.h"
#include "Conversion/GridElements.h"
#include "DistributionMeasures.h"
#include "Elements/CornerNumbers.h"
#include "Elements/GatheredMesh.h"
#include "Fast/FastDistribution.h"
#include "Measurement.h"
#include "Output/ParticlePacker.h"
#include "PointGrid.h"
#include "SubdividedGrid.h"
#include "SurfaceSeeds.h"
#include "vtkHighOrderParticleIsosurface.h"

#include <vtkBoundingBox.h>
#include <vtkContour3DLinearGrid.h>
#include <vtkContourFilter.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkTessellatorFilter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>

namespace
{

using hop::testing::Evenness;
using hop::testing::fastest;
using hop::testing::peakMegabytes;
using hop::testing::presentMegabytes;
using hop::testing::Record;
using hop::testing::Seconds;

constexpr std::size_t mostParticlesWithStars = 2'000'000;
constexpr std::size_t mostParticlesWithProbes = 100'000;
constexpr double probesPerSpacing = 2.0;

struct Request
{
  std::string gridName, array = "f", method = "fast", out;
  double isovalue = 0.0, density = 0.0, particles = 0.0, spacing = 0.0, error = 1e-3;
  int repetitions = 3, pieces = 4, number = 0;
  hop::Quality quality = hop::Quality::Standard;
  vtkSmartPointer<vtkUnstructuredGrid> grid;
};

vtkSmartPointer<vtkHighOrderParticleIsosurface> makeFilter(const Request& request)
{
  auto filter = vtkSmartPointer<vtkHighOrderParticleIsosurface>::New();
  filter->SetInputData(request.grid);
  filter->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, request.array.c_str());
  filter->SetValue(0, request.isovalue);
  filter->SetSpacing(request.spacing);
  filter->SetAngularDensity(request.density);
  filter->SetNumberOfParticles(request.number);
  filter->SetQuality(static_cast<int>(request.quality));
  filter->SetMethod(request.method == "classic" ? vtkHighOrderParticleIsosurface::CLASSIC
                                                : vtkHighOrderParticleIsosurface::FAST);
  return filter;
}

vtkIdType runFilter(vtkAlgorithm* filter)
{
  filter->Modified();
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints();
}

/// Sets the spacing that gives the number of particles wanted, to 1%: it goes with the square root.
void findSpacing(Request& request)
{
  if (request.spacing > 0.0)
  {
    return;
  }
  vtkObject::GlobalWarningDisplayOff(); // coarse attempts may not follow the surface
  request.spacing = 0.05 * request.grid->GetLength();
  for (int attempt = 0; attempt < 8; ++attempt)
  {
    const auto count = static_cast<double>(std::max<vtkIdType>(1, runFilter(makeFilter(request))));
    if (std::abs(count / request.particles - 1.0) <= 0.01)
    {
      break;
    }
    request.spacing *= std::sqrt(count / request.particles);
  }
  vtkObject::GlobalWarningDisplayOn();
}

/// The stages of the filter, one after the other.
struct Stages
{
  hop::GridElements elements;
  hop::Isosurface surface;
  hop::Distribution distribution;
  Seconds setup, isolation, distributing, packing;
};

hop::DistributionParameters parametersOf(const Request& request)
{
  hop::DistributionParameters parameters;
  parameters.sizing = { request.spacing, request.density };
  parameters.quality = request.quality;
  parameters.particleCount = request.number;
  return parameters;
}

/// VTK 9.3 never takes more threads again than it was once told to take, unless told so.
Seconds fastestOn(int threads, int repetitions, const std::function<void()>& work)
{
  withThreads([threads](const hop::ParallelFor&) { vtkSMPTools::Initialize(threads); });
  return fastest(threads, repetitions, work);
}

hop::InputBlocks blocksOf(const Request& request, vtkPolyData* output)
{
  vtkDataArray* array = request.grid->GetPointData()->GetArray(request.array.c_str());
  return hop::InputBlocks({ { request.grid, array, output, "" } }, 0);
}

/// Puts elements into the order in which the filter distributes particles on them.
void orderAsTheFilter(hop::ElementMesh& mesh, const hop::ParallelFor& parallelFor)
{
  hop::GatheredMesh all;
  all.homes.resize(mesh.elements.size());
  all.mesh = std::move(mesh);
  hop::orderCanonically(all, parallelFor);
  mesh = std::move(all.mesh);
  hop::joinElements(mesh, parallelFor);
}

void runStages(const Request& request, Stages& stages)
{
  const vtkNew<vtkPolyData> output;
  const hop::InputBlocks blocks = blocksOf(request, output);
  constexpr double tolerancePerDiagonal = 1e-10; // the filter's default
  const auto onTwoThreads = [](const std::function<void(const hop::ParallelFor&)>& work)
  { return fastestOn(2, 1, [&] { withThreads(work); }); };
  stages.setup = onTwoThreads(
    [&](const hop::ParallelFor& parallelFor)
    {
      stages.elements = hop::buildGridElements(
        blocks, hop::NodeSpacing::Uniform, { request.isovalue }, parallelFor);
      orderAsTheFilter(stages.elements.mesh, parallelFor);
    });
  stages.surface = { &stages.elements.mesh, stages.elements.fieldIsovalue(request.isovalue),
    tolerancePerDiagonal * vtkBoundingBox(request.grid->GetBounds()).GetDiagonalLength() };
  // Part of the distribution, done once more: Fast asks for boxes of this size in hexahedra.
  constexpr double boxSizePerSpacing = 6.0;
  stages.isolation = onTwoThreads(
    [&](const hop::ParallelFor& parallelFor)
    {
      hop::findSurfaceBoxes(stages.elements.mesh, stages.surface.isovalue,
        boxSizePerSpacing * request.spacing, parallelFor);
    });
  const auto distribute =
    request.method == "classic" ? hop::distributeClassic : hop::distributeFast;
  stages.distributing = onTwoThreads([&](const hop::ParallelFor& parallelFor)
    { stages.distribution = distribute(stages.surface, parametersOf(request), {}, parallelFor); });
  stages.packing = onTwoThreads(
    [&](const hop::ParallelFor& parallelFor)
    {
      const hop::Monitor noMonitor;
      hop::Interruptible work(noMonitor, parallelFor);
      hop::packParticles(
        blocks, stages.elements, { { request.isovalue, stages.distribution, {} } }, {}, work);
    });
}

/// Points all over the surface, about twice as close as particles.
std::vector<glm::dvec3> probesOf(const Stages& stages)
{
  std::vector<double> spacings;
  for (const hop::Particle& p : stages.distribution.particles)
  {
    spacings.push_back(p.spacing);
  }
  std::nth_element(spacings.begin(), spacings.begin() + spacings.size() / 2, spacings.end());
  const double size = spacings[spacings.size() / 2] / probesPerSpacing;
  const hop::ElementMesh& mesh = stages.elements.mesh;
  const double isovalue = stages.surface.isovalue;
  std::vector<glm::dvec3> probes;
  for (const hop::Location& seed :
    hop::testing::surfaceSeeds(mesh, isovalue, hop::findSurfaceBoxes(mesh, isovalue, size, {})))
  {
    probes.push_back(hop::testing::positionAt(mesh, seed));
  }
  return probes;
}

/// Whether the surface neither ends nor turns where its splat reaches, and bends little over one spacing.
bool isOnSmoothSurface(const hop::Particle& particle)
{
  constexpr double mostRadians = 0.5;
  return particle.curvature.magnitude * particle.spacing <= mostRadians &&
    std::none_of(particle.clips.begin(), particle.clips.end(),
      [](const hop::ClipPlane& plane) { return plane.exists(); });
}

void addQuality(const Request& request, const Stages& stages, Record& record)
{
  const hop::Buffer<hop::Particle>& particles = stages.distribution.particles;
  double residual = 0.0;
  for (const hop::Particle& p : particles)
  {
    residual = std::max(residual, p.residual);
  }
  record.add("residual_per_diagonal", residual / request.grid->GetLength());
  if (particles.empty() || particles.size() > mostParticlesWithStars)
  {
    return;
  }
  const Evenness evenness = hop::testing::measureEvenness(particles);
  record.add("min_spacing", evenness.minSpacing);
  record.add("variation", evenness.variation);
  record.add("circumradius", evenness.circumradius);
  record.add("six_valent", evenness.sixValentShare);
  record.add("mean_min_angle", evenness.meanMinAngle);
  record.add("worst_min_angle", evenness.worstMinAngle);
  record.add("open_stars", static_cast<double>(evenness.openStars));
  const Evenness smooth = hop::testing::measureEvenness(particles, isOnSmoothSurface);
  record.add("min_spacing_smooth", smooth.minSpacing);
  record.add("variation_smooth", smooth.variation);
  if (particles.size() <= mostParticlesWithProbes)
  {
    record.add("coverage", hop::testing::coverageRadius(particles, probesOf(stages)));
  }
}

void expectEqual(vtkIdType a, vtkIdType b, const char* message)
{
  if (a != b)
  {
    throw std::runtime_error(
      std::string(message) + ": " + std::to_string(a) + " and " + std::to_string(b));
  }
}

void measureParticles(const Request& request, Record& record)
{
  const double before = presentMegabytes();
  vtkIdType count = -1;
  vtkSmartPointer<vtkHighOrderParticleIsosurface> filter;
  const auto work = [&]
  {
    // A filter that has run before keeps its output, or goes on from it.
    filter = makeFilter(request);
    const vtkIdType previous = count;
    count = runFilter(filter);
    expectEqual(previous < 0 ? count : previous, count, "runs of the filter differ");
  };
  for (const int threads : { 1, 2 })
  {
    record.add("seconds_" + std::to_string(threads), fastestOn(threads, request.repetitions, work));
  }
  record.add("peak_megabytes", peakMegabytes());
  record.add("megabytes_before", before);
  record.add("particles", static_cast<double>(count));
  filter->GetOutput()->Initialize();
  Stages stages;
  runStages(request, stages);
  const hop::DistributionReport& report = stages.distribution.report;
  expectEqual(static_cast<vtkIdType>(stages.distribution.particles.size()), count,
    "the stages give other particles than the filter");
  record.add("evaluations_a_particle",
    static_cast<double>(report.evaluations) / static_cast<double>(std::max<vtkIdType>(1, count)));
  record.add("elements", static_cast<double>(stages.elements.mesh.elements.size()));
  record.add("boxes", static_cast<double>(report.boxes));
  record.add("rejected", static_cast<double>(report.particlesRejected));
  record.add("undersampled", static_cast<double>(report.particlesUndersampled));
  record.add("setup", stages.setup);
  record.add("isolation", stages.isolation);
  record.add("distribution", stages.distributing);
  record.add("pack", stages.packing);
  addQuality(request, stages, record);
}

/// The place of a world point in the mesh, by walking to it from a place near.
bool walkTo(const glm::dvec3& x, hop::SurfaceWalker& walker, double accuracy, hop::Evaluated& at)
{
  constexpr int mostSteps = 30;
  for (int step = 0; step < mostSteps; ++step)
  {
    const hop::WorldVector rest{ x - at.point.map.position.xyz };
    if (length(rest) <= accuracy)
    {
      return true;
    }
    at = walker.evaluate(walker.move(at, rest));
  }
  return false;
}

/// Distances |F - c|/|grad F| of points from the surface of the elements' polynomials; points that
/// are not in the mesh are counted apart.
void addErrors(const Request& request, vtkPolyData* points, Record& record)
{
  Stages stages;
  runStages(request, stages);
  std::vector<glm::dvec3> positions;
  for (const hop::Particle& p : stages.distribution.particles)
  {
    positions.push_back(p.position.xyz);
  }
  const hop::testing::PointGrid grid(positions, 2.0 * request.spacing);
  hop::SurfaceWalker walker(stages.surface);
  const double accuracy = 1e-9 * request.grid->GetLength();
  std::vector<double> errors;
  double afterNewton = 0.0;
  int notProjected = 0;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 x;
    points->GetPoint(i, &x.x);
    std::vector<int> near;
    for (double radius = request.spacing; near.empty() && !positions.empty(); radius *= 2.0)
    {
      near = grid.within(x, radius);
    }
    std::sort(near.begin(), near.end(),
      [&](int a, int b)
      { return glm::distance(positions[a], x) < glm::distance(positions[b], x); });
    near.resize(std::min<std::size_t>(near.size(), 4));
    for (const int start : near)
    {
      hop::Evaluated at = walker.evaluate(stages.distribution.particles[start].location);
      if (walkTo(x, walker, accuracy, at))
      {
        errors.push_back(std::abs(at.point.value) / length(at.point.gradient));
        hop::Evaluated on;
        if (walker.project(at.location, request.spacing, on))
        {
          afterNewton = std::max(afterNewton, std::abs(on.point.value) / length(on.point.gradient));
        }
        else
        {
          ++notProjected;
        }
        break;
      }
    }
  }
  const double count = static_cast<double>(std::max<std::size_t>(1, errors.size()));
  const double diagonal = request.grid->GetLength();
  record.add("not_located",
    static_cast<double>(points->GetNumberOfPoints()) - static_cast<double>(errors.size()));
  record.add("mean_error_per_diagonal",
    std::accumulate(errors.begin(), errors.end(), 0.0) / count / diagonal);
  record.add("residual_per_diagonal",
    errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end()) / diagonal);
  record.add("residual_after_newton_per_diagonal", afterNewton / diagonal);
  record.add("not_projected", notProjected);
}

/// Contour as it comes, normals included, after Tessellate if asked for.
void measureStock(const Request& request, Record& record)
{
  vtkNew<vtkTessellatorFilter> tessellate;
  vtkNew<vtkContourFilter> contour;
  contour->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, request.array.c_str());
  contour->SetValue(0, request.isovalue);
  const bool pieces = request.method == "tessellate";
  vtkPointData* arrays = request.grid->GetPointData();
  if (pieces)
  {
    arrays->SetActiveScalars(request.array.c_str());
    double range[2];
    arrays->GetArray(request.array.c_str())->GetRange(range);
    tessellate->SetInputData(request.grid);
    tessellate->SetChordError(request.error * request.grid->GetLength());
    for (int a = 0, field = 0; a < arrays->GetNumberOfArrays(); ++a)
    {
      if (arrays->GetArrayName(a) == request.array)
      {
        tessellate->SetFieldCriterion(field, request.error * (range[1] - range[0]));
      }
      ++field;
    }
    contour->SetInputConnection(tessellate->GetOutputPort());
  }
  else
  {
    contour->SetInputData(request.grid);
  }
  vtkIdType count = 0;
  const double before = presentMegabytes();
  const auto work = [&]
  {
    tessellate->Modified();
    count = runFilter(contour);
  };
  for (const int threads : { 1, 2 })
  {
    record.add("seconds_" + std::to_string(threads), fastestOn(threads, request.repetitions, work));
  }
  record.add("peak_megabytes", peakMegabytes());
  record.add("megabytes_before", before);
  record.add("particles", static_cast<double>(count));
  record.add("triangles", static_cast<double>(contour->GetOutput()->GetNumberOfPolys()));
  addErrors(request, contour->GetOutput(), record);
}

/// What an expert does by hand: the elements that can hold surface, cut into linear cells, and the threaded
/// contour of these. It is given our own evaluators and tests of elements.
void measureSampled(const Request& request, Record& record)
{
  const vtkNew<vtkPolyData> unused;
  const hop::InputBlocks blocks = blocksOf(request, unused);
  vtkNew<vtkContour3DLinearGrid> contour;
  contour->MergePointsOn();
  const double before = presentMegabytes();
  const auto work = [&](const hop::ParallelFor& parallelFor)
  {
    const hop::GridElements elements =
      hop::buildGridElements(blocks, hop::NodeSpacing::Uniform, { request.isovalue }, parallelFor);
    contour->SetInputData(hop::testing::subdividedGrid(elements.mesh, request.pieces, parallelFor));
    contour->SetValue(0, elements.fieldIsovalue(request.isovalue));
    contour->Update();
  };
  for (const int threads : { 1, 2 })
  {
    record.add("seconds_" + std::to_string(threads),
      fastestOn(threads, request.repetitions, [&] { withThreads(work); }));
  }
  record.add("peak_megabytes", peakMegabytes());
  record.add("megabytes_before", before);
  record.add("pieces", request.pieces);
  record.add("triangles",
    static_cast<double>(
      vtkPolyData::SafeDownCast(contour->GetOutputDataObject(0))->GetNumberOfPolys()));
  auto* points = vtkPolyData::SafeDownCast(contour->GetOutputDataObject(0));
  record.add("particles", static_cast<double>(points->GetNumberOfPoints()));
  addErrors(request, points, record);
}

hop::Quality qualityOf(const std::string& name)
{
  return name == "draft" ? hop::Quality::Draft
    : name == "high"     ? hop::Quality::High
                         : hop::Quality::Standard;
}

Request parse(int argc, char* argv[])
{
  Request request;
  const std::map<std::string, std::function<void(const std::string&)>> keys{
    { "grid", [&](const std::string& v) { request.gridName = v; } },
    { "array", [&](const std::string& v) { request.array = v; } },
    { "method", [&](const std::string& v) { request.method = v; } },
    { "out", [&](const std::string& v) { request.out = v; } },
    { "isovalue", [&](const std::string& v) { request.isovalue = std::stod(v); } },
    { "density", [&](const std::string& v) { request.density = std::stod(v); } },
    { "particles", [&](const std::string& v) { request.particles = std::stod(v); } },
    { "spacing", [&](const std::string& v) { request.spacing = std::stod(v); } },
    { "number", [&](const std::string& v) { request.number = std::stoi(v); } },
    { "quality", [&](const std::string& v) { request.quality = qualityOf(v); } },
    { "error", [&](const std::string& v) { request.error = std::stod(v); } },
    { "pieces", [&](const std::string& v) { request.pieces = std::stoi(v); } },
    { "repetitions", [&](const std::string& v) { request.repetitions = std::stoi(v); } },
  };
  for (int a = 1; a < argc; ++a)
  {
    const std::string argument = argv[a];
    const std::size_t equals = argument.find('=');
    const auto key = keys.find(argument.substr(0, equals));
    if (equals == std::string::npos || key == keys.end())
    {
      throw std::invalid_argument("no such argument: " + argument);
    }
    key->second(argument.substr(equals + 1));
  }
  request.grid = hop::testing::benchmarkGrid(request.gridName);
  if (!request.grid || !request.grid->GetPointData()->GetArray(request.array.c_str()))
  {
    throw std::invalid_argument(
      "no grid '" + request.gridName + "' with a point array '" + request.array + "'");
  }
  if (!(request.spacing > 0.0 || request.particles > 0.0))
  {
    throw std::invalid_argument("give particles= or spacing=");
  }
  return request;
}

} // namespace

int main(int argc, char* argv[])
{
  try
  {
    Request request = parse(argc, argv);
    findSpacing(request);
    Record record;
    record.add("cells", static_cast<double>(request.grid->GetNumberOfCells()));
    record.add("spacing", request.spacing);
    if (request.method == "contour" || request.method == "tessellate")
    {
      measureStock(request, record);
    }
    else if (request.method == "sampled")
    {
      measureSampled(request, record);
    }
    else if (request.method == "write")
    {
      const vtkNew<vtkXMLUnstructuredGridWriter> writer;
      writer->SetInputData(request.grid);
      writer->SetFileName(request.out.c_str());
      writer->Write();
    }
    else if (request.method != "spacing")
    {
      measureParticles(request, record);
    }
    record.print();
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "distribution_benchmark: %s (see its head for usage)\n", error.what());
    return EXIT_FAILURE;
  }
}
