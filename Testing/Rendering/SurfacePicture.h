// What VTK draws of a surface, held against what rays see of it.
#pragma once

#include "RayCaster.h"

#include <functional>
#include <string>
#include <vector>

class vtkPolyDataMapper;
class vtkProperty;
struct SurfaceCase;

// What a mapper draws: points seen, and the brightness (0 to 1) of a white surface under a headlight.
struct SurfacePicture
{
  std::vector<hop::testing::SeenPoint> Seen;
  std::vector<double> Shade;
};

SurfacePicture DrawSurface(vtkPolyDataMapper* mapper, const hop::testing::PictureCamera& camera);

// The colours (0 to 1) of what a mapper draws without light, on black; `change` may change the actor's property.
std::vector<glm::dvec3> DrawColors(
  vtkPolyDataMapper* mapper, const hop::testing::PictureCamera& camera,
  const std::function<void(vtkProperty*)>& change = [](vtkProperty*) {});

// The same as rays see it: normals point to the eye.
SurfacePicture CastSurface(const SurfaceCase& surface, const hop::testing::PictureCamera& camera);

// Writes the brightness of pictures, side by side, as a picture file (PNG).
void WriteShades(const std::vector<SurfacePicture>& pictures,
  const hop::testing::PictureCamera& camera, const std::string& path);

struct PictureFigures
{
  // Pixels covered in both over pixels covered in either; 1 where a surface seen edge-on covers none.
  double IntersectionOverUnion = 0.;
  // Of the pixels covered in both: share with a depth error of at most 0.02 spacings, and the 99th
  // percentile in spacings.
  double DepthShare = 0.;
  double Depth99 = 0.;
  // Share of them that lie at most 0.02 spacings off the surface, measured along its normal: depth grows without
  // bounds where a surface is seen edge-on.
  double OffsetShare = 0.;
  // Share with a normal error of at most 2 degrees, and the 99th percentile in degrees.
  double NormalShare = 0.;
  double Normal99 = 0.;
  // Of the whole picture, decibels.
  double PeakSignalToNoise = 0.;
  // Pixels without surface whose 5 x 5 neighbours all have surface in the reference.
  int Holes = 0;
};

PictureFigures Compare(const SurfacePicture& drawn, const SurfacePicture& reference,
  const hop::testing::PictureCamera& camera, double spacing);

// Five views of a case, in one projection, that hold all of it.
std::vector<hop::testing::PictureCamera> CamerasAround(
  const SurfaceCase& surface, bool parallel, int size);
