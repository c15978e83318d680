// Pictures a second of Surface Splats, beside other ways to draw as many points, in one run.
//
//   splat_speed [--size WIDTHxHEIGHT] [--seconds S] [PARTICLES...]
//
// A sphere of particles turns before the camera, so that every picture is drawn anew. Beside it: the
// same particles as disks, VTK's Point Gaussian of the same points (opaque spheres), and a sphere of
// as many vertices as triangles with normals. They take turns, as machines are faster at one time than at
// another, each for S seconds (default 4) in all; figures are medians of their turns. Wants a display.

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkSurfaceSplatMapper.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace
{
constexpr int Rounds = 9;

// Spread evenly (Fibonacci), with the radius that the filter gives: the distance of neighbours.
vtkSmartPointer<vtkPolyData> ParticlesOnSphere(vtkIdType count)
{
  const double goldenAngle = M_PI * (3. - std::sqrt(5.));
  const double radius = std::sqrt(8. * M_PI / (std::sqrt(3.) * count));
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> radii;
  radii->SetName("Radius");
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double z = 1. - (2. * i + 1.) / count;
    const double ring = std::sqrt(1. - z * z);
    const double place[3] = { ring * std::cos(i * goldenAngle), ring * std::sin(i * goldenAngle),
      z };
    points->InsertNextPoint(place);
    normals->InsertNextTuple(place);
    radii->InsertNextValue(static_cast<float>(radius));
  }
  auto particles = vtkSmartPointer<vtkPolyData>::New();
  particles->SetPoints(points);
  particles->GetPointData()->SetNormals(normals);
  particles->GetPointData()->AddArray(radii);
  return particles;
}

vtkSmartPointer<vtkPolyData> TrianglesOnSphere(vtkIdType count)
{
  const int rows = static_cast<int>(std::sqrt(0.5 * count));
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.);
  source->SetThetaResolution(2 * rows);
  source->SetPhiResolution(rows);
  source->Update();
  return source->GetOutput();
}

struct Speed
{
  double PicturesASecond;
  double CpuMilliseconds; // of all threads, a picture: tells more than time does on a busy machine
};

// A window of its own for a mapper, in which the camera turns from picture to picture.
class Show
{
public:
  Show(vtkMapper* mapper, int width, int height)
  {
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(actor);
    this->Window->SetSize(width, height);
    this->Window->SetMultiSamples(0);
    this->Window->AddRenderer(renderer);
    renderer->ResetCamera();
    this->Camera = renderer->GetActiveCamera();
    this->Camera->Zoom(1.4);
    this->Draw(); // uploads and compiles
    this->Draw();
  }

  void MeasureFor(double seconds)
  {
    int pictures = 0;
    double passed = 0.;
    const std::clock_t cpu = std::clock();
    const auto start = std::chrono::steady_clock::now();
    while (passed < seconds || pictures == 0)
    {
      this->Draw();
      ++pictures;
      passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    this->Speeds.push_back(
      { pictures / passed, 1e3 * (std::clock() - cpu) / CLOCKS_PER_SEC / pictures });
  }

  const std::vector<Speed>& GetSpeeds() const { return this->Speeds; }

private:
  void Draw()
  {
    this->Camera->Azimuth(7.);
    this->Window->Render();
    this->Window->WaitForCompletion();
  }

  vtkNew<vtkRenderWindow> Window;
  vtkCamera* Camera = nullptr;
  std::vector<Speed> Speeds;
};

double Median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Speed Median(const std::vector<Speed>& speeds)
{
  std::vector<double> rates;
  std::vector<double> costs;
  for (const Speed& speed : speeds)
  {
    rates.push_back(speed.PicturesASecond);
    costs.push_back(speed.CpuMilliseconds);
  }
  return { Median(rates), Median(costs) };
}

// Of how many pictures there are in the same time, round by round.
double MedianRatio(const std::vector<Speed>& a, const std::vector<Speed>& b)
{
  std::vector<double> ratios;
  for (std::size_t round = 0; round < a.size(); ++round)
  {
    ratios.push_back(a[round].PicturesASecond / b[round].PicturesASecond);
  }
  return Median(ratios);
}

void Measure(vtkIdType count, int width, int height, double seconds)
{
  const vtkSmartPointer<vtkPolyData> particles = ParticlesOnSphere(count);
  vtkNew<vtkSurfaceSplatMapper> splats;
  splats->SetInputData(particles);
  vtkNew<vtkSurfaceSplatMapper> disks;
  disks->SetInputData(particles);
  disks->SetModeToDisks();
  vtkNew<vtkPointGaussianMapper> gaussian;
  gaussian->SetInputData(particles);
  gaussian->SetScaleArray("Radius");
  gaussian->SetScaleFactor(1.);
  gaussian->EmissiveOff();
  gaussian->SetSplatShaderCode("//VTK::Color::Impl\n"
                               "float away = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);\n"
                               "if (away > 1.0) discard;\n"
                               "ambientColor *= 1.0 - away;\n"
                               "diffuseColor *= 1.0 - away;\n");
  vtkNew<vtkPolyDataMapper> triangles;
  triangles->SetInputData(TrianglesOnSphere(count));

  Show shows[] = { { splats, width, height }, { disks, width, height }, { gaussian, width, height },
    { triangles, width, height } };
  for (int round = 0; round < Rounds; ++round)
  {
    for (Show& show : shows)
    {
      show.MeasureFor(seconds / Rounds);
    }
  }
  std::printf("| %lld | %dx%d |", static_cast<long long>(count), width, height);
  for (const Show& show : shows)
  {
    const Speed speed = Median(show.GetSpeeds());
    std::printf(" %.1f (%.0f) |", speed.PicturesASecond, speed.CpuMilliseconds);
  }
  std::printf(" %.2f | %.2f |\n", MedianRatio(shows[0].GetSpeeds(), shows[2].GetSpeeds()),
    MedianRatio(shows[0].GetSpeeds(), shows[3].GetSpeeds()));
  std::fflush(stdout);
}
}

int main(int argc, char* argv[])
{
  int width = 512;
  int height = 512;
  double seconds = 4.;
  std::vector<vtkIdType> counts;
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    if (argument == "--size" && i + 1 < argc)
    {
      std::sscanf(argv[++i], "%dx%d", &width, &height);
    }
    else if (argument == "--seconds" && i + 1 < argc)
    {
      seconds = std::atof(argv[++i]);
    }
    else
    {
      counts.push_back(std::atoll(argv[i]));
    }
  }
  if (counts.empty())
  {
    counts = { 6800, 10000, 100000, 1000000 };
  }
  std::printf("Pictures a second (CPU milliseconds a picture)\n\n"
              "| particles | window | splats | disks | Point Gaussian | triangles | splats : Point "
              "Gaussian | splats : triangles |\n|---|---|---|---|---|---|---|---|\n");
  for (vtkIdType count : counts)
  {
    Measure(count, width, height, seconds);
  }
  return EXIT_SUCCESS;
}
