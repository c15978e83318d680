// Where pictures of Surface Splats are wrong, at default settings: a table of pixels, and crops of the worst places.
//
//   splat_errors [--size PIXELS] [--near COUNT] [--look X,Y,Z,DX,DY,DZ] [--spacing SHARE] [--crops FOLDER]
//     [--cases FILE] [CASE...]
//
// A case is one of EdgeCases.h, FILE.vtu:ARRAY:ISOVALUE, or one of SurfaceCases.h; FILE holds such cases, one a line,
// as default_pictures.py writes them. Without any the cases of EdgeCases.h are taken. The spacing of files is the
// filter's own, or a share of the longest side of the grid.
// Each is seen from two or more cameras: one that sees all, and COUNT (default 1) near places where the most edges
// meet, or one that looks at the place X, Y, Z from the direction D. Where the cameras were is told on the standard
// error, so that versions whose particles differ can be compared. Pictures are held against a ray caster that finds the
// true polynomial surface (RayCaster.h); PictureErrors.h says what counts as wrong. Wants a display.

#include "EdgeCases.h"
#include "PictureErrors.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSurfaceSplatMapper.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace
{
struct Options
{
  int Size = 512;
  int Near = 1;
  std::vector<double> Look; // place, and direction to the eye
  double Spacing = 0.;
  std::string Crops;
  std::vector<std::string> Cases;
};

constexpr int CropSide = 64; // pixels
constexpr int CropCount = 10;

Options Parse(int argc, char* argv[])
{
  Options options;
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    const bool hasValue = i + 1 < argc;
    if (argument == "--size" && hasValue)
    {
      options.Size = std::atoi(argv[++i]);
    }
    else if (argument == "--near" && hasValue)
    {
      options.Near = std::atoi(argv[++i]);
    }
    else if (argument == "--look" && hasValue)
    {
      std::stringstream text(argv[++i]);
      for (std::string number; std::getline(text, number, ',');)
      {
        options.Look.push_back(std::stod(number));
      }
      options.Look.resize(6);
    }
    else if (argument == "--spacing" && hasValue)
    {
      options.Spacing = std::atof(argv[++i]);
    }
    else if (argument == "--crops" && hasValue)
    {
      options.Crops = argv[++i];
      std::filesystem::create_directories(options.Crops);
    }
    else if (argument == "--cases" && hasValue)
    {
      std::ifstream file(argv[++i]);
      for (std::string line; std::getline(file, line);)
      {
        options.Cases.push_back(line);
      }
    }
    else
    {
      options.Cases.push_back(argument);
    }
  }
  if (options.Cases.empty())
  {
    options.Cases = EdgeCaseNames();
  }
  return options;
}

SurfaceCase MakeCase(const std::string& name, double spacing)
{
  const auto& edges = EdgeCaseNames();
  const bool isEdge = std::count(name.begin(), name.end(), ':') == 1 ||
    std::find(edges.begin(), edges.end(), name) != edges.end();
  return isEdge ? MakeEdgeCase(name) : MakeSurfaceCase(name, spacing);
}

// Those near places where the most edges meet, or the one that was asked for.
std::vector<hop::testing::PictureCamera> NearViews(
  const SurfaceCase& surface, const Options& options)
{
  if (!options.Look.empty())
  {
    const std::vector<double>& look = options.Look;
    return { ViewNear(
      surface, options.Size, { look[0], look[1], look[2] }, { look[3], look[4], look[5] }) };
  }
  return ViewsOfCorners(surface, options.Size, options.Near);
}

// The name of a file or case without folders, as part of the name of a picture.
std::string ShortName(const std::string& name)
{
  std::string text = name.substr(name.rfind('/') + 1);
  std::replace(text.begin(), text.end(), ':', '_');
  return text;
}

void Measure(const SurfaceCase& surface, const std::string& view,
  const hop::testing::PictureCamera& camera, const std::string& crops)
{
  vtkNew<vtkSurfaceSplatMapper> splats;
  splats->SetInputData(surface.Particles);
  splats->ScalarVisibilityOff();
  const SurfacePicture reference = CastSurface(surface, camera);
  const SurfacePicture drawn = DrawSurface(splats, camera);
  const PictureErrors errors = FindErrors(drawn, reference, camera, surface.Spacing);
  const std::string name = ShortName(surface.Name);
  const auto count = [&](PixelError error) { return errors.Count(error); };
  std::printf("| %s | %s | %lld | %d | %d | %d | %d | %d |\n", name.c_str(), view.c_str(),
    static_cast<long long>(surface.Particles->GetNumberOfPoints()), errors.Covered,
    count(PixelError::Hole), count(PixelError::Beyond), count(PixelError::Depth),
    count(PixelError::Shade));
  std::fflush(stdout);
  if (!crops.empty())
  {
    const std::string path = crops + "/" + name + "_" + view;
    WriteCrops(drawn, reference, errors, camera.size, { { 0, 0 } }, camera.size, path + ".png");
    WriteCrops(drawn, reference, errors, camera.size,
      WorstPlaces(errors, camera.size, CropSide, CropCount), CropSide, path + "_worst.png");
  }
}
}

int main(int argc, char* argv[])
{
  const Options options = Parse(argc, argv);
  std::printf("| case | view | particles | pixels | holes | beyond | depth off | shade off |\n"
              "|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : options.Cases)
  {
    try
    {
      const SurfaceCase surface = MakeCase(name, options.Spacing);
      Measure(surface, "all", ViewOfAll(surface, options.Size), options.Crops);
      int number = 0;
      for (const auto& camera : NearViews(surface, options))
      {
        const glm::dvec3& x = camera.centre;
        const glm::dvec3& d = camera.back;
        std::fprintf(stderr, "near%d: --look %.9g,%.9g,%.9g,%.6f,%.6f,%.6f\n", ++number, x.x, x.y,
          x.z, d.x, d.y, d.z);
        Measure(surface, "near" + std::to_string(number), camera, options.Crops);
      }
    }
    catch (const std::exception& problem)
    {
      std::printf("| %s | %s |\n", name.c_str(), problem.what());
    }
  }
  return EXIT_SUCCESS;
}
