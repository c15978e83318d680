// How exactly Surface Splats show a surface, beside stock Contour's triangles of the same file.
//
//   splat_accuracy [--size PIXELS] [--spacing SHARE] [--pictures FOLDER] [CASE...]
//
// A case is one of SurfaceCases.h, or FILE.vtu:ARRAY:ISOVALUE; the spacing a share of the longest side of
// its grid (default 0.01, as the filter's). Five views of every case in both projections are held against a
// ray caster that finds the true polynomial surface (RayCaster.h). Prints the worst view of each; and, as
// what a picture of that size can tell at all, of the same rays cast a quarter of a pixel aside. Pictures are
// rays, splats and Contour side by side. Wants a display.

#include "SurfaceCases.h"
#include "SurfacePicture.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSurfaceSplatMapper.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace
{
struct Worst
{
  PictureFigures Figures;

  Worst()
  {
    this->Figures.IntersectionOverUnion = 1.;
    this->Figures.DepthShare = 1.;
    this->Figures.OffsetShare = 1.;
    this->Figures.NormalShare = 1.;
    this->Figures.PeakSignalToNoise = std::numeric_limits<double>::infinity();
  }

  void Add(const PictureFigures& view)
  {
    PictureFigures& f = this->Figures;
    f.IntersectionOverUnion = std::min(f.IntersectionOverUnion, view.IntersectionOverUnion);
    f.DepthShare = std::min(f.DepthShare, view.DepthShare);
    f.Depth99 = std::max(f.Depth99, view.Depth99);
    f.OffsetShare = std::min(f.OffsetShare, view.OffsetShare);
    f.NormalShare = std::min(f.NormalShare, view.NormalShare);
    f.Normal99 = std::max(f.Normal99, view.Normal99);
    f.PeakSignalToNoise = std::min(f.PeakSignalToNoise, view.PeakSignalToNoise);
    f.Holes += view.Holes;
  }
};

void Print(const std::string& name, const char* what, long long points, const PictureFigures& f)
{
  std::printf("| %s | %s | %lld | %.4f | %.2f%% | %.4f | %.2f%% | %.2f%% | %.2f | %.1f | %d |\n",
    name.c_str(), what, points, f.IntersectionOverUnion, 100. * f.DepthShare, f.Depth99,
    100. * f.OffsetShare, 100. * f.NormalShare, f.Normal99, f.PeakSignalToNoise, f.Holes);
  std::fflush(stdout);
}

hop::testing::PictureCamera QuarterOfAPixelAside(hop::testing::PictureCamera camera)
{
  camera.centre += 0.25 * camera.pixel() * camera.right();
  return camera;
}

void Measure(const std::string& name, double spacing, int size, const std::string& pictures)
{
  const SurfaceCase surface = MakeSurfaceCase(name, spacing);
  const vtkSmartPointer<vtkPolyData> contour = ContourOf(surface);
  for (bool parallel : { false, true })
  {
    Worst ofSplats;
    Worst ofContour;
    Worst ofRaysAside;
    int view = 0;
    for (const auto& camera : CamerasAround(surface, parallel, size))
    {
      vtkNew<vtkSurfaceSplatMapper> splats;
      splats->SetInputData(surface.Particles);
      splats->ScalarVisibilityOff();
      vtkNew<vtkPolyDataMapper> triangles;
      triangles->SetInputData(contour);
      triangles->ScalarVisibilityOff();
      const SurfacePicture reference = CastSurface(surface, camera);
      const SurfacePicture bySplats = DrawSurface(splats, camera);
      const SurfacePicture byContour = DrawSurface(triangles, camera);
      ofSplats.Add(Compare(bySplats, reference, camera, surface.Spacing));
      const SurfacePicture aside = CastSurface(surface, QuarterOfAPixelAside(camera));
      ofContour.Add(Compare(byContour, reference, camera, surface.Spacing));
      ofRaysAside.Add(Compare(aside, reference, camera, surface.Spacing));
      if (!pictures.empty())
      {
        const std::string path = pictures + "/" + surface.Name +
          (parallel ? "_parallel_" : "_perspective_") + std::to_string(++view) + ".png";
        WriteShades({ reference, bySplats, byContour }, camera, path);
      }
    }
    const std::string label = surface.Name + (parallel ? ", parallel" : ", perspective");
    Print(label, "splats", surface.Particles->GetNumberOfPoints(), ofSplats.Figures);
    Print(label, "Contour", contour->GetNumberOfPoints(), ofContour.Figures);
    Print(label, "rays aside", 0, ofRaysAside.Figures);
  }
}
}

int main(int argc, char* argv[])
{
  int size = 512;
  double spacing = 0.01;
  std::string pictures;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    if (argument == "--size" && i + 1 < argc)
    {
      size = std::atoi(argv[++i]);
    }
    else if (argument == "--spacing" && i + 1 < argc)
    {
      spacing = std::atof(argv[++i]);
    }
    else if (argument == "--pictures" && i + 1 < argc)
    {
      pictures = argv[++i];
      std::filesystem::create_directories(pictures);
    }
    else
    {
      names.push_back(argument);
    }
  }
  std::printf("| case | drawn | points | silhouette IoU | depth <= 0.02 h | depth 99%% (h) "
              "| off by <= 0.02 h | normal <= 2 deg | normal 99%% (deg) | PSNR (dB) | holes |\n"
              "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : names.empty() ? SurfaceCaseNames() : names)
  {
    Measure(name, spacing, size, pictures);
  }
  return EXIT_SUCCESS;
}
